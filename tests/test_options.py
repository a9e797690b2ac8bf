"""Options: each choice once, checked without a mesh; errors carry what to do as data."""

from __future__ import annotations

import inspect
from dataclasses import FrozenInstanceError, fields

import pytest
from meshes import plate, tetrahedron

import conformal_uv as cuv
from conformal_uv import options
from conformal_uv.errors import ConformalUVError, Remedy

CHOICES = [kind for kind in vars(options).values() if inspect.isclass(kind) and issubclass(kind, options.Choice)][1:]


def test_choices_are_their_names() -> None:
    for kind in CHOICES:
        for member in kind:
            assert kind.of("name", member.value) is member and member == member.value
        with pytest.raises(cuv.OptionError, match="name is 'magic'; choose"):
            kind.of("name", "magic")
        for value in (None, 1, ["auto"], b"auto"):
            with pytest.raises(cuv.OptionError):
                kind.of("name", value)


@pytest.mark.parametrize(
    ("kind", "door", "beside"),
    [
        (options.DiskOptions, cuv.disk_map, set()),
        (options.DiskOptions, cuv.unwrap, set()),
        (options.SplitOptions, cuv.unwrap, set()),
        (options.PlaceOptions, cuv.unwrap, set()),
        (options.ShapeOptions, cuv.unwrap, set()),
        (options.SphereOptions, cuv.sphere_map, {"relative_tolerance"}),
        (options.FreeOptions, cuv.free_map, set()),
        (options.RectangleOptions, cuv.rectangle_map, set()),
    ],
)
def test_every_field_is_a_parameter_of_its_door_with_its_default(kind, door, beside) -> None:
    parameters = inspect.signature(door).parameters
    for field in fields(kind):
        if field.name not in beside:
            assert parameters[field.name].default == field.default, field.name


def test_options_are_checked_without_a_mesh_and_frozen() -> None:
    checked = options.DiskOptions(method="augmented-lagrangian", tolerance=1)
    assert checked.method is options.Method.AUGMENTED_LAGRANGIAN
    assert checked.objective is options.Objective.DIRICHLET and checked.pin_mode is options.PinMode.CONSTRAINT
    with pytest.raises(FrozenInstanceError):
        checked.tolerance = 2.0
    for wrong in ({"method": "x"}, {"tolerance": 0}, {"pins": (1, 2)}, {"pins": (1, 2, 3), "center": 4}):
        with pytest.raises(cuv.OptionError):
            options.DiskOptions(**wrong)
    for wrong in ({"margin": 0.5}, {"rotation": "a"}, {"place": "sideways"}):
        with pytest.raises(cuv.OptionError):
            options.PlaceOptions(**wrong)
    with pytest.raises(TypeError, match="methode"):
        cuv.DiskMapper(*plate(4, 4)).map(methode="linear")


def test_ways_out_are_told_in_the_words_of_each_door() -> None:
    error = ConformalUVError("It is closed.", ways=("mark seams", Remedy("sphere_map"), Remedy("closed", "cut")))
    assert str(error) == 'It is closed. Mark seams, use sphere_map(), or pass closed="cut".'
    assert error.told(Remedy.as_flag) == "It is closed. Mark seams, or use --closed cut."
    assert error.told(lambda remedy: "") == "It is closed. Mark seams."
    assert str(ConformalUVError("So it is.")) == "So it is."


def test_remedies_of_charts_name_values_that_are_taken() -> None:
    """What the error of a chart advises, done, maps the chart."""
    V, F = tetrahedron()
    (chart,) = cuv.unwrap(V, F).charts
    (remedy,) = [way for way in chart.error.ways if isinstance(way, Remedy) and way.value]
    assert cuv.unwrap(V, F, **{remedy.option: remedy.value}).mapped.all()
    V, F = plate(6, 6, ((2, 2, 2, 2),))
    (chart,) = cuv.unwrap(V, F, holes="refuse").charts
    (remedy,) = [way for way in chart.error.ways if isinstance(way, Remedy)]
    assert cuv.unwrap(V, F, **{remedy.option: remedy.value}).mapped.all()


def test_the_first_spelling_of_center_is_still_taken() -> None:
    assert options.Normalization.of("normalization", "centre") is options.Normalization.CENTER
    assert "centre" not in list(options.Normalization)


def test_an_error_is_told_in_the_numbers_of_another_mesh() -> None:
    """Faces that were cut into triangles, vertices of which some were left out: both named, each in its own."""
    faces, vertices = [4, 4, 9, 9], [1, 3, 5, 7]
    error = cuv.DegenerateFaceError("3 faces have no area: faces 0, 1, 3.", [0, 1, 3])
    other = error.renumbered(faces, vertices)
    assert type(other) is cuv.DegenerateFaceError and other.indices == (4, 9)
    assert str(other) == "2 faces have no area: faces 4, 9."
    named = cuv.NonManifoldError("1 vertices join pieces: vertices 2. Split them.", [2]).renumbered(faces, vertices)
    assert named.indices == (5,) and str(named) == "1 vertices join pieces: vertices 5. Split them."
    plain = cuv.TopologyError("The surface is closed.")
    assert plain.renumbered(faces, vertices) is plain

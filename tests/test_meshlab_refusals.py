"""What the filter refuses, and how it is bound to MeshSet."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

from meshes import plate
from meshlab_sets import changed, contents, mesh_set

import conformal_uv as cuv
import meshlab_filter
from conformal_uv.samples import mask
from meshlab_filter import ConformalFilterException
from meshlab_filter import compute_texcoord_parametrization_conformal_disk as conformal_disk

NAME = "compute_texcoord_parametrization_conformal_disk"


@pytest.fixture
def face_of_mask():
    return mask(600)


REFUSALS = [
    ({"method": "magic"}, cuv.OptionError, "method"),
    ({"quality": "beauty"}, cuv.OptionError, "quality"),
    ({"center": 10**6}, cuv.OptionError, "belong to no selected face"),
    ({"center": "middle"}, cuv.OptionError, "vertex indices"),
    ({"seams": [(0, 300)]}, cuv.OptionError, "not edges"),
    ({"margin": 0.7}, cuv.OptionError, "margin"),
    ({"texture": "missing.png"}, cuv.ConformalUVError, "missing.png"),
    ({"callback": lambda stage, fraction: False}, cuv.CancelledError, "nothing was changed"),
]


@pytest.mark.parametrize("options, cause, text", REFUSALS, ids=lambda value: str(value)[:30])
def test_a_refusal_is_a_pymeshlab_exception_and_changes_nothing(face_of_mask, options, cause, text):
    ms = mesh_set(*face_of_mask)
    before = contents(ms)
    with pytest.raises(pymeshlab.PyMeshLabException, match=text) as caught:
        conformal_disk(ms, **options)
    assert isinstance(caught.value, ConformalFilterException)
    assert type(caught.value.__cause__) is cause
    assert str(caught.value.__cause__) in str(caught.value) and NAME in str(caught.value)
    assert changed(before, contents(ms)) == set()


def test_a_file_that_is_no_image_is_refused_before_anything_is_written(face_of_mask, tmp_path):
    (tmp_path / "image.png").write_text("no image")
    ms = mesh_set(*face_of_mask)
    before = contents(ms)
    with pytest.raises(ConformalFilterException, match=r"image\.png"):
        conformal_disk(ms, texture=tmp_path / "image.png")
    assert changed(before, contents(ms)) == set()


def test_indices_of_the_error_are_carried_along():
    V, F = plate(3, 3)
    V[5, 1] = np.nan
    with pytest.raises(ConformalFilterException) as caught:
        conformal_disk(mesh_set(V, F))
    assert caught.value.indices == (5,)
    assert isinstance(caught.value.__cause__, cuv.NonFiniteError)


def test_nothing_selected(face_of_mask):
    ms = mesh_set(*face_of_mask)
    ms.compute_selection_by_condition_per_face(condselect="0")
    with pytest.raises(ConformalFilterException, match="No face is selected"):
        conformal_disk(ms, selected_only=True)


@pytest.mark.parametrize("element", ["vertex", "face"])
def test_an_attribute_name_that_breaks_function_filters_is_found_before_anything_is_written(element, face_of_mask):
    V, F = face_of_mask
    ms = mesh_set(V, F)
    add = getattr(ms.current_mesh(), f"add_{element}_custom_scalar_attribute")
    add(np.zeros(len(V) if element == "vertex" else len(F)), "a.b")
    before = contents(ms)
    with pytest.raises(ConformalFilterException, match="custom attribute"):
        conformal_disk(ms)
    assert changed(before, contents(ms)) == set()


def test_no_mesh_and_no_faces():
    with pytest.raises(pymeshlab.PyMeshLabException, match="no current"):
        conformal_disk(pymeshlab.MeshSet())
    cloud = pymeshlab.MeshSet()
    cloud.add_mesh(pymeshlab.Mesh(np.eye(3)))
    with pytest.raises(ConformalFilterException, match="no polygons"):
        conformal_disk(cloud)


def test_registered_it_is_a_filter_like_pymeshlabs_own(face_of_mask):
    meshlab_filter.register()
    try:
        meshlab_filter.register()  # again does no harm
        ms = mesh_set(*face_of_mask)
        method = getattr(ms, NAME)
        numbers = method(method="linear")
        assert numbers == conformal_disk(mesh_set(*face_of_mask), method="linear")
        assert method.__name__ == NAME and method.__doc__ == conformal_disk.__doc__
        own, plain = (inspect.signature(f).parameters for f in (getattr(pymeshlab.MeshSet, NAME), conformal_disk))
        assert list(own)[1:] == list(plain)[1:] and own["method"].default == "auto"
        with pytest.raises(TypeError):
            method("linear")  # as pymeshlab's own: keywords only
        with pytest.raises(pymeshlab.PyMeshLabException, match="Parameter colour not found"):
            method(colour=1)
    finally:
        meshlab_filter.unregister()
    assert not hasattr(pymeshlab.MeshSet, NAME)
    meshlab_filter.unregister()


UNWRAPS = {
    "V", "polygons", "selection", "rotation", "tolerance", "relative_tolerance", "max_iterations", "outer_loop",
    "shape", "pinned_uv",
}  # fmt: skip
DISKS = {"method", "objective", "pins", "pin_mode", "center", "balance", "boundary_vertex"}
OWN = {"ms", "selected_only", "texture", "quality"}


@pytest.mark.parametrize(
    ("shape", "own", "others"),
    [
        ("disk", OWN, {"refine", "corner_choice"}),
        ("free", OWN, {*DISKS, "corner_choice"}),
        ("rectangle", {*OWN, "corners"}, {*DISKS, "refine"}),
    ],
)
def test_options_and_their_defaults_are_those_of_unwrap(shape, own, others):
    """But those that mean nothing for the shape; the corners of a rectangle are pins there."""
    function = getattr(meshlab_filter, f"{NAME.removesuffix('disk')}{shape}")
    ours, core = (inspect.signature(f).parameters for f in (function, cuv.unwrap))
    shared = ours.keys() & core.keys()
    assert {name: ours[name].default for name in shared} == {name: core[name].default for name in shared}
    assert ours.keys() - shared == own
    assert core.keys() - shared == UNWRAPS | others


@pytest.mark.parametrize("shape", ["disk", "free", "rectangle"])
def test_every_option_arrives_with_its_value(monkeypatch, shape):
    arrived = {}

    class Found:
        numbers = {}

    def taken(of, ms, **options):
        arrived.update(options, shape=of)
        return Found

    monkeypatch.setattr(f"meshlab_filter.{shape}.map_current_mesh", taken)
    function = getattr(meshlab_filter, f"{NAME.removesuffix('disk')}{shape}")
    given = {name: object() for name in inspect.signature(function).parameters if name != "ms"}
    function(None, **given)
    if shape == "rectangle":
        given["pins"] = given.pop("corners")
    assert arrived == {**given, "shape": shape}

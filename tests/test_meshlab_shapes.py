"""The filters for free boundaries and rectangles, and the script's --shape."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

from developable import folded_strip, sector_fan
from meshes import disjoint, plate
from meshlab_sets import TEXCOORDS, changed, contents, loaded, mesh_set, wedges
from test_meshlab_script import run, saved

import conformal_uv as cuv
import meshlab_filter
from conformal_uv.samples import mask
from meshlab_filter import ConformalFilterException
from meshlab_filter import compute_texcoord_parametrization_conformal_disk as conformal_disk
from meshlab_filter import compute_texcoord_parametrization_conformal_free as conformal_free
from meshlab_filter import compute_texcoord_parametrization_conformal_rectangle as conformal_rectangle

FILTERS = {"disk": conformal_disk, "free": conformal_free, "rectangle": conformal_rectangle}


def tilted() -> tuple[np.ndarray, np.ndarray]:
    """The mask, so that each of the ways to be upright is another."""
    V, F = mask(600)
    axes, _ = np.linalg.qr(np.array([[3.0, 1.0, 2.0], [1.0, 4.0, 1.0], [2.0, 0.0, 5.0]]))
    return V @ (axes * np.sign(np.linalg.det(axes))).T, F


@pytest.mark.parametrize("upright", ["z", "y", "none"])
@pytest.mark.parametrize("shape", FILTERS)
def test_writes_the_coordinates_of_unwrap_and_nothing_else(shape: str, upright: str):
    V, F = tilted()
    ms = mesh_set(V, F)
    before = contents(ms)
    numbers = FILTERS[shape](ms, upright=upright)
    assert changed(before, contents(ms)) == set(TEXCOORDS)
    expected = cuv.unwrap(V, F, shape=shape, upright=upright)
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), expected.uv.astype(np.float32))
    assert all(isinstance(value, int | float) for value in numbers.values())
    assert numbers["conformal_energy"] == expected.charts[0].map.conformal_energy
    assert numbers["coverage"] == cuv.unwrap_numbers(expected).coverage
    assert ("crossings" in numbers) is (shape == "free") and ("modulus" in numbers) is (shape == "rectangle")


def test_own_options_of_each_shape_reach_the_map():
    V, F = tilted()
    loop = cuv.free_map(V, F).boundary
    corners = loop[[3, 20, 40, 60]].tolist()
    cases = [
        ("free", {"refine": True}, {"refine": True}),
        ("free", {"place": "disk"}, {"place": "disk"}),
        ("rectangle", {"corners": corners}, {"pins": corners}),
        ("rectangle", {"corners": [corners]}, {"pins": corners}),
        ("rectangle", {"corner_choice": "area"}, {"corner_choice": "area"}),
    ]
    for shape, given, options in cases:
        ms = mesh_set(V, F)
        FILTERS[shape](ms, **given)
        expected = cuv.unwrap(V, F, shape=shape, **options).uv
        np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), expected.astype(np.float32))
    assert np.abs(expected - cuv.unwrap(V, F, shape="rectangle").uv).max() > 1e-3


def test_numbers_of_surfaces_that_are_known(caplog):
    """A strip of thirty by three has the modulus 10 or 1/10; 400 degrees around a point lie over themselves."""
    V, F, _ = folded_strip(30)
    numbers = conformal_rectangle(mesh_set(V, F))
    assert max(numbers["modulus"], 1 / numbers["modulus"]) == pytest.approx(10, rel=1e-12)
    assert numbers["modulus_low"] <= numbers["modulus"] <= numbers["modulus_high"]
    numbers = conformal_rectangle(mesh_set(*disjoint(plate(4, 3), plate(5, 2))))
    assert numbers["mapped_charts"] == 2 and "modulus" not in numbers
    assert conformal_free(mesh_set(V, F))["crossings"] == 0 and "share" not in caplog.text
    fan, faces, _ = sector_fan(400.0)
    assert conformal_free(mesh_set(fan, faces))["crossings"] > 0
    assert "The boundary of 1 charts crosses itself" in caplog.text


@pytest.mark.parametrize(
    ("shape", "options", "text"),
    [
        ("free", {"refine": "yes"}, "refine"),
        ("free", {"upright": "x"}, "upright"),
        ("rectangle", {"corners": [0, 20, 40]}, "a rectangle four"),
        ("rectangle", {"corners": [0, 20, 40, 599]}, "outer boundary"),
        ("rectangle", {"corner_choice": "best"}, "corner_choice"),
    ],
)
def test_a_refusal_names_the_filter_and_changes_nothing(shape: str, options: dict, text: str):
    ms = mesh_set(*mask(600))
    before = contents(ms)
    with pytest.raises(ConformalFilterException, match=text) as caught:
        FILTERS[shape](ms, **options)
    assert FILTERS[shape].__name__ in str(caught.value)
    assert changed(before, contents(ms)) == set()


def test_registered_together_and_taken_off_again():
    meshlab_filter.register()
    try:
        ms = mesh_set(*mask(600))
        for shape, function in FILTERS.items():
            assert getattr(ms, function.__name__)() == function(mesh_set(*mask(600))), shape
        with pytest.raises(pymeshlab.PyMeshLabException, match="Parameter center not found"):
            ms.compute_texcoord_parametrization_conformal_free(center=3)
    finally:
        meshlab_filter.unregister()
    assert not any(hasattr(pymeshlab.MeshSet, function.__name__) for function in FILTERS.values())


def test_the_script_maps_to_the_shape_that_is_asked_for(tmp_path: Path):
    V, F = tilted()
    source = saved(tmp_path / "in.ply", V, F)
    boundary = cuv.free_map(V, F).boundary
    corners = boundary[[3, 20, 40, 60]].tolist()
    inner = int(np.setdiff1d(np.arange(len(V)), boundary)[0])
    cases = {
        ("free", "--refine", "--upright", "y"): {"shape": "free", "refine": True, "upright": "y"},
        ("rectangle", "--corners", ",".join(map(str, corners))): {"shape": "rectangle", "pins": corners},
        ("disk", "--center", inner): {"shape": "disk", "center": inner},
    }
    for (shape, *options), expected in cases.items():
        run(source, tmp_path / "out.ply", "--shape", shape, *options, "--json", tmp_path / "n.json", "-q")
        uv = loaded(tmp_path / "out.ply").wedge_tex_coord_matrix()
        np.testing.assert_array_equal(uv, cuv.unwrap(V, F, **expected).uv.astype(np.float32))
        assert json.loads((tmp_path / "n.json").read_text())["shape"] == shape


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--shape", "free", "--center", "0"], "--center is for --shape disk"),
        (["--refine"], "--refine is for --shape free"),
        (["--shape", "free", "--corner-choice", "area"], "--corner-choice is for --shape rectangle"),
        (["--shape", "rectangle", "--corners", "1,2,3"], "not four vertex numbers"),
        (["--shape", "rectangle", "--corners", "0,20,40,499"], "outer boundary"),
    ],
)
def test_the_script_refuses_in_one_line_what_is_of_another_shape(tmp_path: Path, options: list[str], text: str):
    source = saved(tmp_path / "in.ply", *mask(500))
    done = run(source, tmp_path / "out.ply", *options, code=1)
    assert text in done.stderr and len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "out.ply").exists()

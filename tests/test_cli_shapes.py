"""conformal-uv free and rectangle, run as a user runs them."""

from __future__ import annotations

import inspect
import json
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from developable import DEVELOPABLE, cylinder, folded_strip, sector_fan
from numpy.typing import NDArray
from test_cli import run

import conformal_uv as cuv
from conformal_uv.files import read_mesh
from conformal_uv.samples import mask

Real = NDArray[np.float64]
Faces = NDArray[np.integer]
SHAPES = ("disk", "free", "rectangle")


def saved(path: Path, V: Real, F: Faces) -> Path:
    """An OBJ with all digits."""
    text = "".join("v {:.17g} {:.17g} {:.17g}\n".format(*v) for v in V)
    path.write_text(text + "".join("f " + " ".join(map(str, f + 1)) + "\n" for f in np.asarray(F)))
    return path


def sides(corners: Real) -> Real:
    return np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)


def angles(corners: Real) -> Real:
    """Degrees at each corner of triangles (m, 3, d), by the half angles' tangents."""
    a, b, c = np.moveaxis(sides(corners)[:, [[1, 2, 0], [2, 0, 1], [0, 1, 2]]], 1, 0)
    half = (a + b + c) / 2
    return np.degrees(2 * np.arctan2(np.sqrt((half - b) * (half - c)), np.sqrt(half * (half - a))))


def assert_unrolled(V: Real, F: Faces, uv: Real) -> None:
    """Issue's bounds: 1e-6 degrees, and lengths to 1e-9 after one common scale."""
    space, plane = V[F], uv.reshape(-1, 3, 2)
    assert np.abs(angles(plane) - angles(space)).mean() <= 1e-6
    ratio = sides(plane) / sides(space)
    np.testing.assert_allclose(ratio, ratio.mean(), rtol=1e-9)


@pytest.mark.parametrize("name", DEVELOPABLE)
def test_what_can_be_unrolled_comes_out_unrolled(tmp_path: Path, name: str):
    V, F, _ = DEVELOPABLE[name]()
    run("free", saved(tmp_path / "in.obj", V, F), tmp_path / "out.obj", "-q")
    uv = read_mesh(tmp_path / "out.obj").corner_uv
    assert_unrolled(V, F, uv)
    assert uv.min() >= 0 and uv.max() <= 1 and np.ptp(uv, axis=0).max() == pytest.approx(1, abs=1e-11)


def test_a_tube_is_unrolled_along_its_seam(tmp_path: Path):
    """The prism closed again: without the seam one of its rims is filled, and it does not unroll."""
    V, F, _ = cylinder(24, 6)
    F = np.where(F >= 24 * 7, F - 24 * 7, F)  # the last row of vertices is the first
    source = saved(tmp_path / "in.obj", V[: 24 * 7], F)
    (tmp_path / "seam.txt").write_text("".join(f"{j} {j + 1}\n" for j in range(6)))
    run("free", source, tmp_path / "out.obj", "--seams", tmp_path / "seam.txt", "-q")
    assert_unrolled(V, F, read_mesh(tmp_path / "out.obj").corner_uv)
    run("free", source, tmp_path / "whole.obj", "-q")
    with pytest.raises(AssertionError):
        assert_unrolled(V, F, read_mesh(tmp_path / "whole.obj").corner_uv)


def test_a_strip_becomes_a_rectangle_with_its_corners_at_the_sides(tmp_path: Path):
    """Thirty by three: flat, so the map is the strip itself, scaled to the square; the modulus is 10 or 1/10."""
    V, F, xy = folded_strip(30)
    at = [int(np.flatnonzero((xy == corner).all(axis=1))[0]) for corner in ((0, 0), (30, 0), (30, 3), (0, 3))]
    source = saved(tmp_path / "in.obj", V, F)
    given = ["--corners", ",".join(map(str, at)), "--json", tmp_path / "n.json"]
    done = run("rectangle", source, tmp_path / "out.obj", *given)
    uv = read_mesh(tmp_path / "out.obj").corner_uv.reshape(-1, 3, 2)
    np.testing.assert_allclose(uv, xy[F] / 30 + [0.0, 0.45], atol=1e-11)
    for axis, end in ((0, 0), (0, 30), (1, 0), (1, 3)):
        assert len(np.unique(uv[..., axis][xy[F][..., axis] == end])) == 1  # straight to the last bit
    told = json.loads((tmp_path / "n.json").read_text())
    assert told["shape"] == "rectangle" and told["corners"] == at
    assert told["modulus"] == pytest.approx(10, rel=1e-12)
    low, high = told["modulus_bounds"]
    assert low <= 10 <= high < 10 + 1e-9
    assert told["coverage"] == pytest.approx(0.1, rel=1e-9)  # 30 by 3 in a square of 30
    assert "modulus" in done.stdout and "certainly between" in done.stdout
    turned = ["--corners", ",".join(map(str, at[1:] + at[:1])), "--json", tmp_path / "n.json", "-q"]
    run("rectangle", source, tmp_path / "out.obj", *turned)
    assert json.loads((tmp_path / "n.json").read_text())["modulus"] == pytest.approx(0.1, rel=1e-12)


def test_a_boundary_that_crosses_itself_is_warned_of(tmp_path: Path):
    """Four hundred degrees around a point lie over themselves in the plane, a hundred and fifty do not."""
    for degrees, crosses in ((400.0, True), (150.0, False)):
        V, F, _ = sector_fan(degrees)
        done = run("free", saved(tmp_path / "in.obj", V, F), tmp_path / "out.obj", "--json", tmp_path / "n.json")
        told = json.loads((tmp_path / "n.json").read_text())
        assert told["shape"] == "free" and (told["crossings"] > 0) is crosses
        assert ("overlap: the boundary crosses itself" in " ".join(done.stdout.split())) is crosses


def test_refine_and_margin_and_the_choice_of_corners_reach_the_map(tmp_path: Path):
    V, F = mask(400)
    source = saved(tmp_path / "in.obj", V, F)
    cases = {
        ("free", "--refine", "--margin", "0.1"): {"shape": "free", "refine": True, "margin": 0.1},
        ("rectangle", "--corner-choice", "area"): {"shape": "rectangle", "corner_choice": "area"},
        ("disk", "--upright", "none"): {"upright": "none"},
    }
    plain = {shape: cuv.unwrap(V, F, shape=shape).uv for shape in SHAPES}
    for (shape, *options), expected in cases.items():
        run(shape, source, tmp_path / "out.obj", *options, "-q")
        uv = read_mesh(tmp_path / "out.obj").corner_uv
        np.testing.assert_array_equal(uv, cuv.unwrap(V, F, **expected).uv)
        assert np.abs(uv - plain[shape]).max() > 1e-3


@pytest.mark.parametrize("shape", SHAPES)
def test_every_option_of_a_command_arrives_and_has_the_default_of_unwrap(monkeypatch, shape: str):
    arrived = {}
    module = import_module(f"conformal_uv.cli.{shape}")
    monkeypatch.setattr(module, "unwrap_file", lambda of, **options: arrived.update(options, shape=of))
    command, core = getattr(module, shape), inspect.signature(cuv.unwrap).parameters
    parameters = inspect.signature(command).parameters
    for name in parameters.keys() & core.keys():
        assert parameters[name].default == core[name].default, name
    given = {name: object() for name in parameters}
    mpi = {
        name: given.pop(name) for name in given.keys() & {"solver"}
    }  # of one surface over MPI, which is no file here
    numbers = {"disk": ("pins", "1,2,3", [1, 2, 3]), "rectangle": ("corners", "1,2,3,4", [1, 2, 3, 4])}
    if shape in numbers:
        name, text, wanted = numbers[shape]
        command(**{**given, **mpi, name: text})
        del given[name]
        given["pins"] = wanted
    else:
        command(**given, **mpi)
    assert arrived == {**given, "shape": shape}


INNER = "1499"  # of the mask: its boundary comes first


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["rectangle", "--corners", "0,20,40"], 2, "four vertex numbers"),
        (["rectangle", "--corners", "0,20,40,x"], 2, "four vertex numbers"),
        (["rectangle", "--corners", f"0,20,40,{INNER}"], 1, "all on the outer boundary"),
        (["rectangle", "--corners", "0,20,40,99999"], 1, "OptionError"),
        (["rectangle", "--corner-choice", "magic"], 2, "magic"),
        (["rectangle", "--pins", "0,20,40"], 2, "--pins"),
        (["free", "--center", "5"], 2, "--center"),
        (["free", "--corners", "0,20,40,60"], 2, "--corners"),
        (["disk", "--refine"], 2, "--refine"),
        (["free", "--upright", "x"], 2, "upright"),
        (["free", "--margin", "0.7"], 1, "margin is 0.7"),
    ],
)
def test_what_does_not_fit_is_refused_and_leaves_no_output(tmp_path: Path, arguments: list[str], code: int, words: str):
    source = saved(tmp_path / "in.obj", *mask(1500))
    done = run(arguments[0], source, tmp_path / "out.obj", *arguments[1:], check=code)
    assert words in done.stderr and not (tmp_path / "out.obj").exists()
    if code == 1:
        assert len(done.stderr.splitlines()) == 1


@pytest.mark.parametrize("shape", ["free", "rectangle"])
def test_pictures_of_all_shapes(tmp_path: Path, shape: str):
    source = saved(tmp_path / "in.obj", *mask(300))
    run(shape, source, tmp_path / "out.obj", "--plot", tmp_path / "p.png", "-q")
    assert (tmp_path / "p.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("shape", SHAPES)
def test_packing_is_that_of_the_library(tmp_path: Path, shape: str):
    """All options of packing, on pieces like an L, which lie in each other's bays where outlines are packed."""
    x, y = (grid.ravel() for grid in np.meshgrid(np.arange(5.0), np.arange(5.0)))
    k = np.array([5 * row + column for row in range(4) for column in range(4) if row < 1 or column < 1])
    F = np.concatenate((np.column_stack((k, k + 1, k + 6)), np.column_stack((k, k + 6, k + 5))))
    used, F = np.unique(F, return_inverse=True)
    V, F = np.column_stack((x, y, 0 * x))[used], F.reshape(-1, 3)
    count = len(V)
    V = np.concatenate([size * V + [10.0 * number, 0.0, 0.0] for number, size in enumerate((1.0, 0.8, 0.7))])
    F = np.concatenate([F + count * number for number in range(3)])
    how = ["--margin", "4", "--margin-method", "pixels", "--image-size", "256", "--pack-rotation", "any"]
    how += ["--pack-shape", "convex", "--tile", "1012"]
    options = {"margin": 4, "margin_method": "pixels", "image_size": 256, "pack_rotation": "any"}
    options |= {"pack_shape": "convex", "tile": 1012, "upright": "z"}
    source = saved(tmp_path / "in.obj", V, F)
    for more, also in (([], {}), (["--keep-scale"], {"keep_scale": True})):
        run(shape, source, tmp_path / "out.obj", *how, *more, "-q")
        uv = read_mesh(tmp_path / "out.obj").corner_uv
        expected = cuv.unwrap(V, F, shape=shape, **options, **also)
        np.testing.assert_allclose(uv, expected.uv, atol=1e-12)
        assert uv.min() >= 1.0 and (more or uv.max() <= 2.0)

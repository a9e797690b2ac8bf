"""The numbers of maps: each door shows the same, as stored."""

from __future__ import annotations

import json

import numpy as np
import pytest
from meshes import disjoint, plate
from typer.testing import CliRunner

import conformal_uv as cuv
from conformal_uv.report import distortion_numbers, unwrap_numbers
from conformal_uv.samples import mask

TWO = disjoint(mask(300), plate(6, 5))


def test_numbers_against_the_arrays_they_sum_up() -> None:
    result = cuv.unwrap(*TWO, method="linear")
    numbers = unwrap_numbers(result)
    V, F = TWO
    corners = result.uv.reshape(-1, 3, 2)
    image = np.zeros((len(V), 2))
    image[F] = corners
    error = cuv.distortion(V, F, image).angle_error
    d = numbers.distortion
    assert d.angle_mean == pytest.approx(error.mean(), rel=1e-9)
    assert d.angle_rms == pytest.approx(np.sqrt((error**2).mean()), rel=1e-9)
    assert d.angle_sd == pytest.approx(error.std(), rel=1e-9)
    assert d.angle_max == pytest.approx(error.max(), rel=1e-9)
    area = cuv.distortion(V, F, image).area_scale  # as stored: charts packed at the sizes they have
    assert d.area_ratio == pytest.approx(area.max() / area.min(), rel=1e-9)
    assert (numbers.charts, numbers.mapped_charts, numbers.converged_charts) == (2, 2, 2)
    assert numbers.triangles == len(F) and numbers.vertices == len(V)
    assert numbers.conformal_energy == sum(chart.map.conformal_energy for chart in result.charts)


def test_charts_that_are_not_chosen_lose_nothing() -> None:
    """A ribbon fifty times as long as wide is crowded beyond single precision at its ends."""
    result = cuv.unwrap(*plate(100, 2), method="linear", repair="never")
    assert unwrap_numbers(result).lost_to_float32.sum() > 0
    assert unwrap_numbers(result, chosen=np.array([False])).lost_to_float32.tolist() == [0]


def test_the_ratio_of_areas_is_that_of_triangles_that_have_some() -> None:
    """Three triangles at a corner: mapped to four times the area, to itself, to a line."""
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0.0]])
    F = [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    image = V[:, :2] * [[1, 1], [4, 1], [1, 1], [1, 1], [0, 0]]
    assert distortion_numbers([cuv.distortion(V, F, image)]).area_ratio == pytest.approx(4.0, rel=1e-15)
    flat = distortion_numbers([cuv.distortion(V, F[2:], image)])
    assert flat.area_ratio is None and flat.quasi_conformal_max == np.inf


def test_vertices_of_several_charts_count_once() -> None:
    """A plate of 6 x 5 quads cut in two along a grid line: the caller's vertices, however many charts have them."""
    V, F = plate(6, 5)
    line = np.flatnonzero(V[:, 0] == V[3, 0])
    result = cuv.unwrap(V, F, seams=np.column_stack((line[:-1], line[1:])), method="linear", place="disk")
    numbers = unwrap_numbers(result)
    assert numbers.charts == 2 and sum(len(chart.vertices) for chart in result.charts) == len(V) + len(line)
    assert numbers.vertices == len(V) and numbers.triangles == len(F)


def test_charts_that_reach_out_of_the_square_have_no_coverage() -> None:
    """On whichever of its sides."""
    result = cuv.unwrap(*TWO, method="linear")
    assert unwrap_numbers(result).coverage > 0.0
    for way in ([0.5, 0.0], [0.0, 0.5], [-0.5, 0.0], [0.0, -0.5]):
        assert unwrap_numbers(result, uv=result.uv + way).coverage is None


def test_some_charts_and_none() -> None:
    result = cuv.unwrap(*TWO, method="linear")
    one = unwrap_numbers(result, chosen=np.array([True, False]))
    assert one.mapped_charts == 1
    assert one.distortion.angle_mean == distortion_numbers([result.charts[0].distortion]).angle_mean
    none = unwrap_numbers(result, chosen=np.array([False, False]))
    assert none.distortion is None and len(none.flipped) == 0 and none.lost_to_float32.sum() == 0


def test_the_command_and_the_filter_show_these_numbers(tmp_path) -> None:
    pymeshlab = pytest.importorskip("pymeshlab")
    from conformal_uv.cli.app import app
    from meshlab_filter import compute_texcoord_parametrization_conformal_disk as conformal_disk

    V, F = TWO
    path = tmp_path / "two.npz"
    np.savez(path, V=V, F=F)
    expected = unwrap_numbers(cuv.unwrap(V, F, method="linear"))
    done = CliRunner().invoke(
        app, ["disk", str(path), str(tmp_path / "out.npz"), "--method", "linear", "--json", str(tmp_path / "n.json")]
    )
    assert done.exit_code == 0, done.output
    told = json.loads((tmp_path / "n.json").read_text())
    d = expected.distortion
    assert told["angle_error_degrees"] == {
        "mean": d.angle_mean,
        "rms": d.angle_rms,
        "sd": d.angle_sd,
        "max": d.angle_max,
    }
    assert told["area_ratio"] == d.area_ratio
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(V, F))
    filtered = conformal_disk(ms, method="linear")
    assert filtered["angle_error_rms"] == pytest.approx(d.angle_rms, rel=1e-9)
    assert filtered["lost_to_float32"] == expected.lost_to_float32.sum()


def test_flipped_polygons_by_exact_signs() -> None:
    V = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0.0]])
    mesh = cuv.PolygonMesh(V, np.array([0, 1, 4, 3, 1, 2, 5, 4]), np.array([0, 4, 8]))
    uv = V[mesh.corners, :2]
    assert cuv.flipped_polygons(mesh, uv).tolist() == []
    flat = uv.astype(np.float32)
    flat[4:, 0] = 1.0  # the second without width
    assert cuv.flipped_polygons(mesh, flat).tolist() == [1]
    assert cuv.flipped_polygons(mesh, uv[:, ::-1]).tolist() == [0, 1]
    hair = uv.copy()
    hair[[5, 6], 0] = np.nextafter(1.0, 2.0)  # the least width that a double can hold
    assert cuv.flipped_polygons(mesh, hair).tolist() == []
    hair[[5, 6]] = np.nan
    assert cuv.flipped_polygons(mesh, hair).tolist() == [1]


def test_polygon_angle_errors_by_the_arc_cosine():
    """Triangles by their angles; a quad as the worse of its triangles; a mirror image as what it mirrors."""
    rng = np.random.default_rng(3)
    V, uv = rng.normal(size=(30, 3)), rng.normal(size=(30, 2))
    mesh = cuv.PolygonMesh(V, np.arange(30), np.arange(0, 31, 3))

    def angles(points):
        sides = np.roll(points, -1, axis=1) - points, np.roll(points, 1, axis=1) - points
        cosine = (sides[0] * sides[1]).sum(axis=2) / np.prod([np.linalg.norm(side, axis=2) for side in sides], axis=0)
        return np.degrees(np.arccos(cosine))

    expected = np.abs(angles(V.reshape(-1, 3, 3)) - angles(uv.reshape(-1, 3, 2))).max(axis=1)
    np.testing.assert_allclose(cuv.polygon_angle_errors(mesh, uv), expected, atol=1e-9)
    square = cuv.PolygonMesh(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.arange(4), np.array([0, 4]))
    assert cuv.polygon_angle_errors(square, square.V[:, [1, 0]]) == pytest.approx([0.0], abs=1e-9)
    sheared = square.V[:, :2] @ np.array([[1.0, 0.0], [1.0, 1.0]])
    assert cuv.polygon_angle_errors(square, sheared)[0] == pytest.approx(45.0)
    broken = square.V[:, :2].copy()
    broken[0] = np.nan
    assert np.isfinite(cuv.polygon_angle_errors(square, broken)).all()

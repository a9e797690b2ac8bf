"""Intrinsic Delaunay flips around fans of thousands of triangles: few, local, and the same whatever the way."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import fan

import conformal_uv as cuv
from conformal_uv.mesh.geometry import TriangleGeometry
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators import intrinsic_delaunay as flips
from conformal_uv.operators.edge_flips import EdgeFlips
from conformal_uv.operators.edge_laplacian import edge_laplacian
from conformal_uv.operators.intrinsic_delaunay import IntrinsicTriangulation, intrinsic_delaunay
from conformal_uv.operators.single_flips import flip_one_by_one


def polygon_fan(triangles: int, x: np.ndarray, y: np.ndarray) -> Surface:
    """All diagonals from corner 0 of a polygon of triangles + 2 corners."""
    V = np.column_stack((x, y, np.zeros(triangles + 2)))
    k = np.arange(1, triangles + 1)
    return Surface.from_arrays(V, np.column_stack((0 * k, k, k + 1)))


def ellipse(triangles: int, width: float) -> Surface:
    """From the end of the long axis: every flip waits for the one before."""
    t = 2.0 * np.pi * np.arange(triangles + 2) / (triangles + 2)
    return polygon_fan(triangles, np.cos(t), width * np.sin(t))


def bumpy(triangles: int) -> Surface:
    """Rays of random lengths over 170 degrees."""
    t = np.concatenate(([0.0], np.linspace(0.1, np.pi - 0.1, triangles + 1)))
    reach = 1.0 + 0.3 * np.random.default_rng(0).random(triangles + 2)
    reach[0] = 0.0
    return polygon_fan(triangles, reach * np.cos(t), reach * np.sin(t))


def flipped(surface: Surface, **options: int) -> IntrinsicTriangulation:
    return intrinsic_delaunay(surface.corners, np.sqrt(surface.geometry.squared_lengths), surface.edges.twin, **options)


def least_excess(found: IntrinsicTriangulation) -> float:
    """The least cot a + cot b of inner edges, over the size of the two.

    Where four vertices are on one circle rounding of their lengths decides, more so in thin triangles.
    """
    inner = np.flatnonzero(found.twin >= 0)
    cot = np.roll(found.cotangents, 1, axis=0).reshape(-1)  # the corner opposite to half-edge c is c + 2
    here, there = cot[inner], cot[found.twin[inner]]
    return float(((here + there) / (np.abs(here) + np.abs(there) + 1.0)).min())


@pytest.mark.parametrize("make", [lambda m: ellipse(m, 0.02), bumpy])
def test_a_fan_takes_a_few_flips_a_triangle_and_is_delaunay(make, monkeypatch: pytest.MonkeyPatch) -> None:
    rounds: list[int] = []
    work = EdgeFlips.flip
    monkeypatch.setattr(EdgeFlips, "flip", lambda self, h, waiting: (rounds.append(len(h)), work(self, h, waiting))[1])
    for triangles in (3_000, 30_000):
        rounds.clear()
        surface = make(triangles)
        found = flipped(surface)
        assert found.finished
        assert 0.5 * triangles < found.flips < 2.0 * triangles
        assert len(rounds) < 60
        assert least_excess(found) >= -1e-11
        np.testing.assert_array_equal(found.twin[found.twin[found.twin >= 0]], np.flatnonzero(found.twin >= 0))
        assert np.isclose(cuv.face_areas(surface.V, surface.F).sum(), 0.5 * areas(found), rtol=1e-9)


def areas(found: IntrinsicTriangulation) -> float:
    x, y, z = found.lengths
    half = 0.5 * (x + y + z)
    return float(2.0 * np.sqrt(np.maximum(half * (half - x) * (half - y) * (half - z), 0.0)).sum())


def test_flips_one_by_one_come_to_what_flips_in_batches_come_to() -> None:
    surface = bumpy(500)
    together = flipped(surface)
    lengths = np.sqrt(surface.geometry.squared_lengths)
    geometry = surface.geometry
    work = EdgeFlips(
        surface.corners.copy(),
        lengths,
        surface.edges.twin.copy(),
        geometry.double_area.copy(),
        geometry.dot / geometry.double_area,
    )
    inner = np.flatnonzero(work.twin >= 0)
    left = flip_one_by_one(work, inner, 100)
    assert work.flips == 100 and len(left)
    assert not len(flip_one_by_one(work, left.astype(np.intp), 100_000))
    assert edge_set(work.corners) == edge_set(together.corners)
    np.testing.assert_array_equal(np.sort(work.touched), np.sort(np.isin(np.arange(work.m), together.changed)))


def edge_set(corners: np.ndarray) -> set[tuple[int, int]]:
    pairs = np.sort(np.stack((corners, corners[[1, 2, 0]])).reshape(2, -1), axis=0)
    return set(map(tuple, pairs.T.tolist()))


def test_the_same_flips_every_time() -> None:
    one, other = flipped(ellipse(2_000, 0.5)), flipped(ellipse(2_000, 0.5))
    for name in ("corners", "lengths", "twin", "cotangents", "changed"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_flips_that_would_go_on_for_long_are_ended_and_leave_the_true_laplacian(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The surface is flat: every triangulation of it has the Dirichlet energy of a linear function."""
    monkeypatch.setattr(flips, "LEAST_FLIPS", 0)
    surface = ellipse(3_000, 2.0)  # from the end of the short axis: the square of their number
    found = flipped(surface, effort=4)
    assert not found.finished and 0 < found.flips <= 8 * surface.m
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, "auto", effort=4)
    assert laplacian.weights.min() < 0.0
    area = 0.5 * surface.geometry.double_area.sum()
    z = surface.V[:, 0] + 1j * surface.V[:, 1]
    assert laplacian.energy(z) == pytest.approx(area, rel=1e-6)  # 1/2 (|grad x|^2 + |grad y|^2), over the area


def test_a_fan_without_interior_vertex_is_mapped() -> None:
    m = cuv.disk_map(*fan(30_000), method="linear")
    assert not len(m.flipped)
    assert (np.diff(np.unwrap(np.arctan2(m.uv[m.boundary, 1], m.uv[m.boundary, 0]))) > 0.0).all()


@pytest.mark.parametrize("order", ["C", "F"])
def test_flips_do_not_mind_how_the_geometry_lies_in_memory(order: str) -> None:
    """Part of a geometry's columns, of a sphere without a vertex's star say, may lie face by face."""
    surface = ellipse(40, 0.2)
    geometry = TriangleGeometry(np.array(surface.geometry.dot, order=order), surface.geometry.double_area)
    lengths = np.array(np.sqrt(geometry.squared_lengths), order=order)
    found = intrinsic_delaunay(surface.corners, lengths, surface.edges.twin, geometry=geometry)
    assert found.flips > 0 and found.finished
    m, h = surface.m, np.flatnonzero(found.twin >= 0)
    cot = found.cotangents.reshape(-1)
    sums = cot[(h + 2 * m) % (3 * m)] + cot[(found.twin[h] + 2 * m) % (3 * m)]
    assert sums.min() >= -1e-9

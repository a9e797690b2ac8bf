"""Islands of stored UVs, those that are disks, and the Moebius maps that slide them."""

from __future__ import annotations

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.operators.round_place import fitted_place
from conformal_uv.samples import mask


def stored(V, F, uv, scale=(0.5, 0.5), at=(0.5, 0.5)):
    """A triangle mesh and its UVs as Blender stores them, one for every corner, in single precision."""
    mesh = cuv.PolygonMesh(V, F.reshape(-1).astype(np.int64), np.arange(0, 3 * len(F) + 1, 3))
    return mesh, (np.asarray(at) + np.asarray(scale) * uv)[F.reshape(-1)].astype(np.float32)


@pytest.fixture(scope="module")
def disk():
    V, F = mask(700)
    return V, F, cuv.disk_map(V, F)


CENTERS = [0.0, 0.3 + 0.2j, -0.7j, 0.9 - 0.1j]


@pytest.mark.parametrize("center", CENTERS)
@pytest.mark.parametrize("rotation", [0.0, 1.0, -3.0])
def test_center_and_rotation_are_read_back(center, rotation):
    moebius = cuv.Moebius.of_disk(center, rotation)
    there, turned = moebius.center_and_rotation()
    assert abs(there - center) < 1e-15 and abs(np.exp(1j * (turned - rotation)) - 1.0) < 1e-14
    circle = np.exp(1j * np.linspace(0.0, 6.0, 50))
    np.testing.assert_allclose(np.abs(moebius(circle)), 1.0, rtol=0, atol=1e-13)
    step = 1e-6 * np.exp(1j * rotation)
    direction = (moebius(1e-6) - moebius(0.0)) / step
    assert abs(np.angle(direction)) < 1e-5 and direction.real > 0.0  # directions at 0 turn by `rotation`


def test_a_translation_moves_along_the_geodesic():
    p, q = 0.4 - 0.3j, -0.2 + 0.5j
    moved = cuv.Moebius.disk_translation(p, q)
    assert abs(complex(moved(p)) - q) < 1e-15
    # Fixed points are the ends of the geodesic through p and q: on the circle, with a real cross-ratio.
    roots = np.roots([moved.c, moved.d - moved.a, -moved.b])
    np.testing.assert_allclose(np.abs(roots), 1.0, atol=1e-12)
    ratio = (p - roots[0]) * (q - roots[1]) / ((p - roots[1]) * (q - roots[0]))
    assert abs(ratio.imag) < 1e-12
    back = cuv.Moebius.disk_translation(q, p) @ moved
    z = np.array([0.1, 0.5j, -0.8])
    np.testing.assert_allclose(back(z), z, atol=1e-14)


def test_drags_in_turn_are_one_map():
    one = cuv.Moebius.disk_translation(0.1, 0.4 + 0.2j) @ cuv.Moebius.of_disk(0.2j, 0.7)
    both = cuv.Moebius.disk_translation(-0.3, 0.1j) @ one
    same = cuv.Moebius.of_disk(*both.center_and_rotation())
    z = np.exp(1j * np.arange(6.0)) * np.linspace(0.0, 1.0, 6)
    np.testing.assert_allclose(same(z), both(z), atol=1e-14)


@pytest.mark.parametrize("bad", [1.0, 2j])
def test_centers_outside_the_disk_are_refused(bad):
    with pytest.raises(cuv.OptionError, match="not inside"):
        cuv.Moebius.of_disk(bad)
    with pytest.raises(cuv.OptionError, match="not inside"):
        cuv.Moebius.disk_translation(0.0, bad)


@pytest.mark.parametrize(("scale", "at"), [((0.5, 0.5), (0.5, 0.5)), ((0.1, 0.1), (3.0, -2.0)), ((0.2, 0.4), (0.0, 1))])
def test_a_disk_map_is_found_where_it_lies(disk, scale, at):
    V, F, m = disk
    (island,) = cuv.disk_islands(*stored(V, F, m.uv, scale, at))
    np.testing.assert_allclose(island.place.center, at, atol=1e-6)
    np.testing.assert_allclose(island.place.radii, scale, atol=1e-6)
    assert set(island.vertex[island.rim]) == set(m.boundary)
    np.testing.assert_allclose(island.z, m.uv[island.vertex].view(np.complex128)[:, 0], atol=5e-5 * 0.1 / min(scale))


def test_moving_is_the_moebius_map_and_the_boundary_stays_on_the_circle(disk):
    V, F, m = disk
    mesh, uv = stored(V, F, m.uv)
    (island,) = cuv.disk_islands(mesh, uv)
    moebius = cuv.Moebius.of_disk(0.4 - 0.3j, 0.6)
    expected = moebius(m.uv.view(np.complex128)[:, 0])[F.reshape(-1)].view(np.float64).reshape(-1, 2)
    moved = np.empty_like(uv, dtype=float)
    moved[island.corners] = island.moved(moebius)
    # Single precision of UVs near 1 and 0.5 (6e-8), stretched by at most (1 + |c|) / (1 - |c|) = 3, in radii of 0.5.
    np.testing.assert_allclose(moved, 0.5 + 0.5 * expected, atol=1e-6)
    rim = np.isin(F.reshape(-1), m.boundary)
    np.testing.assert_allclose(np.hypot(*(moved[rim] - island.place.center).T), island.place.radii[0], atol=1e-14)


def test_what_is_no_disk_is_not_taken(disk):
    V, F, m = disk
    free = cuv.free_map(V, F)
    assert cuv.disk_islands(*stored(V, F, free.uv)) == []
    assert cuv.disk_islands(*stored(V, F, m.uv + 0.01 * m.uv**2)) == []
    square = cuv.PolygonMesh(np.zeros((4, 3)), np.arange(4), np.array([0, 4]))
    assert cuv.disk_islands(square, [[0, 0], [1, 0], [1, 1], [0, 1]]) == []  # its corners lie on a circle
    bad = np.full((3 * len(F), 2), np.nan)
    assert cuv.disk_islands(stored(V, F, m.uv)[0], bad) == []
    sphere = cuv.PolygonMesh(np.eye(4, 3), np.array([0, 1, 2, 0, 2, 3, 0, 3, 1, 3, 2, 1]), np.arange(0, 13, 3))
    assert cuv.disk_islands(sphere, np.arange(8.0).reshape(4, 2)[sphere.corners]) == []


def test_islands_apart_and_faces_left_out(disk):
    V, F, m = disk
    two = np.concatenate((F, F + len(V)))
    uv = np.concatenate((m.uv, 0.5 * m.uv + 3.0))
    mesh, corner_uv = stored(np.concatenate((V, V)), two, uv)
    islands = cuv.disk_islands(mesh, corner_uv)
    assert sorted(len(island.corners) for island in islands) == [F.size, F.size]
    assert [island.contains([0.5, 0.5]) for island in islands] == [True, False]
    assert [island.contains([2.0, 2.0]) for island in islands] == [False, True]
    (second,) = cuv.disk_islands(mesh, corner_uv, np.arange(len(two)) >= len(F))
    np.testing.assert_array_equal(second.faces, np.arange(len(F), len(two)))
    assert second.corners.min() == F.size


def test_of_a_ring_the_outer_boundary_counts():
    angle = np.linspace(0.0, 2.0 * np.pi, 25)[:-1]
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    uv = np.concatenate((0.4 * circle + 0.1, circle))
    k = np.arange(24)
    quads = np.column_stack((k, k + 24, (k + 1) % 24 + 24, (k + 1) % 24))
    mesh = cuv.PolygonMesh(np.column_stack((uv, 0 * uv[:, 0])), quads.reshape(-1), np.arange(0, 97, 4))
    (island,) = cuv.disk_islands(mesh, uv[quads.reshape(-1)])
    np.testing.assert_allclose(island.place.radii, 1.0, atol=1e-12)
    assert set(island.vertex[island.rim]) == set(range(24, 48))


def test_a_side_with_two_uvs_parts_islands():
    mesh = cuv.PolygonMesh(np.eye(4, 3), np.array([0, 1, 2, 0, 2, 3]), np.array([0, 3, 6]))
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]], dtype=float)
    whole = cuv.uv_islands(mesh, uv)
    assert whole.count == 1 and len(whole.vertex) == 4 and len(whole.rim_sides) == 4
    uv[4] += 1e-6
    parted = cuv.uv_islands(mesh, uv)
    assert parted.island.tolist() == [0, 1] and len(parted.vertex) == 5 and len(parted.rim_sides) == 6
    assert cuv.uv_islands(mesh, uv, [False, True]).island.tolist() == [-1, 0]
    assert cuv.uv_islands(mesh, uv, [False, False]).count == 0


@pytest.mark.parametrize("mirrored", [1.0, -1.0])
def test_an_island_as_a_surface_of_its_own(disk, mirrored):
    V, F, m = disk
    two = np.concatenate((F, F + len(V)))
    uv = np.concatenate((m.uv * [mirrored, 1.0], 0.5 * m.uv + 3.0))
    mesh, corner_uv = stored(np.concatenate((V, V)), two, uv, scale=(0.5, 0.25))
    islands = cuv.uv_islands(mesh, corner_uv)
    surface = cuv.island_surface(mesh, islands, islands.island[0], scale=(0.5, 0.25))
    np.testing.assert_array_equal(surface.corners, np.arange(F.size))
    np.testing.assert_array_equal(surface.V[surface.point], V[F.reshape(-1)])
    np.testing.assert_allclose(surface.uv[surface.point], uv[F.reshape(-1)] + [1.0, 2.0], atol=1e-6)
    turned = surface.F if mirrored > 0 else surface.F[:, ::-1]
    np.testing.assert_array_equal(surface.V[turned], V[F])
    assert surface.rim.sum() == len(m.boundary)
    np.testing.assert_array_equal(islands.point[surface.corners], surface.numbers[surface.point])
    far = surface.uv[surface.farthest(0)]
    rim = surface.uv[surface.rim]
    assert np.hypot(*(far - surface.uv[0])) == np.hypot(*(rim - surface.uv[0]).T).max()
    with pytest.raises(cuv.OptionError, match="no island 2"):
        cuv.island_surface(mesh, islands, 2)


def test_arrays_that_do_not_fit():
    mesh = cuv.PolygonMesh(np.eye(3), np.array([0, 1, 2]), np.array([0, 3]))
    with pytest.raises(cuv.OptionError, match="3 corners"):
        cuv.uv_islands(mesh, np.zeros((4, 2)))
    with pytest.raises(cuv.OptionError, match="1 faces"):
        cuv.uv_islands(mesh, np.zeros((3, 2)), [True, False])


def test_fits():
    angle = np.arange(8) * 0.8
    on = np.column_stack((2.0 + 3.0 * np.cos(angle), -1.0 + 0.5 * np.sin(angle)))
    place = fitted_place(on, 1e-9)
    np.testing.assert_allclose((*place.center, *place.radii), (2.0, -1.0, 3.0, 0.5), atol=1e-12)
    assert fitted_place(on[:6], 1e-9) is None  # too few for an ellipse
    assert fitted_place(np.ones((9, 2)), 1e-9) is None
    assert fitted_place(np.column_stack((angle, angle)), 1e-9) is None
    hyperbola = np.column_stack((np.cosh(angle), np.sinh(angle)))
    assert fitted_place(hyperbola, 1e-9) is None
    z = place.to_disk(on)
    np.testing.assert_allclose(place.from_disk(z), on, atol=1e-14)

"""Moebius maps of the sphere, and stored maps to it found again and moved."""

from __future__ import annotations

import numpy as np
import pytest

import conformal_uv as cuv


def points(n=200):
    x = np.random.default_rng(11).normal(size=(n, 3))
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def grid_sphere(rows=24, columns=40):
    """A closed grid of quads with poles of triangles, vertices on the unit sphere."""
    latitude = np.linspace(-np.pi / 2, np.pi / 2, rows + 1)[1:-1]
    longitude = 2.0 * np.pi * (np.arange(columns) + 0.3) / columns
    b, a = np.meshgrid(latitude, longitude, indexing="ij")
    xyz = np.stack((np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)), axis=-1).reshape(-1, 3)
    k = np.arange(len(xyz)).reshape(rows - 1, columns)
    right = np.roll(k, -1, axis=1)
    quads = np.stack((k[:-1], right[:-1], right[1:], k[1:]), axis=-1).reshape(-1, 4)
    south, north = len(xyz), len(xyz) + 1
    caps = [np.column_stack((np.full(columns, south), right[0], k[0]))]
    caps.append(np.column_stack((np.full(columns, north), k[-1], right[-1])))
    corners = np.concatenate((quads.reshape(-1), np.concatenate(caps).reshape(-1)))
    sizes = np.concatenate((np.full(len(quads), 4), np.full(2 * columns, 3)))
    V = np.concatenate((xyz, [[0, 0, -1.0], [0, 0, 1.0]]))
    return cuv.PolygonMesh(V, corners, np.concatenate(([0], np.cumsum(sizes))))


def test_maps_keep_the_sphere_and_angles():
    moebius = cuv.SphereMoebius.of(
        [0.3, -0.4, 0.5], cuv.SphereMoebius.rotation_to([1, 0, 0], [0.6, 0, 0.8]).matrix[1:, 1:]
    )
    x = points()
    np.testing.assert_allclose(np.linalg.norm(moebius(x), axis=1), 1.0, atol=1e-14)
    first, second = np.cross(x, [0.3, 0.1, 1.0]), np.cross(x, [1.0, -0.2, 0.1])
    h = 1e-5

    def pushed(direction):
        there = (x + h * direction) / np.linalg.norm(x + h * direction, axis=1, keepdims=True)
        back = (x - h * direction) / np.linalg.norm(x - h * direction, axis=1, keepdims=True)
        return (moebius(there) - moebius(back)) / (2.0 * h)

    def cosine(a, b):
        return np.einsum("ij,ij->i", a, b) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)

    np.testing.assert_allclose(cosine(pushed(first), pushed(second)), cosine(first, second), atol=1e-7)


def test_boosts_move_toward_and_enlarge_what_lies_opposite():
    t, n = 0.6, np.array([0.0, 0.6, 0.8])
    moebius = cuv.SphereMoebius.of(t * n)
    np.testing.assert_allclose(moebius([n, -n]), [n, -n], atol=1e-14)
    x = points()
    assert (moebius(x) @ n >= x @ n).all()
    h = 1e-6 * np.array([1.0, 0.0, 0.0])
    grown = np.linalg.norm(moebius([-n + h]) - moebius([-n]))
    np.testing.assert_allclose(grown / 1e-6, np.sqrt((1 + t) / (1 - t)), rtol=1e-5)


def test_the_parts_are_read_back_and_maps_compose():
    turn = cuv.SphereMoebius.rotation_to([0.6, 0.0, 0.8], [0.0, 1.0, 0.0])
    np.testing.assert_allclose(turn([[0.6, 0.0, 0.8]]), [[0.0, 1.0, 0.0]], atol=1e-15)
    one = cuv.SphereMoebius.of([0.1, 0.2, -0.7]) @ turn @ cuv.SphereMoebius.of([0.5, 0.0, 0.1])
    toward, rotation = one.toward_and_rotation()
    assert np.linalg.norm(toward) < 1.0
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(rotation) > 0.0
    x = points()
    np.testing.assert_allclose(cuv.SphereMoebius.of(toward, rotation)(x), one(x), atol=1e-13)
    np.testing.assert_allclose(one.inverse()(one(x)), x, atol=1e-13)
    opposite = cuv.SphereMoebius.rotation_to([0, 0, 1.0], [0, 0, -1.0])
    np.testing.assert_allclose(opposite([[0, 0, 1.0]]), [[0, 0, -1.0]], atol=1e-15)
    assert np.linalg.det(opposite.matrix[1:, 1:]) > 0.0


def test_a_boost_of_one_is_refused():
    with pytest.raises(cuv.OptionError, match="not shorter than 1"):
        cuv.SphereMoebius.of([0.0, 1.0, 0.0])


@pytest.mark.parametrize("octahedron", [False, True])
def test_places_of_the_layouts_are_found_again(octahedron):
    uv = np.random.default_rng(3).uniform(size=(300, 2))
    xyz = cuv.on_sphere(uv, octahedron=octahedron)
    np.testing.assert_allclose(np.linalg.norm(xyz, axis=1), 1.0, atol=1e-14)
    triangles = np.repeat(xyz, 3, axis=0)  # a polygon of one place, so in one piece
    mesh = cuv.PolygonMesh(triangles, np.arange(900), np.arange(0, 901, 3))
    layout = cuv.octahedral if octahedron else cuv.equirectangular
    np.testing.assert_allclose(layout(triangles, mesh)[::3], uv, atol=1e-12)


@pytest.mark.parametrize("octahedron", [False, True])
def test_a_stored_sphere_is_found_and_moved(octahedron):
    mesh = grid_sphere()
    layout = cuv.octahedral if octahedron else cuv.equirectangular
    start = cuv.SphereMoebius.of([0.2, 0.3, 0.1])(mesh.V)
    positions = ([1.0, 2.0, 3.0] + 2.5 * start).astype(np.float32)
    uv = layout(start, mesh).astype(np.float32)
    found = cuv.stored_sphere(mesh, positions, uv)
    assert found.octahedron is octahedron
    np.testing.assert_allclose(found.center, [1.0, 2.0, 3.0], atol=1e-6)
    assert found.radius == pytest.approx(2.5, abs=1e-6)
    np.testing.assert_allclose(found.xyz, start, atol=1e-6)
    moebius = cuv.SphereMoebius.of([0.0, -0.4, 0.2])
    np.testing.assert_allclose(found.positions(moebius(found.xyz)), [1.0, 2.0, 3.0] + 2.5 * moebius(start), atol=1e-5)
    assert (np.abs(found.uv(moebius(found.xyz)) - layout(moebius(start), mesh)).max(axis=1) < 1e-4).mean() > 0.98


def test_what_is_no_sphere_is_not_taken():
    mesh = grid_sphere()
    assert cuv.stored_sphere(mesh, mesh.V * [1.0, 1.0, 1.01]) is None
    assert cuv.stored_sphere(mesh, np.zeros_like(mesh.V)) is None
    assert cuv.stored_sphere(mesh, np.full_like(mesh.V, np.nan)) is None
    assert cuv.stored_sphere(mesh, mesh.V).octahedron is None
    other = np.random.default_rng(1).uniform(size=(len(mesh.corners), 2))
    assert cuv.stored_sphere(mesh, mesh.V, other).octahedron is None
    few = cuv.PolygonMesh(np.eye(4, 3), np.array([0, 1, 2, 0, 2, 3]), np.array([0, 3, 6]))
    assert cuv.stored_sphere(few, few.V) is None

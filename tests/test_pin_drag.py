"""Pins dragged one at a time: the same as a fresh solution, or as the Moebius map of three points of the circle."""

from __future__ import annotations

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.samples import mask


@pytest.fixture(scope="module")
def disk():
    V, F = mask(400)
    return V, F, cuv.disk_map(V, F)


def island(V, F, uv, scale=(1.0, 1.0)):
    mesh = cuv.PolygonMesh(V, F.reshape(-1).astype(np.int64), np.arange(0, 3 * len(F) + 1, 3))
    stored = (uv * scale)[F.reshape(-1)]
    surface = cuv.island_surface(mesh, cuv.uv_islands(mesh, stored), 0, scale=scale)
    np.testing.assert_array_equal(surface.V, V)  # so the UV vertices are the vertices
    return surface, cuv.disk_islands(mesh, stored)


@pytest.mark.parametrize("scale", [(1.0, 1.0), (0.5, 0.25)])
def test_it_is_the_fresh_solution(disk, scale):
    V, F, m = disk
    surface, _ = island(V, F, m.uv, scale)
    pins = [5, 17, 300, 42]
    drag = cuv.PinDrag(surface, pins, moved=300)
    for place in ([0.3, -0.4], [2.0, 1.0]):
        at = m.uv[pins]
        at[2] = place
        fresh = cuv.pinned_map(V, F, dict(zip(pins, at, strict=True))).uv * scale
        found = drag.placed(np.multiply(place, scale))
        np.testing.assert_allclose(found, fresh, rtol=0, atol=1e-9 * np.abs(fresh).max())
        np.testing.assert_allclose(found[pins], at * scale, rtol=1e-15)
    again = cuv.PinDrag(surface, pins, moved=17, mapper=drag.mapper)
    assert again.mapper is drag.mapper
    np.testing.assert_allclose(again.placed(m.uv[17] * scale), drag.placed(m.uv[300] * scale), atol=1e-9)


def test_a_mirrored_island_stays_mirrored(disk):
    V, F, m = disk
    surface, _ = island(V, F, m.uv * [-1.0, 1.0])
    drag = cuv.PinDrag(surface, [5, 300], moved=5)
    straight = cuv.pinned_map(V, F, {5: m.uv[5], 300: m.uv[300]}).uv
    np.testing.assert_allclose(drag.placed(m.uv[5] * [-1.0, 1.0]), straight * [-1.0, 1.0], rtol=0, atol=1e-9)


def test_three_pins_of_a_disk_move_it_by_a_moebius_map(disk):
    V, F, m = disk
    surface, (round_one,) = island(V, F, m.uv)
    pins = m.boundary[[0, 20, 40]]
    drag = cuv.PinDrag(surface, pins, moved=pins[1], disk=round_one)
    assert drag.mapper is None
    z = m.uv.view(complex)[:, 0]
    target = z[pins[1]] * np.exp(0.2j)
    moved = drag.placed([1.7 * target.real, 1.7 * target.imag]).view(complex)[:, 0]  # off the circle
    expected = cuv.Moebius.from_three_pairs(z[pins], [z[pins[0]], target, z[pins[2]]])(z)
    np.testing.assert_allclose(moved, expected, rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.abs(moved[m.boundary]), 1.0, rtol=0, atol=1e-12)


@pytest.mark.parametrize("turn", [2.5, -2.5, 3.1])
def test_pins_on_the_circle_keep_their_order(disk, turn):
    V, F, m = disk
    surface, (round_one,) = island(V, F, m.uv)
    z = m.uv.view(complex)[:, 0]
    angle = np.angle(z[m.boundary])
    pins = m.boundary[[np.argmin(np.abs(np.angle(np.exp(1j * (angle - a))))) for a in (0.0, 2.0, 4.0)]]
    target = z[pins[1]] * np.exp(1j * turn)  # past a neighbour
    moved = cuv.PinDrag(surface, pins, moved=pins[1], disk=round_one).placed([target.real, target.imag])
    assert np.abs(moved.view(complex)).max() <= 1.0 + 1e-9  # the inside is inside
    around = np.angle(moved.view(complex)[:, 0][pins] / z[pins[0]]) % (2 * np.pi)
    assert 0.0 < around[1] < around[2]


def test_a_disk_with_other_pins_is_freed(disk):
    V, F, m = disk
    surface, (round_one,) = island(V, F, m.uv)
    inside = np.setdiff1d(np.arange(len(V)), m.boundary)[0]
    for pins in (m.boundary[:2], m.boundary[[0, 20, 40, 60]], [inside, *m.boundary[:2]]):
        assert cuv.PinDrag(surface, pins, moved=int(pins[0]), disk=round_one).mapper is not None


def test_refusals(disk):
    V, F, m = disk
    surface, _ = island(V, F, m.uv)
    with pytest.raises(cuv.OptionError, match="not among"):
        cuv.PinDrag(surface, [1, 2], moved=3)
    with pytest.raises(cuv.OptionError, match="Two or more"):
        cuv.PinDrag(surface, [1], moved=1)

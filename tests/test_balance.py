"""What is in the middle of a disk: between vertices, and by area where asked for."""

from __future__ import annotations

import numpy as np
import pytest
from nasty_meshes import finger
from numpy.typing import NDArray

import conformal_uv as cuv
from conformal_uv.disk.balance import balance_point
from conformal_uv.samples import flat_disk, mask, spherical_cap


def spread(m: cuv.DiskMap, a: complex = 0.0) -> float:
    """Standard deviation of the logarithm of the area scale over the surface, after the Moebius map of a to 0."""
    z = cuv.Moebius.to_zero(a)(m.uv @ [1.0, 1.0j])
    d = cuv.distortion(m.surface.V, m.surface.F, np.column_stack((z.real, z.imag)))
    weights = cuv.face_areas(m.surface.V, m.surface.F)
    logs = np.log(d.area_scale)
    return float(np.sqrt(np.average((logs - np.average(logs, weights=weights)) ** 2, weights=weights)))


def symmetric(columns: int = 9, rows: int = 12) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A relief that is its own mirror image in x, its triangles too, with no vertex on the axis."""
    x, y = np.meshgrid(np.arange(2 * columns) - columns + 0.5, np.arange(rows + 1.0))
    V = np.column_stack((x.ravel(), y.ravel(), (2.0 * np.cos(0.3 * x) * np.sin(0.4 * y + 0.3 * abs(x))).ravel()))
    a = np.arange((rows + 1) * 2 * columns).reshape(rows + 1, -1)
    a, b, c, d = a[:-1, :-1], a[:-1, 1:], a[1:, 1:], a[1:, :-1]
    left = np.arange(2 * columns - 1) < columns - 0.5
    one = np.where(left, np.stack((a, b, c)), np.stack((a, b, d)))
    other = np.where(left, np.stack((a, c, d)), np.stack((b, c, d)))
    return V, np.concatenate((one, other), axis=1).reshape(3, -1).T


@pytest.mark.parametrize("balance", ["middle", "area"])
@pytest.mark.parametrize("method", ["linear", "newton"])
def test_a_symmetric_surface_gets_a_symmetric_map(method: str, balance: str) -> None:
    """But for the middle column of quads, whose diagonals lean one way."""
    V, F = symmetric()
    m = cuv.disk_map(V, F, method=method, balance=balance)
    z = m.uv @ [1.0, 1.0j]
    mirror = np.arange(len(V)).reshape(13, 18)[:, ::-1].ravel()
    turn = np.sqrt(np.mean(z * z[mirror]))  # along the axis of the best reflection
    misfit = np.abs(z - (turn / abs(turn)) ** 2 * np.conj(z[mirror]))
    assert np.sqrt(np.mean(misfit**2)) < 0.004


@pytest.mark.parametrize("mesh", [mask(500), spherical_cap(400, 150.0), finger(2)])
def test_area_balance_has_the_least_spread_of_areas_among_moebius_maps(mesh) -> None:
    middle, area = (cuv.disk_map(*mesh, method="linear", balance=b, repair="never") for b in ("middle", "area"))
    assert area.center is None and spread(area) <= spread(middle) * (1.0 + 1e-5)
    for a in 0.02 * np.exp(1j * np.arange(6)):
        assert spread(area, a) > spread(area) - 1e-3 * spread(area)  # extended anew, so least but for discretisation
    least = balance_point(middle.surface, middle.uv @ [1.0, 1.0j])
    for a in 0.02 * np.exp(1j * np.arange(6)):
        moved = (least + a) / (1.0 + np.conj(least) * a)
        assert spread(middle, moved) > spread(middle, least)


def test_a_flat_disk_is_in_balance_as_it_is() -> None:
    V, F = flat_disk(300)
    assert abs(balance_point(cuv.DiskMapper(V, F).surface, V[:, 0] + 1j * V[:, 1])) < 1e-12


def test_balance_with_a_center_or_pins_is_refused() -> None:
    V, F = mask(200)
    loop = cuv.DiskMapper(V, F).boundary
    for options in ({"center": 5}, {"pins": loop[[0, 5, 11]]}):
        with pytest.raises(cuv.OptionError, match='balance="area" says what is in the middle'):
            cuv.disk_map(V, F, balance="area", **options)
    with pytest.raises(cuv.OptionError, match="balance is 'even'; choose middle or area"):
        cuv.disk_map(V, F, balance="even")

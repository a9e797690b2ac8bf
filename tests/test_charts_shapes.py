"""Charts of other shapes than disks, and charts turned upright."""

from __future__ import annotations

import developable
import numpy as np
import pytest
from meshes import disjoint, plate
from nasty_meshes import grid
from numpy.typing import NDArray

import conformal_uv as cuv
from conformal_uv.charts.spacing import LEAST
from conformal_uv.charts.upright import upright_turn
from conformal_uv.options import Shape, Upright
from conformal_uv.samples import mask, terrain

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def turned(V: NDArray[np.float64], degrees: float, axis: int) -> NDArray[np.float64]:
    """V about one of the axes."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    R = np.roll(np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]), axis, axis=(0, 1))
    return V @ R.T


def rise_in_texture(V: NDArray[np.float64], F: NDArray[np.int64], uv: NDArray[np.float64], up: int) -> float:
    """Angle in degrees from v to where the surface rises: the direction of the height's gradient in the texture, face
    by face, as long as the gradient is on the surface, in the mean over the surface's area."""
    total = np.zeros(2)
    for face, q in zip(F, uv.reshape(-1, 3, 2), strict=True):
        p, sides = V[face], np.stack((q[1] - q[0], q[2] - q[0]))
        normal = np.cross(p[1] - p[0], p[2] - p[0])
        gradient = np.linalg.solve(sides, [p[1, up] - p[0, up], p[2, up] - p[0, up]])
        if np.linalg.det(sides) > 0.0 and gradient.any():
            total += np.hypot(*np.delete(normal, up)) * gradient / np.linalg.norm(gradient)
    return float(np.degrees(np.arctan2(total[0], total[1])))


@pytest.mark.parametrize("name", developable.DEVELOPABLE)
def test_developable_charts_are_rolled_out(name: str) -> None:
    """No angle error, and all lengths by one factor."""
    V, F, _ = developable.DEVELOPABLE[name]()
    u = cuv.unwrap(V, F, shape="free")
    chart = u.charts[0]
    assert chart.status == "mapped" and len(chart.flipped) == 0
    assert chart.distortion.angle_max < 1e-6
    uv, p = u.uv.reshape(-1, 3, 2), np.asarray(V)[F]
    ratio = np.linalg.norm(uv - np.roll(uv, 1, axis=1), axis=2) / np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2)
    assert ratio.max() / ratio.min() - 1.0 < 1e-9
    side = 1.01 * LEAST  # kept to the sides of the square, and rounding
    assert u.uv.min() == pytest.approx(0.0, abs=side) and u.uv.max() == pytest.approx(1.0, abs=side)
    numbers = cuv.unwrap_numbers(u)
    assert numbers.converged_charts == 1 and numbers.conformal_energy < 1e-12 * numbers.dirichlet_energy
    assert 0.0 < numbers.coverage <= 1.0


def test_a_shape_for_each_chart() -> None:
    V, F = disjoint(disjoint(mask(300), terrain(200)), plate(8, 5))
    u = cuv.unwrap(V, F, shape=["disk", "free", "rectangle"])
    kinds = [type(chart.map) for chart in u.charts]
    assert kinds == [cuv.DiskMap, cuv.FreeMap, cuv.RectangleMap]
    boxes = []
    for chart in u.charts:
        uv = u.uv[np.unique(chart.corner)]
        assert uv.min() >= 0.0 and uv.max() <= 1.0
        scale = np.abs(_areas(u.uv[chart.corner])).sum() / cuv.face_areas(chart.mesh.V, chart.F).sum()
        boxes.append((uv.min(axis=0), uv.max(axis=0), scale))
    assert np.ptp([scale for *_, scale in boxes]) < 1e-9 * boxes[0][2]  # areas in one proportion
    for k, wrong in ((2, ["disk", "free"]), (4, ["disk"] * 4)):
        with pytest.raises(cuv.OptionError, match=f"{k} shapes for 3 charts"):
            cuv.unwrap(V, F, shape=wrong)
    with pytest.raises(cuv.OptionError, match="shape is 'round'"):
        cuv.unwrap(V, F, shape="round")


def _areas(triangles: NDArray[np.float64]) -> NDArray[np.float64]:
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    return 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def test_four_pins_are_the_corners_of_a_rectangle() -> None:
    V, F = plate(9, 4)
    corners = [0, 9, 49, 40]
    u = cuv.unwrap(V, F, shape="rectangle", pins=corners)
    m = cuv.rectangle_map(V, F, corners)
    assert u.charts[0].map.corners.tolist() == corners and u.charts[0].map.modulus == m.modulus
    uv = np.zeros((len(V), 2))
    uv[F.reshape(-1)] = u.uv
    np.testing.assert_allclose(
        uv[corners] - uv[0], np.array([[0, 0], [m.modulus, 0], [m.modulus, 1], [0, 1]]) / m.modulus
    )
    three = cuv.unwrap(V, F, shape="rectangle", pins={0, 9, 49})
    assert three.charts[0].notes == ["not pinned: of its pins 0, 9, 49, 3 are on its boundary, not four"]
    with pytest.raises(cuv.OptionError, match="pins: no chart can use vertices 0, 9, 12, 49; .* a rectangle four"):
        cuv.unwrap(V, F, shape="rectangle", pins=[0, 9, 49, 12])


def test_what_a_free_boundary_does_not_use_is_told() -> None:
    V, F = plate(6, 6)
    with pytest.raises(cuv.OptionError, match="center: no chart can use"):
        cuv.unwrap(V, F, shape="free", center=24)
    with pytest.raises(cuv.OptionError, match="pins: no chart can use"):
        cuv.unwrap(V, F, shape="free", pins=[0, 6, 48])
    offered = cuv.unwrap(V, F, shape="free", pins={0, 6, 48})
    assert offered.charts[0].notes == ["pins 0, 6, 48 not used: the boundary is free"]


def test_one_factorization_serves_disk_and_free(monkeypatch: pytest.MonkeyPatch) -> None:
    from conformal_uv.operators import factorized_disk

    made = []
    real = factorized_disk.DirichletProblem
    monkeypatch.setattr(factorized_disk, "DirichletProblem", lambda *a, **k: made.append(1) or real(*a, **k))
    unwrapper = cuv.Unwrapper(*mask(400))
    for shape in ("disk", "free", "disk", "free"):
        assert unwrapper.unwrap(shape=shape).summary == "mapped 1 of 1 chart"
    assert len(made) == 1


WALL = (lambda V, F: (V @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), F))(*plate(7, 4))


@pytest.mark.parametrize("shape", ["disk", "free"])
@pytest.mark.parametrize("roll", [0.0, 77.0, 200.0])
def test_walls_and_heads_stand_upright(shape: str, roll: float) -> None:
    """A wall, its face turned about the axis that it faces along; a mask that lies, and looks up at a slant."""
    V, F = WALL
    head, faces = mask(400)
    for mesh, triangles in ((turned(V, 15.0, 2), F), (turned(head, 60.0, 0), faces)):
        u = cuv.unwrap(mesh, triangles, shape=shape)
        assert abs(rise_in_texture(mesh, triangles, u.uv, 2)) < 1e-6
        swapped = mesh[:, [0, 2, 1]] * [1.0, 1.0, -1.0]  # y up
        u = cuv.unwrap(swapped, triangles, shape=shape, upright="y")
        assert abs(rise_in_texture(swapped, triangles, u.uv, 1)) < 1e-6
    lying = turned(mask(400)[0], roll, 2)  # looks up; then y is up on it
    u = cuv.unwrap(lying, faces, shape="disk")
    flat = u.charts[0].map.uv
    same = cuv.disk_map(lying, faces).uv @ [1.0, 1.0j]
    z = flat @ [1.0, 1.0j]
    np.testing.assert_allclose(z / same, (z / same)[np.argmax(abs(same))], atol=1e-9)  # turned, and nothing else


@pytest.mark.parametrize("roll", [0.0, 30.0, 100.0])
def test_what_lies_flat_has_its_straight_sides_along_the_square(roll: float) -> None:
    V, F = plate(12, 5)
    V = turned(V * [1.0, 1.0, 0.05], roll, 2)
    u = cuv.unwrap(V, F, shape="free")
    chart = u.charts[0]
    uv = np.zeros((len(V), 2))
    uv[F.reshape(-1)] = u.uv
    sides = np.diff(uv[chart.map.boundary], axis=0, append=uv[chart.map.boundary[:1]])
    angle = np.degrees(np.arctan2(sides[:, 1], sides[:, 0])) % 90.0
    assert np.minimum(angle, 90.0 - angle).max() < 1.0
    assert abs(rise_in_texture(V, F, u.uv, 1)) <= 45.0 + 1.0  # of the four ways, the one with y nearest to up


def test_rectangles_are_turned_by_quarters() -> None:
    V, F = WALL
    for degrees in (0.0, 40.0, 50.0, 130.0, 240.0):
        u = cuv.unwrap(turned(V, degrees, 1), F, shape="rectangle")
        uv = u.uv[np.unique(u.charts[0].corner, return_index=True)[1]]
        edges = np.isclose(uv, u.uv.min(axis=0)) | np.isclose(uv, u.uv.max(axis=0))
        assert edges.any(axis=1).sum() >= 22  # the boundary lies on the box
        assert abs(rise_in_texture(turned(V, degrees, 1), F, u.uv, 2)) <= 46.0


def test_upright_is_off_where_it_is_not_wanted() -> None:
    V, F = WALL
    m = cuv.disk_map(V, F)
    for options in ({"upright": "none"}, {"boundary_vertex": int(m.boundary[0])}):
        u = cuv.unwrap(V, F, place="disk", **options)
        np.testing.assert_array_equal(u.uv, m.uv[F.reshape(-1)])
    quarter = cuv.unwrap(V, F, place="disk", rotation=0.5 * np.pi)
    np.testing.assert_allclose(quarter.uv @ [1, 1j], 1j * (cuv.unwrap(V, F, place="disk").uv @ [1, 1j]), atol=1e-12)
    with pytest.raises(cuv.OptionError, match="upright is 'x'; choose z, y, none"):
        cuv.unwrap(V, F, upright="x")


def test_a_chart_without_any_area_is_not_turned() -> None:
    V, F = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), np.array([[0, 1, 2]])
    assert upright_turn(V, F, np.array([0.0, 1.0, 1j]), np.arange(3), Shape.FREE, Upright.Z) == 1.0
    assert upright_turn(V, F, np.array([0.0, 1.0, 1j]), np.arange(3), Shape.DISK, Upright.NONE) == 1.0


def test_a_squeezed_face_does_not_turn_its_chart() -> None:
    """In a face that the map squeezes to nothing the height's gradient in the plane has any length: here 1e6."""
    n = 12
    x, z = (axis.ravel() for axis in np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0)))
    V = np.column_stack((x, np.zeros_like(x), z))
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = (q.ravel() for q in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    F = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    w = x + 1j * z
    corner = n  # below on the right; its only face is squeezed onto its far side
    (face,) = F[(F == corner).any(axis=1)]
    others = [v for v in face if v != corner]
    w[corner] = w[others].mean() + 1e-12 * (w[corner] - w[others].mean()) + 0.2 * (w[others[0]] - w[others[1]])
    turn = upright_turn(V, F, w, np.empty(0, dtype=np.int64), Shape.DISK, Upright.Z)
    assert abs(np.degrees(np.angle(turn))) < 1.0


@pytest.mark.parametrize("shape", ["free", "rectangle"])
def test_no_chart_leaves_its_square_by_rounding(shape: str) -> None:
    V, F = mask(300)
    found = [cuv.unwrap(turned(V, degrees, 1), F, shape=shape, place="disk").uv for degrees in range(0, 60, 3)]
    assert max(np.abs(uv).max() for uv in found) == 1.0


@pytest.mark.parametrize("degrees", [10, 30, 40, 50, 80, 130, 170])
def test_a_flat_sheet_is_turned_to_the_square_by_less_than_an_eighth(degrees: int) -> None:
    """Its straight sides lie along the square's, and what is up in the plane is up as nearly as that allows.

    A corner is cut off and the boundary begins on that oblique side, so that the map by itself lies aslant.
    """
    V, F = grid(9, 5, 2.0, 1.3)
    tip = int(np.flatnonzero(np.bincount(F.reshape(-1)) == 1)[0])
    beside = np.isin(F, F[(F == tip).any(axis=1)]).sum(axis=1) == 2
    F = np.concatenate((F[beside], F[~beside]))
    F = F[(F != tip).all(axis=1)]
    u = cuv.unwrap(turned(V, degrees, 2), F, shape="free", place="disk")
    uv = np.zeros((len(V), 2))
    uv[F.reshape(-1)] = u.uv
    way = (uv[25] - uv[19]) @ [1, 1j]  # along the longer side
    apart = np.degrees(np.angle(way * np.exp(-0.5j * np.pi * round(degrees / 90))))
    assert abs(apart) < 1.0  # the oblique side counts, too

"""Packing: no two charts touch, all lie in the square, areas are true, outlines are used."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from meshes import annulus, disjoint, plate
from polygon_shapes import side_by_side

import conformal_uv as cuv
from conformal_uv.charts import shelves, unwrap
from conformal_uv.charts.cell_packing import pack_cells
from conformal_uv.charts.footprints import Footprints
from conformal_uv.charts.packing import kept_margin, pack_charts, pack_disks
from conformal_uv.errors import MissingDependencyError

RADII = {
    "equal": lambda rng, n: np.ones(n),
    "even": lambda rng, n: rng.uniform(0.1, 1.0, n),
    "heavy tail": lambda rng, n: rng.pareto(1.5, n) + 0.01,
    "one giant": lambda rng, n: np.append(np.full(n - 1, 1e-6), 1.0),
    "a point": lambda rng, n: (np.arange(n) < max(1, n - 1)).astype(float),
}


@pytest.mark.parametrize("margin", [0.0, 0.005, 0.03])
@pytest.mark.parametrize("count", [1, 2, 7, 40, 400])
@pytest.mark.parametrize("kind", RADII)
def test_disks_lie_apart_in_the_square(kind, count, margin):
    given = RADII[kind](np.random.default_rng(count), count)
    kept = kept_margin(margin, count)
    center, scale = pack_disks(given, kept)
    radius = scale * given
    apart = np.linalg.norm(center[:, None] - center, axis=2) - radius[:, None] - radius
    apart[np.diag_indices(count)] = np.inf
    assert apart.min() >= kept - 1e-12
    assert (center - radius[:, None]).min() >= kept - 1e-12
    assert (center + radius[:, None]).max() <= 1.0 - kept + 1e-12


def test_packing_uses_the_square():
    rng = np.random.default_rng(1)
    for count in (9, 30, 300):
        given = rng.uniform(0.3, 1.0, count)
        _, scale = pack_disks(given, 0.001)
        assert np.pi * ((scale * given) ** 2).sum() > 0.5  # circles in squares without gaps fill 0.785


def test_areas_are_true_to_each_other_with_holes_too():
    V, Q = side_by_side(5)
    W, F = annulus(16)
    polygons = [*Q.tolist(), *(F + len(V)).tolist()]
    points = np.concatenate((V, W - [50, 0, 0]))
    u = unwrap(points, polygons, margin=0.01)
    assert u.mapped.all() and u.uv.min() >= 0.01 - 1e-12 and u.uv.max() <= 0.99 + 1e-12
    sizes = np.array([len(q) for q in polygons])
    starts = np.concatenate(([0], np.cumsum(sizes)))
    ratios = []
    for chart in u.charts:
        image = surface = 0.0
        for p in chart.faces:
            x, y = u.uv[starts[p] : starts[p + 1]].T
            image += 0.5 * (x @ np.roll(y, -1) - np.roll(x, -1) @ y)
            x, y, _ = points[polygons[p]].T
            surface += 0.5 * (x @ np.roll(y, -1) - np.roll(x, -1) @ y)
        ratios.append(image / surface)
    assert ratios == pytest.approx(np.full(6, ratios[0]), rel=1e-9)


def test_charts_without_area_do_no_harm():
    V = np.concatenate((np.eye(3), np.zeros((3, 3)), np.eye(3) + 5))
    u = unwrap(V, np.arange(9).reshape(3, 3))
    assert np.isfinite(u.uv).all() and u.uv.min() >= 0 and u.uv.max() <= 1
    assert unwrap(np.zeros((6, 3)), np.arange(6).reshape(2, 3)).uv.max() <= 1


def star(rng, radius, points=24):
    """A polygon around 0 with bays, as a fan."""
    turn = 2 * np.pi * np.arange(points) / points
    bays = 1 + 0.5 * np.cos(rng.integers(2, 6) * turn + rng.uniform(0, 6))
    i = np.arange(points)
    return np.append(radius * bays * np.exp(1j * turn), 0), np.array([i, (i + 1) % points, np.full(points, points)])


def grid_chart(cells):
    """Unit squares [x, x+1] x [y, y+1], two triangles each."""
    low = np.array([x + 1j * y for x, y in cells])
    z = (low[:, None] + [0, 1, 1 + 1j, 1j]).reshape(-1)
    first = 4 * np.arange(len(low))
    return z, np.concatenate((first + np.array([[0], [1], [2]]), first + np.array([[0], [2], [3]])), axis=1)


L_SHAPE = grid_chart([(i, 0) for i in range(8)] + [(0, j) for j in range(1, 8)])
SLIVER = np.array([0, 5, 10 + 1e-9j]), np.array([[0], [1], [2]])
POINT = np.array([3 + 3j, 3 + 3j, 3 + 3j]), np.array([[0], [1], [2]])
QUAD = np.array([[0, 0], [1, 2], [2, 3]])


def rectangle(width, height):
    return np.array([0, width, width + 1j * height, 1j * height]), QUAD


def placed(charts, margin):
    found = pack_charts(charts, margin)
    assert len({place.scale for place in found}) == 1  # one for all
    return [complex(*place.center) + place.scale * z for place, (z, _) in zip(found, charts, strict=True)]


def double_area(z, corners):
    a, b, c = z[corners]
    return np.abs(((b - a).conj() * (c - a)).imag).sum()


def boxes_of(charts):
    """The boxes of the charts, as charts."""
    size = [np.ptp(z.real) + 1j * np.ptp(z.imag) for z, _ in charts]
    return [rectangle(s.real, s.imag) for s in size]


def least_distance(one, other):
    """Between two sets of triangles (3, m), (3, n), from points to sides; 0 where no axis tells two triangles apart."""
    best = np.inf
    for a, b in ((one, other), (other, one)):
        side = np.roll(a, -1, axis=0) - a  # sides a -> a + side, points of b
        t = ((b[:, None, None, :] - a[None, :, :, None]) * side.conj()[None, :, :, None]).real
        length = np.abs(side)[None, :, :, None] ** 2
        t = np.clip(np.divide(t, length, out=np.zeros_like(t), where=length > 0), 0, 1)
        gap = np.abs(b[:, None, None, :] - a[None, :, :, None] - t * side[None, :, :, None])
        best = min(best, gap.min())
    apart = np.zeros((one.shape[1], other.shape[1]), dtype=bool)
    for source in (one, other):
        for normal in (*(1j * (np.roll(source, -1, axis=0) - source)), 1.0 + 0 * source[0], 1j + 0 * source[0]):
            axis = normal.conj()[:, None] if source is one else normal.conj()[None, :]
            x, y = (one[:, :, None] * axis).real, (other[:, None, :] * axis).real
            apart |= (x.max(axis=0) < y.min(axis=0)) | (y.max(axis=0) < x.min(axis=0))
    return best if apart.all() else 0.0


SETS = {
    "stars": [star(np.random.default_rng(i), 0.2 + 0.1 * i) for i in range(9)],
    "L shapes": [L_SHAPE] * 6,
    "unequal": [star(np.random.default_rng(i), 1.5**-i) for i in range(12)],
    "ring and disk": [grid_chart([(x, y) for x in range(5) for y in range(5) if x % 4 == 0 or y % 4 == 0])]
    + [rectangle(1.0, 1.0)] * 4,
    "without area": [SLIVER, POINT, star(np.random.default_rng(0), 3.0), (np.array([1j]), np.empty((3, 0), dtype=int))],
    "strips": [rectangle(10.0, 0.01 * i) for i in range(12)],
}


@pytest.mark.parametrize("margin", [0.0, 0.005, 0.03])
@pytest.mark.parametrize("kind", SETS)
def test_outlines_lie_apart_in_the_square(kind, margin):
    charts = SETS[kind]
    places = placed(charts, margin)
    kept = kept_margin(margin, len(charts))
    every = np.concatenate(places)
    assert min(every.real.min(), every.imag.min()) >= kept
    assert max(every.real.max(), every.imag.max()) <= 1.0 - kept
    triangles = [
        z[corners] if corners.size else np.tile(z, (3, 1)) for z, (_, corners) in zip(places, charts, strict=True)
    ]
    for i in range(len(charts)):
        for j in range(i):
            distance = least_distance(triangles[i], triangles[j])
            assert distance >= kept and distance > 0.0


def test_outlines_lie_in_each_other_s_bays():
    for kind, gain in (("L shapes", 1.5), ("stars", 1.05)):
        charts = SETS[kind]
        area = sum(0.5 * double_area(*chart) for chart in charts)
        by_outline, by_box = (pack_charts(shapes, 0.002)[0].scale for shapes in (charts, boxes_of(charts)))
        assert area * by_outline**2 > gain * area * by_box**2, (kind, area * by_outline**2, area * by_box**2)


def test_one_chart_fills_the_square():
    for margin in (0.0, 0.1):
        (z,) = placed([L_SHAPE], margin)
        assert [z.real.min(), z.imag.min()] == pytest.approx([margin, margin], abs=1e-9)
        assert [z.real.max(), z.imag.max()] == pytest.approx([1 - margin, 1 - margin], abs=1e-9)
    (z,) = placed([rectangle(2.0, 1.0)], 0.0)
    assert [z.imag.min(), z.imag.max()] == pytest.approx([0.25, 0.75], abs=1e-9)


def test_twenty_thousand_small_charts_take_a_step_for_each_shelf(monkeypatch):
    rng = np.random.default_rng(2)
    charts = [rectangle(w, h) for w, h in rng.uniform(0.3, 1.0, (20_000, 2))]
    shelved = []
    kept = shelves._full

    def counted(end, room):
        starts = kept(end, room)
        shelved.append(len(starts))
        return starts

    monkeypatch.setattr(shelves, "_full", counted)
    monkeypatch.setitem(sys.modules, "rpack", type(sys)("rpack"))  # without any function: it is not asked
    found = pack_charts(charts, 0.005)
    assert len(shelved) < 200 and max(shelved) < 600
    scale = found[0].scale
    low = np.array([complex(*place.center) for place in found])
    high = low + scale * np.array([z[2] for z, _ in charts])
    margin = kept_margin(0.005, len(charts))
    assert min(low.real.min(), low.imag.min()) >= margin
    assert max(high.real.max(), high.imag.max()) <= 1 - margin
    share_with_gaps = ((high - low + margin * (1 + 1j)).real * (high - low + margin * (1 + 1j)).imag).sum()
    assert share_with_gaps > 0.95
    order = np.lexsort((low.real, low.imag))  # shelf after shelf, left to right
    one, following = order[:-1], order[1:]
    same = low.imag[one] == low.imag[following]
    assert (low.real[following] - high.real[one])[same].min() >= margin
    tops = np.maximum.reduceat(high.imag[order], np.flatnonzero(np.append(True, ~same)))
    bottoms = np.unique(low.imag)
    assert (bottoms[1:] - tops[:-1]).min() >= margin


def test_large_charts_and_many_small_ones():
    rng = np.random.default_rng(3)
    charts = [star(rng, r) for r in rng.uniform(0.5, 1.0, 12)]
    charts += [rectangle(w, h) for w, h in rng.uniform(0.01, 0.03, (3000, 2))]
    places = placed(charts, 0.001)
    margin = kept_margin(0.001, len(charts))
    low = np.array([z.real.min() + 1j * z.imag.min() for z in places])
    high = np.array([z.real.max() + 1j * z.imag.max() for z in places])
    assert min(low.real.min(), low.imag.min()) >= margin and max(high.real.max(), high.imag.max()) <= 1 - margin
    small = slice(12, None)
    x = np.maximum(low.real[small] - high.real[small][:, None], low.real[small][:, None] - high.real[small])
    y = np.maximum(low.imag[small] - high.imag[small][:, None], low.imag[small][:, None] - high.imag[small])
    apart = np.maximum(x, y)
    apart[np.diag_indices(len(apart))] = np.inf
    assert apart.min() >= margin
    tiny = np.concatenate([z[corners] for z, (_, corners) in zip(places[12:], charts[12:], strict=True)], axis=1)
    for z, (_, corners) in zip(places[:12], charts[:12], strict=True):
        assert least_distance(z[corners], tiny) >= margin


def test_a_missing_library_is_told(monkeypatch):
    monkeypatch.setitem(sys.modules, "rpack", None)
    with pytest.raises(MissingDependencyError, match="needs rectangle-packer"):
        pack_charts([L_SHAPE, L_SHAPE], 0.0)
    assert len(pack_charts([L_SHAPE], 0.0)) == 1 and pack_charts([]) == []


def test_coverage_is_the_area_of_the_images():
    V, F = disjoint(plate(5, 5), plate(3, 8))
    u = cuv.unwrap(V, F, margin=0.01)
    x, y = u.uv.reshape(-1, 3, 2).transpose(2, 1, 0)
    area = 0.5 * np.abs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])).sum()
    assert cuv.unwrap_numbers(u).coverage == pytest.approx(area, rel=1e-12)
    one = cuv.unwrap_numbers(u, chosen=np.array([True, False])).coverage
    assert 0.0 < one < area
    apart = cuv.unwrap(V, F, place="disk")
    assert cuv.unwrap_numbers(apart).coverage is None
    assert cuv.unwrap_numbers(apart, uv=0.5 + 0.25 * apart.uv).coverage > 0.0


def test_of_places_as_low_a_chart_takes_the_one_that_leaves_the_least_room_below() -> None:
    """A wall, a gap of two cells, a plateau; two cells that bridge the gap or lie on the plateau."""
    runs = [(0, 0, 0, 5), (0, 1, 0, 1), (0, 1, 3, 5), (0, 2, 0, 1), (0, 2, 3, 5), (1, 0, 0, 2)]
    owner, row, start, stop = np.array(runs).T
    found = Footprints(owner, row, start, stop, columns=np.array([5, 2]), rows=np.array([3, 1]), around=0.0)
    placed = pack_cells(found, 5)
    assert placed is not None
    np.testing.assert_array_equal(placed, [[0, 3], [0, 4]])
    assert pack_cells(found, 4) is None

"""Packing: no two charts touch, all lie in the square, areas are true, outlines are used."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import annulus, disjoint, plate
from polygon_shapes import side_by_side

import conformal_uv as cuv
from conformal_uv.charts import footprints as footprints_module
from conformal_uv.charts import shelves, unwrap
from conformal_uv.charts.cell_packing import pack_cells
from conformal_uv.charts.free_cells import NOWHERE, FreeCells, Stencil
from conformal_uv.charts.packing import pack_charts, pack_disks
from conformal_uv.charts.spacing import kept_margin
from conformal_uv.options import PlaceOptions

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


def placed(charts, margin, **options):
    found = pack_charts(charts, PlaceOptions(margin=margin, **options))
    assert len(set(found.scale.tolist())) == 1  # one for all
    return [found.placed(z, np.full(len(z), number)) for number, (z, _) in enumerate(charts)]


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
        by_outline, by_box = (
            pack_charts(shapes, PlaceOptions(margin=0.002)).scale[0] for shapes in (charts, boxes_of(charts))
        )
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
    found = pack_charts(charts, PlaceOptions(margin=0.005))
    assert len(shelved) < 200 and max(shelved) < 600
    scale, low = found.scale[0], found.center
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


def boundary_pairs(places, charts):
    """Triangles of each placed chart, (3, m)."""
    return [z[c] if c.size else np.tile(z, (3, 1)) for z, (_, c) in zip(places, charts, strict=True)]


@pytest.mark.parametrize("shape", ["outline", "convex", "box"])
@pytest.mark.parametrize("rotation", ["quarters", "axes", "any"])
@pytest.mark.parametrize("kind", SETS)
def test_turned_charts_lie_apart_and_keep_their_shapes(kind, rotation, shape):
    charts = SETS[kind]
    margin = 0.004
    places = placed(charts, margin, margin_method="fraction", pack_rotation=rotation, pack_shape=shape)
    every = np.concatenate(places)
    assert min(every.real.min(), every.imag.min()) >= margin
    assert max(every.real.max(), every.imag.max()) <= 1.0 - margin
    scales = []
    for (z, _), there in zip(charts, places, strict=True):  # a turn and one scale: no mirror, no stretch
        if np.ptp(np.abs(z - z[0])) > 0.1:
            k = np.argmax(np.abs(z - z[0]))
            factor = (there[k] - there[0]) / (z[k] - z[0])
            np.testing.assert_allclose(there, there[0] + factor * (z - z[0]), atol=1e-12)
            scales.append(abs(factor))
            if rotation == "quarters":
                assert abs(factor**4 / abs(factor) ** 4 - 1.0) < 1e-12
    assert np.ptp(scales) < 1e-12
    triangles = boundary_pairs(places, charts)
    for i in range(len(charts)):
        for j in range(i):
            assert least_distance(triangles[i], triangles[j]) >= 2.0 * margin


def coverage(charts, **options):
    found = pack_charts(charts, PlaceOptions(**options))
    return 0.5 * sum(double_area(*chart) for chart in charts) * found.scale[0] ** 2


def test_what_is_allowed_is_used():
    """Turning and bays fill more of the square: strips at a slant, which only turning lays together."""
    slanted = [(z * np.exp(0.6j), corners) for z, corners in [rectangle(1.0, 0.1 + 0.01 * i) for i in range(12)]]
    straight = {r: coverage(slanted, margin=0.002, pack_rotation=r) for r in ("none", "quarters", "axes", "any")}
    assert straight["axes"] > 1.1 * straight["none"] and straight["any"] > 1.1 * straight["none"]
    assert min(straight.values()) > 0.4 and straight["axes"] > 0.75
    shapes = {s: coverage(SETS["L shapes"], margin=0.002, pack_shape=s) for s in ("outline", "convex", "box")}
    assert shapes["outline"] > 1.5 * shapes["box"] and shapes["outline"] > shapes["convex"] > shapes["box"]
    ring = [grid_chart([(x, y) for x in range(9) for y in range(9) if x % 8 == 0 or y % 8 == 0]), rectangle(6.0, 6.0)]
    assert coverage(ring, margin=0.01) > 0.7  # one within the other's hole: the ring's square, less margins


def test_a_hundred_stars_fill_two_thirds():
    rng = np.random.default_rng(0)
    charts = [star(rng, r) for r in rng.lognormal(0.0, 0.5, 100)]
    turned, straight = (coverage(charts, margin=0.0005, pack_rotation=r) for r in ("any", "none"))
    assert turned > 0.66 and straight > 0.6
    assert straight > 1.2 * coverage(charts, margin=0.0005, pack_shape="box")


def test_margins_are_those_of_blender():
    """Four unit squares. `tests/blender/test_packing.py` holds the same numbers against Blender's own packer."""
    squares = [rectangle(1.0, 1.0)] * 4
    for method, margin, around in (
        ("fraction", 0.02, 0.02),
        ("pixels", 10.0, 10.0 / 512),
        ("add", 0.1, 0.1 / 2.4),  # around both of two squares in a row: 2 + 4 * 0.1
        ("scaled", 0.5, 0.2 / 2.8),  # a tenth of four squares' sides, half of it
    ):
        places = placed(squares, margin, margin_method=method, image_size=512)
        low, high = (np.array([f(z.real) + 1j * f(z.imag) for z in places]) for f in (np.min, np.max))
        right, up = low.real - high.real[:, None], low.imag - high.imag[:, None]
        apart = np.maximum(np.maximum(right, right.T), np.maximum(up, up.T)) + np.diag([np.inf] * 4)
        assert min(low.real.min(), low.imag.min()) == pytest.approx(around, abs=0.003), method
        assert apart.min() == pytest.approx(2.0 * around, abs=0.003), method
        assert min(low.real.min(), low.imag.min()) > around - 1e-4 and apart.min() > 2 * around - 2e-4


@pytest.mark.parametrize("rotation", ["none", "any"])
def test_what_does_not_fill_the_square_lies_in_its_lower_left_corner(rotation):
    for charts in (SETS["strips"], [star(np.random.default_rng(i), 1.0) for i in range(3)], [L_SHAPE, L_SHAPE]):
        every = np.concatenate(placed(charts, 0.01, pack_rotation=rotation))
        assert [every.real.min(), every.imag.min()] == pytest.approx([0.01, 0.01], abs=1e-3)


def test_scales_and_tiles_are_kept():
    charts = [rectangle(0.4, 0.2), rectangle(0.3, 0.3), rectangle(5.0, 0.1)]
    found = pack_charts(charts, PlaceOptions(margin=0.01, keep_scale=True, tile=1023))
    assert found.scale.tolist() == [1.0, 1.0, 1.0]
    assert found.center.real.min() == pytest.approx(2.01) and found.center.imag.min() == pytest.approx(2.01)
    V = np.array([[0, 0, 0], [3, 0, 0], [3, 2, 0], [0, 2, 0]], dtype=float)
    u = unwrap(V, [[0, 1, 2, 3]], shape="free", keep_scale=True)
    assert np.ptp(u.uv, axis=0) == pytest.approx([3.0, 2.0])
    u = unwrap(V, [[0, 1, 2, 3]], tile=1012)
    assert u.uv.min() >= 1.0 and u.uv.max() <= 2.0


def test_grids_in_batches_are_the_same(monkeypatch):
    charts = SETS["stars"]
    whole = placed(charts, 0.005)
    monkeypatch.setattr(footprints_module, "CELLS_AT_ONCE", 1000)
    for one, other in zip(whole, placed(charts, 0.005), strict=True):
        np.testing.assert_array_equal(one, other)


def test_long_thin_charts_are_packed_on_coarser_grids(monkeypatch):
    """A thousand diagonals, each with the box of a whole grid: what is looked at stays within bounds."""
    looked = []
    first_free = FreeCells.first_free
    monkeypatch.setattr(
        FreeCells, "first_free", lambda self, *given: looked.append(self.side) or first_free(self, *given)
    )
    charts = [(np.array([0, 1 + 1j, 1.001 + 1j]) * (1 + 1e-3 * i), np.array([[0], [1], [2]])) for i in range(1000)]
    placed(charts, 0.0001)
    assert max(looked) < 1500


def test_free_places_are_those_that_trying_finds():
    """Against every place tried by itself."""
    rng = np.random.default_rng(5)
    for side in (21, 64):
        cells, filled = FreeCells(side, 6), np.zeros((side, side), dtype=bool)
        for _ in range(12):
            shape = rng.random((rng.integers(1, 12), rng.integers(1, 40))) < 0.7
            shape[0, 0] = shape[-1, -1] = True
            shape = shape[:side, :side]
            edge = np.diff(np.pad(shape, ((0, 0), (1, 1))).astype(int), axis=1)
            row, start = np.nonzero(edge == 1)
            chart = Stencil(row, start, np.nonzero(edge == -1)[1], shape.shape[1], shape.shape[0])
            found = cells.first_free(chart, side)
            for y in range(side - shape.shape[0] + 1):
                free = [
                    x
                    for x in range(side - shape.shape[1] + 1)
                    if not (filled[y : y + shape.shape[0], x : x + shape.shape[1]] & shape).any()
                ]
                assert found[y] == (free[0] if free else NOWHERE)
            y = int(found.argmin())
            if found[y] < NOWHERE:
                cells.fill(chart, int(found[y]), y, 6)
                filled[y : y + shape.shape[0], found[y] : found[y] + shape.shape[1]] |= shape


def test_charts_grow_around_the_corner_and_what_does_not_fit_is_told():
    wide = Stencil(np.array([0]), np.array([0]), np.array([5]), 5, 1)
    small = Stencil(np.array([0]), np.array([0]), np.array([2]), 2, 1)
    places = pack_cells([[small, wide, small]], 5)
    assert places is not None
    assert (places.column.tolist(), places.row.tolist()) == ([0, 0, 0], [1, 0, 2])
    assert pack_cells([[small, wide]], 4) is None


def test_the_longest_may_be_placed_first():
    """A strip of five cells and a square of nine: the first placed lies in the corner."""
    strip = Stencil(np.array([0]), np.array([0]), np.array([5]), 5, 1)
    square = Stencil(np.arange(3), np.zeros(3, dtype=int), np.full(3, 3), 3, 3)
    for longest_first, rows in ((False, [3, 0]), (True, [0, 1])):
        places = pack_cells([[strip, square]], 5, longest_first)
        assert places is not None and places.row.tolist() == rows

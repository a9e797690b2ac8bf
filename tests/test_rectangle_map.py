"""The rectangle and its modulus: surfaces whose modulus is known, the enclosure, corners, folds."""

from __future__ import annotations

import numpy as np
import pytest
from developable import cross, cylinder, folded_strip
from meshes import wheel
from nasty_meshes import EMBEDDED, REFUSED, flattened, grid
from numpy.typing import NDArray
from scipy.spatial import Delaunay

import conformal_uv as cuv
from conformal_uv import samples
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators.edge_laplacian import edge_laplacian
from conformal_uv.rectangle.corners import quarters, turning_corners
from conformal_uv.rectangle.modulus import enclosure

Real = NDArray[np.float64]
Mesh = tuple[Real, NDArray[np.int64]]


def polygon(corners: list[complex], fine: int, seed: int = 0) -> tuple[Mesh, list[int]]:
    """A convex polygon's random Delaunay triangulation, and its vertices at the corners; `fine` edges a side."""
    z = np.array(corners, dtype=complex)
    t = np.arange(fine) / fine
    rim = (z[:, None] + t * (np.roll(z, -1) - z)[:, None]).ravel()
    rng = np.random.default_rng(seed)
    weights = rng.dirichlet(np.ones(len(z)), size=4 * fine * fine)
    ways = np.roll(rim, -1) - rim
    inner = weights @ z
    depth = ((inner[:, None] - rim).conj() * ways).imag / np.abs(ways)  # minus the distances from the sides
    inner = inner[(-depth > 0.4 * np.abs(ways).mean()).all(axis=1)]
    points = np.concatenate((rim, inner))
    xy = np.column_stack((points.real, points.imag))
    F = Delaunay(xy).simplices.astype(np.int64)
    a, b, c = points[F.T]
    area = ((b - a).conj() * (c - a)).imag
    F[area < 0] = F[area < 0, ::-1]
    F = F[np.abs(area) > 1e-9]
    return (np.column_stack((xy, np.zeros(len(xy)))), F), [k * fine for k in range(len(z))]


def on_rectangle(m: cuv.RectangleMap) -> None:
    """The boundary runs along the sides, exactly, from corner to corner."""
    w = m.modulus
    np.testing.assert_array_equal(m.uv[m.corners], [[0, 0], [w, 0], [w, 1], [0, 1]])
    place = [int(np.flatnonzero(m.boundary == c)[0]) for c in m.corners]
    for k, (axis, value) in enumerate(((1, 0.0), (0, w), (1, 1.0), (0, 0.0))):
        span = (place[(k + 1) % 4] - place[k]) % len(m.boundary)
        side = m.boundary[(place[k] + np.arange(span + 1)) % len(m.boundary)]
        np.testing.assert_array_equal(m.uv[side, axis], value)
    assert (m.uv >= 0.0).all() and (m.uv <= [w, 1.0]).all()
    assert m.modulus_bounds[0] <= w <= m.modulus_bounds[1]


@pytest.mark.parametrize("width", [0.2, 1.0, 3.7])
@pytest.mark.parametrize("laplacian", ["cotan", "intrinsic-delaunay"])
def test_plane_rectangles_stay_as_they_are(width: float, laplacian: str) -> None:
    (V, F), corners = polygon([0, width, width + 1j, 1j], 12)
    m = cuv.rectangle_map(V, F, corners, laplacian=laplacian)
    on_rectangle(m)
    np.testing.assert_allclose(m.uv, V[:, :2], atol=1e-10)
    assert m.modulus == pytest.approx(width, abs=1e-10)
    low, high = m.modulus_bounds
    assert low <= width <= high < low * (1 + 1e-10)
    assert len(m.flipped) == 0 and m.status == "direct" and m.laplacian == laplacian


@pytest.mark.parametrize("sheet", [folded_strip, cylinder])
def test_rolled_and_pleated_rectangles_too(sheet) -> None:
    V, F, flat = sheet()
    m = cuv.rectangle_map(V, F)  # the corners are found
    size = np.ptp(flat, axis=0)
    assert min(abs(m.modulus - size[0] / size[1]), abs(m.modulus - size[1] / size[0])) < 1e-9
    assert m.distortion.angle_mean < 1e-6


def sector(fine: int, inner: float, outer: float, angle: float) -> tuple[Mesh, list[int]]:
    """A sector of a ring, jittered inside."""
    columns = int(fine * (outer - inner)) + 1
    rows = int(fine * angle * (outer + inner) / 2) + 1
    V, F = grid(columns + 1, rows + 1, 1.0, 1.0)
    inside = (V[:, :2] > 0).all(axis=1) & (V[:, :2] < 1).all(axis=1)
    V[inside, :2] += np.random.default_rng(1).uniform(-0.2, 0.2, (inside.sum(), 2)) / [columns, rows]
    r, t = inner + (outer - inner) * V[:, 0], angle * V[:, 1]
    last = len(V) - 1
    return (np.column_stack((r * np.cos(t), r * np.sin(t), 0 * t)), F), [0, columns, last, last - columns]


@pytest.mark.parametrize(("inner", "outer", "angle"), [(1.0, 2.0, 1.0), (0.5, 3.0, 2.0), (2.0, 2.5, 3.0)])
def test_sectors_of_rings(inner: float, outer: float, angle: float) -> None:
    """log(outer / inner) / angle, to the order of h^2; the map is the logarithm."""
    known = np.log(outer / inner) / angle
    error, gap, apart = [], [], []
    for fine in (16, 32, 64):
        (V, F), corners = sector(fine, inner, outer, angle)
        m = cuv.rectangle_map(V, F, corners)
        on_rectangle(m)
        z = V[:, :2] @ [1, 1j]
        apart.append(np.abs(m.uv @ [1, 1j] - np.log(z / inner) / angle).max())
        error.append(abs(m.modulus - known))
        gap.append(np.subtract(*m.modulus_bounds[::-1]))
    for told in (error, gap, apart):
        assert np.log2(told[0] / told[2]) / 2 > 1.7, told
    assert error[2] < 2e-3 * known


RHOMBUS = [0, 1, 1 + np.exp(1j * np.pi / 3), np.exp(1j * np.pi / 3)]
# A reflection through two opposite corners changes M into 1 / M, so that it is 1; one in a side doubles it.
KNOWN = {
    "rhombus": (RHOMBUS, [0, 1, 2, 3], 1.0),
    "kite": ([0, 2 - 1j, 5, 2 + 1j], [0, 1, 2, 3], 1.0),
    "hexagon": ([np.exp(1j * np.pi / 3 * k) for k in range(6)], [0, 1, 3, 5], 1.0),
}


@pytest.mark.parametrize("name", ["rhombus", "kite", "hexagon"])
def test_the_enclosure_holds_what_symmetry_tells_and_shrinks(name: str) -> None:
    corners, chosen, known = KNOWN[name]
    gaps = []
    for fine in (4, 8, 16):
        for seed in range(3):
            (V, F), at = polygon(corners, fine, seed)
            for laplacian in ("cotan", "intrinsic-delaunay"):
                m = cuv.rectangle_map(V, F, [at[k] for k in chosen], laplacian=laplacian)
                on_rectangle(m)
                low, high = m.modulus_bounds
                assert low <= known <= high
        gaps.append(high - low)
    assert gaps[0] > 1.3 * gaps[1] > 1.3**2 * gaps[2]


def test_the_enclosure_of_a_doubled_rhombus() -> None:
    """Beside a rhombus its mirror image in a side: modulus 2, on a surface folded along that side."""
    (V, F), at = polygon(RHOMBUS, 10)
    across = V[at[1]]
    way = V[at[2]] - across
    along = (V - across) @ way
    mirrored = across + 2 * along[:, None] * way - (V - across)  # way has length 1
    side = np.abs((V - across) @ np.array([way[1], -way[0], 0.0])) < 1e-12
    number = np.where(side, np.arange(len(V)), len(V) + np.cumsum(~side) - 1)
    W = np.concatenate((V, np.column_stack((mirrored[~side, :2], np.zeros((~side).sum())))))
    G = np.concatenate((F, number[F][:, ::-1]))
    m = cuv.rectangle_map(W, G, [at[0], number[at[0]], number[at[3]], at[3]])
    assert m.modulus_bounds[0] <= 2.0 <= m.modulus_bounds[1] < 1.2 * m.modulus_bounds[0]
    half = cuv.rectangle_map(V, F, at)
    assert m.modulus == pytest.approx(2 * half.modulus, rel=1e-12)  # the mirror image is the solution's, too


def test_quarters_of_the_circle() -> None:
    """A regular polygon turned by a quarter is itself: modulus 1, whatever its triangulation."""
    error = []
    for count in (32, 64, 128, 256):  # vertices around
        V, F = samples.flat_disk(round(count**2 / (4 * np.pi)))
        assert len(cuv.DiskMapper(V, F).boundary) == count
        m = cuv.rectangle_map(V, F, [k * count // 4 for k in range(4)])
        on_rectangle(m)
        low, high = m.modulus_bounds
        assert low <= 1.0 <= high
        error.append(max(high - 1.0, 1.0 - low))
        assert abs(m.modulus - 1.0) < 8.0 / count**2
    # Where a straight boundary gets a corner the gradient is infinite, and the enclosure is of order h; yet in the
    # modulus both energies' excess cancels, and it is of order h^2.
    assert 0.85 < np.log2(error[0] / error[3]) / 3 < 1.2


def test_corners_turned_by_one_give_reciprocals() -> None:
    V, F = samples.mask(800)
    loop = cuv.DiskMapper(V, F).boundary
    at = [int(loop[k]) for k in (0, 9, 25, 34)]
    one, other = cuv.rectangle_map(V, F, at), cuv.rectangle_map(V, F, at[1:] + at[:1])
    assert one.modulus * other.modulus == pytest.approx(1.0, abs=1e-14)
    np.testing.assert_allclose(np.multiply(one.modulus_bounds, other.modulus_bounds[::-1]), 1.0, rtol=1e-13)
    np.testing.assert_allclose(
        other.uv, np.column_stack((one.uv[:, 1], one.modulus - one.uv[:, 0])) / one.modulus, atol=1e-10
    )


def test_size_and_motion_change_nothing() -> None:
    V, F = samples.mask(800)
    m = cuv.rectangle_map(V, F)
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    for scale in (1e-9, 3e7):
        moved = cuv.rectangle_map(scale * (V @ turn.T + 0.3), F)
        np.testing.assert_array_equal(moved.corners, m.corners)
        np.testing.assert_allclose(moved.uv, m.uv, atol=1e-8)
        np.testing.assert_allclose(moved.distortion.area_scale.mean() * scale**2, m.distortion.area_scale.mean())


@pytest.mark.parametrize("bumps", [0.0, 0.1])
def test_long_strips_do_not_crowd(bumps: float) -> None:
    V, F = grid(1001, 11, 100.0, 1.0)
    V[:, 2] = bumps * np.sin(3 * V[:, 0]) * np.cos(5 * V[:, 1])
    m = cuv.rectangle_map(V, F)
    on_rectangle(m)
    assert len(m.flipped) == 0 and m.repair is None
    long, low, high = max(m.modulus, 1 / m.modulus), *m.modulus_bounds
    assert long == pytest.approx(100.0, rel=0.05 if bumps else 1e-10)
    assert high < low * (1.003 if bumps else 1 + 1e-10)
    np.testing.assert_allclose(m.distortion.angle_mean, 0.0, atol=0.5 if bumps else 1e-6)


def test_corners_that_turn_most_are_found() -> None:
    def found(z: Real) -> list[int]:
        edges = np.roll(z, -1) - z
        return turning_corners(np.angle(edges / np.roll(edges, 1)), np.abs(edges)).tolist()

    def rim(corners: list[complex], steps: list[int]) -> Real:
        ends = np.array(corners, dtype=complex)
        parts = zip(ends, np.roll(ends, -1), steps, strict=True)
        return np.concatenate([a + (b - a) * np.arange(n) / n for a, b, n in parts])

    assert found(rim([0, 1, 1 + 1j, 1j], [9, 5, 7, 20])) == [0, 9, 14, 21]
    assert found(rim([0, 300, 300 + 1j, 1j], [900, 3, 900, 3])) == [0, 900, 903, 1803]
    rounded = rim([0, 8, 8 + 5j, 5j], [80, 50, 80, 50])
    arc = np.exp(0.5j * np.pi * (np.arange(40) + 0.5) / 40)
    corners = [0, 8, 8 + 5j, 5j]
    rounded = np.concatenate([c + np.exp(0.5j * np.pi * (k - 2)) * arc for k, c in enumerate(corners)])
    assert np.abs(np.subtract(found(rounded), [20, 60, 100, 140])).max() <= 1
    t = 2 * np.pi * np.arange(200) / 200
    gaps = np.diff(found(np.exp(1j * t)), append=found(np.exp(1j * t))[0] + 200)
    assert gaps.max() <= 52 and gaps.min() >= 48  # nothing turns more than the rest: evenly spaced
    noise = [1, 1j] @ np.random.default_rng(3).normal(size=(2, 200))
    zigzag = rim([0, 8, 8 + 5j, 5j], [62, 38, 62, 38]) + 0.02 * noise
    assert np.abs(np.subtract(found(zigzag), [0, 62, 100, 162])).max() <= 4


def test_quarters_of_the_length() -> None:
    assert quarters(np.array([1.0, 1, 1, 1, 4, 4, 2, 2]), 0.0).tolist() == [0, 4, 5, 6]
    assert quarters(np.array([1.0, 1, 100, 1]), 0.0) is None


def area_spread(m: cuv.RectangleMap) -> float:
    weights, logs = m.surface.geometry.double_area, np.log(np.maximum(m.distortion.area_scale, 1e-12))
    return float(np.sqrt(np.cov(logs, aweights=weights, ddof=0)))


@pytest.mark.parametrize("mesh", [samples.mask(600), samples.terrain(600, seed=2), cross(3)[:2], wheel(9)])
def test_corners_of_least_area_distortion(mesh: Mesh) -> None:
    turning, area = cuv.rectangle_map(*mesh), cuv.rectangle_map(*mesh, corner_choice="area")
    assert area_spread(area) <= area_spread(turning) + 1e-12
    loop = cuv.DiskMapper(*mesh).boundary
    lengths = np.linalg.norm(mesh[0][np.roll(loop, -1)] - mesh[0][loop], axis=1)
    for first in (0.0, 0.125):
        at = quarters(lengths, first)
        if at is not None:
            assert area_spread(area) <= area_spread(cuv.rectangle_map(*mesh, loop[at])) + 1e-12


SQUASHED = {"serpentine maze", "fan without interior vertex"}


@pytest.mark.parametrize("name", sorted(set(EMBEDDED) - {"one triangle", "tube of 30 diameters"}))
def test_folds_are_mended(name: str) -> None:
    V, F = EMBEDDED[name]
    m, raw = cuv.rectangle_map(V, F), cuv.rectangle_map(V, F, repair="never")
    on_rectangle(raw) if name != "x stretched by 1e5" else None
    assert np.isfinite(m.uv).all() and raw.repair is None
    assert m.modulus_bounds == raw.modulus_bounds
    if name not in SQUASHED:
        assert len(m.flipped) == len(m.squashed)
        on_rectangle(m)
    if m.repair is not None:
        assert m.repair.flipped_after < m.repair.flipped_before
        assert m.repair.angle_mean_after <= m.repair.angle_mean_before + 0.5


def test_faces_on_one_side_are_told_apart() -> None:
    V, F = grid(6, 6, 1.0, 1.0)
    V = np.vstack((V, [0.5, -0.1, 0.0]))  # an ear on the lower side
    F = np.vstack((F, [2, 36, 3]))
    m = cuv.rectangle_map(V, F, [0, 5, 35, 30])
    assert m.flipped.tolist() == m.squashed.tolist() == [50]


@pytest.mark.parametrize("end", [False, True])
@pytest.mark.parametrize("side", range(4))
def test_a_corner_lies_on_both_of_its_sides(side: int, end: bool) -> None:
    """An ear beside it, on either of them."""
    V, F = grid(6, 6, 1.0, 1.0)
    corners, step = [0, 5, 35, 30], [1, 6, -1, -6][side]
    a = corners[(side + 1) % 4] - step if end else corners[side]
    outward = np.array([[0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0]])[side]
    V = np.vstack((V, 0.5 * (V[a] + V[a + step]) + 0.1 * outward))
    m = cuv.rectangle_map(V, np.vstack((F, [a, 36, a + step])), corners)
    assert m.flipped.tolist() == m.squashed.tolist() == [50]


def test_where_nothing_is_certain() -> None:
    V, F = samples.mask(400)
    m = cuv.rectangle_map(*flattened(V, F, 5, 0.0))
    assert m.modulus_bounds == (0.0, np.inf) and 0.3 < m.modulus < 3.0


def test_needles_on_mollified_lengths_are_enclosed_by_their_own_energies() -> None:
    """A plane square with needles: where lengths are mollified, the weights are not those of the surface."""
    (V, F), at = polygon([0, 1, 1 + 1j, 1j], 8)
    a, b, c = F[40]
    V[c] = 0.5 * (V[a] + V[b]) + 1e-7 * (V[c] - V[a])
    surface = Surface.from_arrays(V, F)
    assert not len(surface.degenerate)
    m = cuv.rectangle_map(V, F, at, laplacian="intrinsic-delaunay", repair="never")
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, "intrinsic-delaunay")
    x, y = surface.V[:, 0], surface.V[:, 1]
    plain = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, "cotan")
    assert enclosure(surface, laplacian, x, y) == pytest.approx(enclosure(surface, plain, x, y), rel=1e-14)
    assert m.modulus_bounds[0] > 0.0 and np.isfinite(m.modulus_bounds[1])


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_disk_is_refused(name: str) -> None:
    kind, (V, F) = REFUSED[name]
    with pytest.raises(getattr(cuv, kind)):
        cuv.rectangle_map(V, F)


V5, F5 = grid(5, 5, 1.0, 1.0)


@pytest.mark.parametrize(
    ("corners", "options", "told"),
    [
        ([0, 4, 24], {}, "3 corners; pass four"),
        (7, {}, "corners is 7; pass four"),
        ([0, 4, 24, 20.5], {}, "pass a vertex index"),
        ([0, 4, 12, 20], {}, r"Corners \[12\] are not on the boundary"),
        ([0, 4, 99, -1], {}, r"Corners \[99, -1\] are not"),
        ([0, 4, 4, 20], {}, "not four different"),
        ([0, 20, 24, 4], {}, r"boundary's direction; pass \[0, 4, 24, 20\]"),
        ([0, 4, 24, 20], {"corner_choice": "area"}, "chooses nothing"),
        (None, {"corner_choice": "largest"}, "choose turning or area"),
        (None, {"repair": "maybe"}, "choose auto, always, never"),
        (None, {"laplacian": "x"}, "laplacian is 'x'"),
        (None, {"backend": "x"}, "Unknown backend"),
    ],
)
def test_options_that_do_not_fit_are_told(corners, options: dict, told: str) -> None:
    with pytest.raises(cuv.OptionError, match=told):
        cuv.rectangle_map(V5, F5, corners, **options)


def test_a_triangle_is_no_rectangle() -> None:
    with pytest.raises(cuv.TopologyError, match="3 vertices; a rectangle has four corners"):
        cuv.rectangle_map(*EMBEDDED["one triangle"])


def test_progress_and_cancelling() -> None:
    stages: list[str] = []
    mesh = samples.mask(800)
    cuv.rectangle_map(*mesh, callback=lambda stage, part: stages.append(stage))
    assert stages[:2] == ["checks", "assembly"] and stages[-1] == "extension"
    assert stages.count("factorization") == 4  # begun and ended, for either coordinate
    for stage in set(stages):
        with pytest.raises(cuv.CancelledError, match=stage):
            cuv.rectangle_map(*mesh, callback=lambda s, part, stage=stage: s != stage)


def test_a_scanned_face(load_scan) -> None:
    """The figures of the design: 1.617 degrees, modulus between 1.0235 and 1.0633 in the prototype."""
    V, F = load_scan("scans/human_face.obj")
    loop = cuv.DiskMapper(V, F).boundary
    lengths = np.linalg.norm(V[np.roll(loop, -1)] - V[loop], axis=1)
    m = cuv.rectangle_map(V, F, loop[quarters(lengths, 0.0)])
    assert m.distortion.angle_mean <= 1.62 and len(m.flipped) == 0
    assert m.modulus_bounds[1] / m.modulus_bounds[0] < 1.04
    assert cuv.rectangle_map(V, F).distortion.angle_mean < 1.25  # by the corners that turn most

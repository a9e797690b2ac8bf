"""Least squares conformal maps with pins: against the equations of the paper, flat surfaces, and one another."""

from __future__ import annotations

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.free.conformal_operator import conformal_matrix
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators.edge_laplacian import edge_laplacian
from conformal_uv.operators.wirtinger import conformal_energy
from conformal_uv.samples import mask


def by_least_squares(V, F, pins):
    """Levy and others 2002, section 2.3: rows (conj of the edge opposite) / sqrt(double area), solved densely."""
    p1, p2 = V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]
    length = np.linalg.norm(p1, axis=1)
    along = (p1 * p2).sum(axis=1) / length
    across = np.linalg.norm(np.cross(p1, p2), axis=1) / length
    corner = np.column_stack((0 * length, length, along + 1j * across))
    double_area = length * across
    M = np.zeros((len(F), len(V)), dtype=complex)
    for k in range(3):
        opposite = corner[:, (k + 2) % 3] - corner[:, (k + 1) % 3]
        M[np.arange(len(F)), F[:, k]] += opposite / np.sqrt(double_area)
    at = np.array([complex(*place) for place in pins.values()])
    free = np.setdiff1d(np.arange(len(V)), list(pins))
    z = np.zeros(len(V), dtype=complex)
    z[list(pins)] = at
    z[free] = np.linalg.lstsq(M[:, free], -M[:, list(pins)] @ at, rcond=None)[0]
    return z.view(float).reshape(-1, 2)


@pytest.fixture(scope="module")
def surface():
    return mask(300)


PINS = [
    {0: (0.0, 0.0), 250: (1.0, 0.5)},
    {3: (0.0, 0.0), 100: (1.0, 0.0), 299: (0.3, 2.0)},
    {3: (0.0, 0.0), 100: (1.0, 0.0), 299: (0.3, 2.0), 40: (-1.0, 5.0)},
]


@pytest.mark.parametrize("pins", PINS)
@pytest.mark.parametrize("backend", ["cholmod", "superlu"])
def test_it_is_the_least_squares_solution(surface, pins, backend):
    if backend == "cholmod":
        pytest.importorskip("cvxopt")
    V, F = surface
    m = cuv.pinned_map(V, F, pins, laplacian="cotan", backend=backend)
    expected = by_least_squares(V, F, pins)
    np.testing.assert_allclose(m.uv, expected, rtol=0, atol=1e-9 * np.abs(expected).max())
    assert [tuple(place) for place in m.uv[list(pins)].tolist()] == list(pins.values())
    assert m.backend == backend and m.status == "direct"


def test_the_matrix_is_that_of_the_energy(surface):
    V, F = surface
    taken = Surface.from_arrays(V, F)
    H = conformal_matrix(taken, edge_laplacian(taken.corners, taken.edges, taken.geometry, taken.n, "cotan"))
    z = np.random.default_rng(4).normal(size=(len(V), 2)).view(complex)[:, 0]
    assert abs(H - H.conj().T).max() < 1e-15
    energy = conformal_energy(taken.geometry, z, taken.corners)
    np.testing.assert_allclose(0.5 * np.vdot(z, H @ z).real, energy, rtol=1e-12)


def test_no_other_map_with_these_pins_has_less_energy(surface):
    V, F = surface
    m = cuv.pinned_map(V, F, PINS[2], laplacian="cotan")
    taken = m.surface
    z = m.uv.view(complex)[:, 0]
    least = conformal_energy(taken.geometry, z, taken.corners)
    step = np.random.default_rng(7).normal(size=(len(V), 2)).view(complex)[:, 0]
    step[list(PINS[2])] = 0.0
    for size in (1e-3, -1e-3):
        assert conformal_energy(taken.geometry, z + size * step, taken.corners) > least


def flat():
    """A plate in the plane of x and z, its faces to -y."""
    x, z = np.meshgrid(np.linspace(0, 2, 15), np.linspace(0, 1, 9))
    k = np.arange(x.size).reshape(x.shape)
    a, b, c, d = k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]
    F = np.concatenate((np.stack((a, b, c), -1).reshape(-1, 3), np.stack((a, c, d), -1).reshape(-1, 3)))
    return np.column_stack((x.ravel(), 0 * x.ravel(), z.ravel())), F


def test_a_flat_surface_is_moved_turned_and_scaled():
    V, F = flat()
    z = (0.3 - 1.2j) * (V[:, 0] + 1j * V[:, 2]) + (4.0 + 1j)
    want = z.view(float).reshape(-1, 2)
    row, column = np.divmod(np.arange(len(F)) % (len(F) // 2), 14)  # of the square that a face is half of
    frame = F[~((row // 2 == 1) & (column // 3 == 2))]
    assert len(np.unique(frame)) == len(V) - 2
    for faces in (F, frame):  # whole, and with a hole
        used, renumbered = np.unique(faces, return_inverse=True)
        m = cuv.pinned_map(V[used], renumbered.reshape(-1, 3), {0: want[used[0]], 20: want[used[20]]})
        np.testing.assert_allclose(m.uv, want[used], rtol=0, atol=1e-10)
        assert len(m.flipped) == 0


def test_influences_give_the_map_of_moved_pins(surface):
    V, F = surface
    pins = PINS[2]
    mapper = cuv.PinnedMapper(V, F, list(pins))
    at = np.array(list(pins.values()))
    before = mapper.map(at).uv.view(complex)[:, 0]
    moved = at.copy()
    moved[1] += (0.7, -0.4)
    moved[3] += (0.1, 0.9)
    z = before + mapper.influence(1) * (0.7 - 0.4j) + mapper.influence(3) * (0.1 + 0.9j)
    fresh = cuv.pinned_map(V, F, dict(zip(pins, moved.tolist(), strict=True))).uv
    np.testing.assert_allclose(z.view(float).reshape(-1, 2), fresh, rtol=0, atol=1e-9 * np.abs(fresh).max())
    total = sum(mapper.influence(k) for k in range(4))
    np.testing.assert_allclose(total, 1.0, rtol=0, atol=1e-9)


def test_units_and_places_do_not_matter(surface):
    V, F = surface
    m = cuv.pinned_map(V, F, PINS[1]).uv
    far = {v: (1000.0 + 2.0 * x, 2.0 * y) for v, (x, y) in PINS[1].items()}
    np.testing.assert_allclose(
        cuv.pinned_map(1e6 * V, F, far).uv, 2.0 * m + [1000.0, 0.0], rtol=0, atol=1e-8 * np.abs(m).max() + 1e-9
    )


def test_all_vertices_pinned():
    square = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]), [[0, 1, 2], [0, 2, 3]]
    places = {k: (k * 1.0, k * k * 1.0) for k in range(4)}
    assert cuv.pinned_map(*square, places).uv.tolist() == [list(p) for p in places.values()]


def test_refusals(surface):
    V, F = surface
    for pins, why in (
        ([3], "Two or more"),
        ([3, 3], "pinned twice"),
        ([3, 300], "0 to 299"),
        ([-1, 3], "0 to 299"),
        ([0.5, 3.0], "Two or more"),
    ):
        with pytest.raises(cuv.OptionError, match=why):
            cuv.PinnedMapper(V, F, pins)
    mapper = cuv.PinnedMapper(V, F, [0, 1])
    for places, why in (
        ([[0, 0]], "2 pins"),
        ([[0, 0], [np.nan, 1]], "finite"),
        ([[1, 1], [1, 1]], "same place"),
    ):
        with pytest.raises(cuv.OptionError, match=why):
            mapper.map(places)
    with pytest.raises(cuv.TopologyError, match="closed"):
        cuv.PinnedMapper(np.eye(4, 3), [[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]], [0, 1])
    with pytest.raises(cuv.DisconnectedError, match="2 pieces"):
        cuv.PinnedMapper(np.concatenate((V, V + 9)), np.concatenate((F, F + 300)), [0, 1])
    with pytest.raises(cuv.DegenerateFaceError):
        cuv.PinnedMapper([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]], [0, 1])
    with pytest.raises(cuv.CancelledError):
        cuv.PinnedMapper(V, F, [0, 1], callback=lambda stage, fraction: stage != "ordering")

"""The order of elimination: a permutation for any positions, and little fill where they tell the mesh."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.csgraph import maximum_bipartite_matching
from scipy.sparse.linalg import splu

import conformal_uv as cuv
from conformal_uv import samples
from conformal_uv.linear.backends import linear_solver
from conformal_uv.linear.linear_system import LowerTriangle
from conformal_uv.linear.nested_dissection import _least_cover as least_cover
from conformal_uv.linear.nested_dissection import nested_dissection
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators.dirichlet import interior_matrix
from conformal_uv.operators.edge_laplacian import edge_laplacian

MESHES = {
    "terrain": samples.terrain(20000, seed=1),
    "mask": samples.mask(12000, seed=2),
    "deep cap": samples.spherical_cap(12000, 170.0, seed=3),
}


def interior(V: NDArray, F: NDArray) -> tuple[NDArray, LowerTriangle]:
    """Positions of the interior vertices and their matrix."""
    surface = Surface.from_arrays(V, F)
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n)
    boundary = surface.require_disk()
    return np.delete(surface.V, boundary, axis=0), interior_matrix(laplacian, boundary, surface.n)


def symmetric(matrix: LowerTriangle) -> csc_array:
    lower = csc_array((matrix.data, matrix.indices, matrix.indptr), shape=(matrix.n, matrix.n))
    return (lower + csc_array(lower.T) - csc_array((lower.diagonal(), (range(matrix.n),) * 2))).tocsc()


def fill(A: csc_array, order: NDArray | None) -> int:
    """Entries of the triangular factor; None is the library's own minimum degree order."""
    if order is not None:
        A = A[order][:, order].tocsc()
    named = "NATURAL" if order is not None else "MMD_AT_PLUS_A"
    return splu(A, permc_spec=named, diag_pivot_thresh=0.0, options={"SymmetricMode": True}).L.nnz


@pytest.mark.parametrize("name", MESHES)
def test_fill_is_near_that_of_minimum_degree(name: str) -> None:
    """Within a third of it at this size, where minimum degree is at its best; natural order has several times more."""
    points, matrix = interior(*MESHES[name])
    order = nested_dissection(points, matrix.indices, matrix.indptr)
    assert order is not None
    np.testing.assert_array_equal(np.sort(order), np.arange(matrix.n))
    A = symmetric(matrix)
    assert fill(A, order) <= 4 / 3 * fill(A, None)


def test_separators_part_the_mesh() -> None:
    """Without the vertices that come last, a mesh of n vertices falls into parts of at most 60 %: by definition."""
    from scipy.sparse.csgraph import connected_components

    points, matrix = interior(*MESHES["terrain"])
    order = nested_dissection(points, matrix.indices, matrix.indptr)
    assert order is not None
    n = matrix.n
    rest = np.sort(order[: n - 2 * int(np.sqrt(n))])  # a separator of a square grid has some sqrt(n) vertices
    label = connected_components(symmetric(matrix)[rest][:, rest], directed=False)[1]
    assert np.bincount(label).max() <= 0.6 * n


def test_positions_that_tell_nothing_are_left_to_the_library() -> None:
    _, matrix = interior(*MESHES["mask"])
    scattered = np.random.default_rng(4).random((matrix.n, 3))
    assert nested_dissection(scattered, matrix.indices, matrix.indptr) is None
    assert nested_dissection(np.zeros((matrix.n, 3)), matrix.indices, matrix.indptr) is None


@pytest.mark.parametrize("n", [1, 2, 15, 16, 17, 100])
def test_a_path_of_few_vertices(n: int) -> None:
    indptr = np.minimum(2 * np.arange(n + 1), 2 * n - 1)
    indices = np.repeat(np.arange(n), 2)[: 2 * n] + np.tile([0, 1], n)
    order = nested_dissection(np.arange(n)[:, None] * 1.0, indices[: 2 * n - 1].astype(np.int32), indptr)
    assert order is not None
    np.testing.assert_array_equal(np.sort(order), np.arange(n))


@pytest.mark.parametrize("backend", ["cholmod", "superlu"])
def test_solutions_do_not_depend_on_the_order(backend: str) -> None:
    if backend == "cholmod":
        pytest.importorskip("cvxopt")
    points, matrix = interior(*MESHES["mask"])
    order = nested_dissection(points, matrix.indices, matrix.indptr)
    rhs = np.random.default_rng(5).normal(size=(matrix.n, 2))
    plain, ordered = (linear_solver(matrix, backend, order=o) for o in (None, order))
    for b in (rhs, rhs[:, 0]):
        expected = plain.solve(b)
        # Rounding of both, times a condition number of about n.
        bound = matrix.n * 64 * np.finfo(float).eps * np.abs(expected).max()
        np.testing.assert_allclose(ordered.solve(b), expected, rtol=0, atol=bound)


def test_the_map_does_not_depend_on_the_numbering() -> None:
    """Vertices and faces shuffled: bounded as maps are between backends."""
    V, F = MESHES["mask"]
    rng = np.random.default_rng(6)
    place = rng.permutation(len(V))
    W = np.empty_like(V)
    W[place] = V
    one = cuv.disk_map(V, F, method="linear", boundary_vertex=0)
    other = cuv.disk_map(W, place[F][rng.permutation(len(F))], method="linear", boundary_vertex=int(place[0]))
    np.testing.assert_allclose(other.uv[place], one.uv, rtol=0, atol=1e-10)


def test_a_cut_is_covered_by_the_fewest_vertices() -> None:
    """As many as a largest matching has edges: a chain, a star from either side, and edges by chance."""
    rng = np.random.default_rng(4)
    chance = np.unique(np.column_stack((rng.integers(0, 40, 90), 100 + rng.integers(0, 40, 90))), axis=0)
    for edges, fewest in (
        (np.array([[0, 10], [1, 10], [1, 11], [2, 11], [2, 12]]), 3),
        (np.array([[0, 10], [0, 11], [0, 12]]), 1),
        (np.array([[0, 10], [1, 10], [2, 10], [3, 11]]), 2),
        (chance, None),
    ):
        i, j = edges.T.astype(np.int32)
        cover = least_cover(i, j)
        assert (np.isin(i, cover) | np.isin(j, cover)).all() and len(np.unique(cover)) == len(cover)
        pattern = csc_array((np.ones(len(i)), (i, j)), shape=(200, 200)).tocsr()
        assert len(cover) == (maximum_bipartite_matching(pattern) >= 0).sum()
        assert fewest is None or len(cover) == fewest


def test_covered_cuts_make_less_work(monkeypatch) -> None:
    matrix_points, matrix = interior(*MESHES["mask"])
    module = sys.modules[nested_dissection.__module__]
    filled = []
    for covered in (1 << 10, 1 << 30):
        monkeypatch.setattr(module, "COVERED", covered)
        order = nested_dissection(matrix_points, matrix.indices, matrix.indptr)
        assert order is not None and (np.sort(order) == np.arange(matrix.n)).all()
        filled.append(fill(symmetric(matrix), order))
    assert filled[0] < filled[1]


def test_a_matrix_in_another_order_is_the_same_matrix() -> None:
    _, matrix = interior(*samples.mask(500))
    order = np.random.default_rng(2).permutation(matrix.n).astype(np.int32)
    found = matrix.reordered(order)
    np.testing.assert_array_equal(symmetric(found).toarray(), symmetric(matrix).toarray()[np.ix_(order, order)])
    assert (found.indices[found.indptr[:-1]] == np.arange(matrix.n)).all()

"""The strip along the boundary as a preconditioner: near the Dirichlet-to-Neumann map, however uneven that is."""

from __future__ import annotations

import nasty_meshes
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.spatial import Delaunay

import conformal_uv as cuv
from benchmarks.speed.meshes import irregular_terrain
from conformal_uv import samples
from conformal_uv.disk.boundary_energy import BoundaryEnergy
from conformal_uv.disk.preconditioner import StripPreconditioner
from conformal_uv.errors import SolverError
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators import cotangent_laplacian, neumann_strip
from conformal_uv.operators.dirichlet import DirichletProblem
from conformal_uv.operators.edge_laplacian import cotan_edges, edge_laplacian
from conformal_uv.operators.neumann_strip import NeumannStrip


def uneven_disk(inner: int, around: int, seed: int) -> tuple[NDArray, NDArray]:
    """Random points in the disk and on its circle, joined by Delaunay: gaps from none to ten times the mean."""
    rng = np.random.default_rng(seed)
    angle = 2.0 * np.pi * np.concatenate((np.sort(rng.random(around)), rng.random(inner)))
    radius = np.concatenate((np.ones(around), 0.98 * np.sqrt(rng.random(inner))))
    V = np.column_stack((radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle))
    F = Delaunay(V[:, :2]).simplices.astype(np.int64)
    clockwise = np.linalg.det(np.concatenate((V[F][:, :, :2], np.ones((len(F), 3, 1))), axis=2)) < 0
    F[clockwise] = F[clockwise, ::-1]
    return V, F


UNEVEN = uneven_disk(2200, 300, seed=3)
MESHES = {
    "mask": samples.mask(2500, seed=1),
    "terrain": samples.terrain(2500, seed=1),
    "uneven": UNEVEN,
    "slivers": (UNEVEN[0] * [4.0, 1.0, 1.0], UNEVEN[1]),
    "few rings": samples.flat_disk(150),
    "obtuse at the boundary": irregular_terrain(2500),  # edges there are negative, and no flip mends them
}


def operators(V: NDArray, F: NDArray, kind: str) -> tuple[DirichletProblem, NDArray, NDArray]:
    """The problem, S and its approximate inverse as dense matrices."""
    surface = Surface.from_arrays(V, F)
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, kind)
    problem = DirichletProblem(laplacian, surface.require_disk(), surface.n)
    nb = len(problem.boundary)
    S = problem.Lbb.toarray() - problem.Lbi @ problem.solve(problem.Lib.toarray())
    return problem, S, problem.boundary_inverse(np.eye(nb))


def on_boundary(problem: DirichletProblem) -> NDArray:
    """Edges with both ends on the boundary."""
    rim = np.zeros(problem.n, dtype=bool)
    rim[problem.boundary] = True
    return rim[problem.laplacian.lo] & rim[problem.laplacian.hi]


@pytest.mark.parametrize("kind", ["cotan", "intrinsic-delaunay"])
@pytest.mark.parametrize("name", MESHES)
def test_it_is_near_the_inverse(name: str, kind: str) -> None:
    """Energies of functions with mean 0 are those of S to a factor of 3, of 6 where inner weights are negative."""
    problem, S, inverse = operators(*MESHES[name], kind)
    np.testing.assert_allclose(inverse, inverse.T, atol=1e-12 * np.abs(inverse).max())
    nb = len(S)
    basis = np.linalg.qr(np.column_stack((np.ones(nb), np.eye(nb)[:, 1:])))[0][:, 1:]
    size = eigh(basis.T @ S @ basis, basis.T @ np.linalg.inv(inverse) @ basis, eigvals_only=True)
    inner = (problem.laplacian.weights < 0.0) & ~on_boundary(problem)
    factor = 6.0 if inner.any() else 3.0
    assert 1.0 / factor < size[0] and size[-1] < factor
    ones = inverse @ np.ones(nb)
    assert ones @ np.ones(nb) > 0.0


def test_where_it_is_the_whole_mesh_it_is_the_inverse() -> None:
    V, F = samples.flat_disk(25)
    _, S, inverse = operators(V, F, "cotan")
    x = np.random.default_rng(0).normal(size=len(S))
    found = inverse @ (S @ x)
    np.testing.assert_allclose(found - found.mean(), x - x.mean(), atol=1e-9)


def test_what_is_left_indefinite_by_the_cut_is_made_positive(monkeypatch) -> None:
    """The first matrix refused, all negative weights are replaced."""
    V, F = MESHES["uneven"]
    V = V * [3.0, 1.0, 1.0]
    surface = Surface.from_arrays(V, F)
    laplacian, boundary = cotan_edges(surface.edges, surface.geometry), surface.require_disk()
    assert (laplacian.weights < 0.0).any()
    solver, seen = neumann_strip.linear_solver, []

    def refusing(matrix, backend):
        seen.append(matrix.data.copy())
        if len(seen) == 1:
            raise SolverError("not positive definite")
        return solver(matrix, backend)

    monkeypatch.setattr(neumann_strip, "linear_solver", refusing)
    strip = NeumannStrip(laplacian, boundary, surface.n)
    off_diagonal = [data[data < 0.0].sum() for data in seen]
    assert len(seen) == 2 and off_diagonal[1] < off_diagonal[0] + 1e-12
    r = np.random.default_rng(1).normal(size=len(boundary))
    assert r @ strip(r) > 0.0


def test_newton_needs_few_products_on_an_uneven_boundary() -> None:
    """A Fourier multiplier takes 30 to 60 products for each of these directions."""
    V, F = MESHES["uneven"]
    m = cuv.disk_map(V, F, method="newton")
    assert m.converged and max(row.cg_steps for row in m.history) <= 15
    L = cotangent_laplacian(V, F)
    assert m.dirichlet_energy == pytest.approx(0.5 * np.einsum("nk,nk->", m.uv, L @ m.uv), rel=1e-9)


def test_long_waves_cost_what_the_hessian_says() -> None:
    """On the flat disk the Hessian of a wave is |k| - 1 times what S's inverse without the 1 would make of it."""
    V, F = samples.flat_disk(4000)
    surface = Surface.from_arrays(V, F)
    problem = DirichletProblem(cotan_edges(surface.edges, surface.geometry), surface.require_disk(), surface.n)
    theta = np.unwrap(np.arctan2(*V[problem.boundary, 1::-1].T))
    energy, inverse = BoundaryEnergy(problem, theta, minus_area=True), StripPreconditioner(problem, theta)
    for k in (2, 3, 5):
        wave = np.cos(k * theta)
        back = inverse(energy.hessian_product(wave))
        assert back @ wave / (wave @ wave) == pytest.approx(1.0, abs=0.15), k  # 1/2, 2/3 and 4/5 for S alone


def test_a_crowded_boundary_that_stalls_is_tried_with_smooth_directions() -> None:
    """41.7 degrees by a Fourier multiplier alone; 55, and no end, with the strip alone."""
    V, F = nasty_meshes.V0 * [1e5, 1.0, 1.0], nasty_meshes.F0
    m = cuv.disk_map(V, F, method="newton")
    assert m.converged and m.distortion.angle_mean < 45.0

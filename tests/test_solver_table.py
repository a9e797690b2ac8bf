"""Every way through the solvers in one table: what each must hold, and which of them must agree.

A row is (method, objective, laplacian, backend). Rows that minimise the same energy by other means are each other's
oracle; the tolerances are those of the stopping criteria, not of the machine.
"""

from __future__ import annotations

from functools import cache
from itertools import product

import numpy as np
import pytest
from test_disk_map import assert_is_a_disk_embedding

import conformal_uv as cuv
from conformal_uv import samples
from conformal_uv.mesh import Surface
from conformal_uv.operators.edge_laplacian import edge_laplacian
from conformal_uv.options import Backend, Laplacian, Method, Objective

V, F = samples.terrain(200, seed=4)
CHOICES = (
    [method for method in Method if method != "auto"],
    list(Objective),
    [name for name in Laplacian if name != "auto"],
    [name for name in Backend if name not in ("auto", "petsc")],
)


def possible(method: str, objective: str, laplacian: str, backend: str) -> bool:
    """The augmented Lagrangian's matrices are indefinite, and its problem has the mesh's own cotangents."""
    return method != "augmented-lagrangian" or (laplacian, backend) == ("cotan", "superlu")


TABLE = [row for row in product(*CHOICES) if possible(*row)]


@cache
def solved(method: str, objective: str, laplacian: str, backend: str, pin_mode: str) -> cuv.DiskMap:
    pins = tuple(int(v) for v in cuv.DiskMapper(V, F).boundary[[3, 14, 30]])
    return cuv.disk_map(
        V, F, method=method, objective=objective, laplacian=laplacian, backend=backend, pins=pins, pin_mode=pin_mode
    )


def dirichlet(m: cuv.DiskMap, laplacian: str) -> float:
    surface = Surface.from_arrays(V, F)
    edges = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, laplacian)
    return edges.energy(m.uv[:, 0] + 1j * m.uv[:, 1])


def conformal(m: cuv.DiskMap, laplacian: str) -> float:
    x, y = m.uv[m.boundary].T
    return dirichlet(m, laplacian) - 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


@pytest.mark.parametrize("row", TABLE, ids="-".join)
def test_each_row(row: tuple[str, ...]) -> None:
    method = row[0]
    m = solved(*row, "constraint" if method == "augmented-lagrangian" else "moebius")
    assert m.converged
    assert (m.method, m.objective) == row[:2]
    assert (m.laplacian, m.backend) == row[2:]
    assert_is_a_disk_embedding(m, F)
    z = m.uv[:, 0] + 1j * m.uv[:, 1]
    roots = np.exp(2j * np.pi * np.arange(3) / 3)
    np.testing.assert_allclose(z[list(m.pins)], roots, rtol=0, atol=1e-8)
    # whatever is minimised, the energies told are those of the mesh's own cotangents
    assert m.dirichlet_energy == pytest.approx(dirichlet(m, "cotan"), rel=1e-9)
    assert m.conformal_energy == pytest.approx(conformal(m, "cotan"), rel=1e-6)


@pytest.mark.parametrize(("objective", "laplacian"), list(product(*CHOICES[1:3])), ids="-".join)
def test_backends_have_one_answer(objective: str, laplacian: str) -> None:
    """Factorizations to rounding; multigrid stops at the tolerance that it documents."""
    for method in ("linear", "newton"):
        direct, other, iterative = (
            solved(method, objective, laplacian, backend, "moebius").uv
            for backend in ("cholmod", "superlu", "multigrid")
        )
        np.testing.assert_allclose(other, direct, rtol=0, atol=1e-8)
        np.testing.assert_allclose(iterative, direct, rtol=0, atol=1e-6)


@pytest.mark.parametrize("objective", CHOICES[1])
@pytest.mark.parametrize("backend", ["cholmod", "superlu"])
def test_two_algorithms_have_one_minimiser(objective: str, backend: str) -> None:
    """The augmented Lagrangian stops at residuals of 1e-8."""
    newton = solved("newton", objective, "cotan", backend, "constraint")
    report = solved("augmented-lagrangian", objective, "cotan", "superlu", "constraint")
    np.testing.assert_allclose(report.uv, newton.uv, rtol=0, atol=1e-7)


@pytest.mark.parametrize("laplacian", CHOICES[2])
def test_each_minimises_its_own_objective(laplacian: str) -> None:
    """Under the same pins neither minimiser can have less of the other's energy."""
    one = solved("newton", "conformal", laplacian, "cholmod", "constraint")
    other = solved("newton", "dirichlet", laplacian, "cholmod", "constraint")
    assert conformal(one, laplacian) < conformal(other, laplacian) - 1e-9
    assert dirichlet(other, laplacian) < dirichlet(one, laplacian) - 1e-9

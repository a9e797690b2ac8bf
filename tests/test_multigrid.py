"""The iterative solver against the direct one, what it does when it fails, and the memory that decides for it."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv import samples
from conformal_uv.errors import CancelledError, MissingDependencyError, SolverError
from conformal_uv.linear import backends, memory, multigrid
from conformal_uv.linear.backends import linear_solver
from conformal_uv.linear.linear_system import LowerTriangle
from conformal_uv.linear.multigrid import Multigrid
from conformal_uv.mesh import Surface
from conformal_uv.operators import DirichletProblem, dirichlet
from conformal_uv.operators.edge_laplacian import EdgeLaplacian, edge_laplacian
from conformal_uv.progress import Progress

pytest.importorskip("pyamg")

SAME = 1e-7  # what maps by both solvers may differ by in uv


def surface_and_laplacian(n: int) -> tuple[Surface, EdgeLaplacian]:
    surface = Surface.from_arrays(*samples.terrain(n))
    return surface, edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n)


@pytest.fixture(scope="module")
def matrix() -> LowerTriangle:
    surface, laplacian = surface_and_laplacian(4000)
    return dirichlet.interior_matrix(laplacian, surface.require_disk(), surface.n)


@pytest.mark.parametrize("shape", [(), (1,), (3,)])
def test_solution_is_the_direct_one(matrix: LowerTriangle, shape: tuple[int, ...]) -> None:
    """For one and for several right-hand sides, which stay as they were."""
    solver = Multigrid(matrix, Progress())
    rhs = np.random.default_rng(3).normal(size=(matrix.n, *shape))
    kept = rhs.copy()
    x, expected = solver.solve(rhs), linear_solver(matrix).solve(rhs)
    assert solver.backend == "multigrid"
    assert x.shape == rhs.shape
    assert np.abs(x - expected).max() <= 1e-11 * np.abs(expected).max()
    np.testing.assert_array_equal(rhs, kept)


def test_steps_do_not_grow_with_the_mesh() -> None:
    steps = []
    for n in (2000, 32000):
        surface, laplacian = surface_and_laplacian(n)
        solver = Multigrid(dirichlet.interior_matrix(laplacian, surface.require_disk(), surface.n), Progress())
        solver.solve(np.ones(solver._matrix.shape[0]))
        steps.append(solver.steps)
    assert steps[1] <= steps[0] + 4


def test_nothing_to_solve_for(matrix: LowerTriangle) -> None:
    """Zeros give zeros, also beside a right-hand side that is not; refinement asks for that."""
    rhs = np.zeros((matrix.n, 2))
    rhs[5, 1] = 1.0
    x = Multigrid(matrix, Progress()).solve(rhs)
    assert not x[:, 0].any() and x[5, 1] > 0.0


@pytest.mark.parametrize("size", [1e-200, 1e200])
def test_scale_of_the_right_hand_side_is_outside_of_single_precision(matrix: LowerTriangle, size: float) -> None:
    rhs = np.ones(matrix.n)
    solver = Multigrid(matrix, Progress())
    scale = np.sqrt(size)  # so that the energy, its square, is still a double
    np.testing.assert_allclose(solver.solve(scale * rhs), scale * solver.solve(rhs), rtol=1e-9)


@pytest.mark.parametrize("lower", [[4.0], [4.0, -1.0, 4.0]])
def test_smallest_matrices(lower: list[float]) -> None:
    n = 1 if len(lower) == 1 else 2
    indices, indptr = (([0], [0, 1]), ([0, 1, 1], [0, 2, 3]))[n - 1]
    tiny = LowerTriangle(np.array(lower), np.array(indices, dtype=np.int32), np.array(indptr, dtype=np.int64))
    full = np.diag([4.0] * n) - (np.ones((n, n)) - np.eye(n))
    np.testing.assert_allclose(full @ Multigrid(tiny, Progress()).solve(np.ones(n)), np.ones(n), rtol=1e-12)


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_map_is_that_of_the_direct_solver(method: str) -> None:
    V, F = samples.terrain(10000)
    direct = cuv.disk_map(V, F, method=method)
    iterative = cuv.disk_map(V, F, method=method, backend="multigrid")
    assert iterative.backend == "multigrid" and direct.backend != "multigrid"
    assert iterative.converged
    assert iterative.center == direct.center
    assert np.abs(iterative.uv - direct.uv).max() < SAME


@pytest.mark.parametrize("laplacian", ["cotan", "intrinsic-delaunay"])
@pytest.mark.parametrize("method", ["linear", "newton"])
def test_map_of_a_scan_is_that_of_the_direct_solver(load_scan, method: str, laplacian: str) -> None:
    """A face of thin triangles, with negative weights and without; Newton comes to its own tolerance."""
    V, F = load_scan("scans/human_face.obj")
    direct = cuv.disk_map(V, F, method=method, laplacian=laplacian)
    iterative = cuv.disk_map(V, F, method=method, laplacian=laplacian, backend="multigrid")
    assert iterative.backend == "multigrid" and direct.backend != "multigrid"
    assert iterative.converged
    assert iterative.center == direct.center
    assert np.abs(iterative.uv - direct.uv).max() < SAME


def test_harmonic_measure_from_next_to_the_boundary() -> None:
    """A single delta as right-hand side, where almost all of the measure falls to few vertices."""
    surface, laplacian = surface_and_laplacian(4000)
    boundary = surface.require_disk()
    direct = DirichletProblem(laplacian, boundary, surface.n)
    iterative = DirichletProblem(laplacian, boundary, surface.n, backend="multigrid")
    for vertex in (int(direct.interior[0]), int(direct.interior[len(direct.interior) // 2])):
        measure = iterative.harmonic_measure(vertex)
        assert abs(measure.sum() - 1.0) < 1e-10
        assert np.abs(np.cumsum(measure - direct.harmonic_measure(vertex))).max() < 1e-10


def test_cancel_inside_a_solve(matrix: LowerTriangle) -> None:
    """It stops at the step at which the callback says so; a later solution obeys a callback of its own."""
    seen: list[float] = []

    def stop_at_third(stage: str, fraction: float) -> bool:
        if stage == "conjugate gradients":
            seen.append(fraction)
        return len(seen) < 3

    solver = Multigrid(matrix, Progress(stop_at_third))
    with pytest.raises(CancelledError, match="conjugate gradients"):
        solver.solve(np.ones(matrix.n))
    assert len(seen) == solver.steps == 3
    solver.report_to(Progress())
    assert solver.solve(np.ones(matrix.n)).min() > 0.0


def test_progress_of_all_right_hand_sides_together(matrix: LowerTriangle) -> None:
    seen: list[tuple[str, float]] = []
    solver = Multigrid(matrix, Progress(lambda stage, fraction: seen.append((stage, fraction))))
    assert seen == [("factorization", 0.0), ("factorization", 1.0)]
    solver.solve(np.ones((matrix.n, 2)))
    fractions = [fraction for _, fraction in seen[2:]]
    assert len(fractions) == solver.steps
    assert fractions == sorted(fractions) and fractions[-1] == 1.0


def test_a_mapper_reports_to_whoever_asks_now() -> None:
    """The solver that is kept forgets the first callback, and obeys the second one's cancel inside a solution."""
    first: list[str] = []
    mapper = cuv.DiskMapper(*samples.terrain(2000), backend="multigrid")
    mapper.map(method="linear", callback=lambda stage, _: first.append(stage))
    told = len(first)
    assert "conjugate gradients" in first
    with pytest.raises(CancelledError, match="conjugate gradients"):
        mapper.map(method="newton", callback=lambda stage, _: stage != "conjugate gradients")
    assert len(first) == told
    assert mapper.map(method="newton").converged


def test_multigrid_where_a_factorization_does_not_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    """By itself only; what the caller or the environment names is obeyed."""
    V, F = samples.terrain(500)
    monkeypatch.delenv("CONFORMAL_UV_BACKEND", raising=False)
    monkeypatch.setattr(backends, "factorization_fits", lambda n, backend: False)
    assert cuv.disk_map(V, F, method="linear").backend == "multigrid"
    assert cuv.disk_map(V, F, method="linear", backend="superlu").backend == "superlu"
    monkeypatch.setenv("CONFORMAL_UV_BACKEND", "superlu")
    assert cuv.disk_map(V, F, method="linear").backend == "superlu"


def test_without_pyamg_a_factorization_is_tried_all_the_same(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.delenv("CONFORMAL_UV_BACKEND", raising=False)
    monkeypatch.setattr(backends, "factorization_fits", lambda n, backend: False)
    real = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name, *a: None if name == "pyamg" else real(name, *a))
    assert cuv.disk_map(*samples.terrain(500), method="linear").backend in ("cholmod", "superlu")
    assert "may not fit into memory" in caplog.text


def test_no_convergence_is_typed(matrix: LowerTriangle, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(multigrid, "MOST_STEPS", 3)
    with pytest.raises(SolverError, match=r"stopped after 3 steps at a relative error of .*cholmod"):
        Multigrid(matrix, Progress()).solve(np.ones(matrix.n))


def test_rounding_above_the_tolerance_is_accepted(matrix: LowerTriangle, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(multigrid, "TOLERANCE", 1e-30)
    monkeypatch.setattr(multigrid, "ROUNDING", 0.0)
    monkeypatch.setattr(multigrid, "MOST_STEPS", 40)
    solver = Multigrid(matrix, Progress())
    x, expected = solver.solve(np.ones(matrix.n)), linear_solver(matrix).solve(np.ones(matrix.n))
    assert solver.steps == 40
    assert np.abs(x - expected).max() <= 1e-12 * np.abs(expected).max()


@pytest.mark.parametrize("last", [1.0, -4.0])
def test_matrix_that_is_not_positive_definite_is_refused(last: float) -> None:
    """[[1, -1], [-1, last]]: singular, and indefinite."""
    indices, indptr = np.array([0, 1, 1], dtype=np.int32), np.array([0, 2, 3], dtype=np.int64)
    solver = Multigrid(LowerTriangle(np.array([1.0, -1.0, last]), indices, indptr), Progress())
    with pytest.raises(SolverError, match="singular|not positive definite"):
        solver.solve(np.array([0.0, 1.0]))


def test_missing_pyamg_is_typed(matrix: LowerTriangle, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyamg", None)
    with pytest.raises(MissingDependencyError, match=r'pip install "conformal-uv\[large\]"'):
        Multigrid(matrix, Progress())


# --- memory -------------------------------------------------------------------------------------------------


@pytest.fixture
def system(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """A function from texts by file name to a system without psutil and without limits of its own but these."""
    monkeypatch.setitem(sys.modules, "psutil", None)
    monkeypatch.setattr(memory, "PROC", tmp_path / "proc")
    monkeypatch.setattr(memory, "CGROUPS", tmp_path / "cgroup")
    monkeypatch.setattr(memory, "_address_space_rest", lambda: None)

    def write(**files: str) -> None:
        for name, text in files.items():
            path = tmp_path / name.replace("__", "/").replace("_DOT_", ".")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)

    return write


def test_memory_at_hand_here() -> None:
    at_hand = memory.memory_at_hand()
    assert at_hand is None or 2**20 < at_hand < 2**50


def test_memory_that_nothing_tells_of(system) -> None:
    """A factorization is then taken to fit."""
    assert memory.memory_at_hand() is None
    assert memory.factorization_fits(10**9, "superlu")


def test_memory_without_psutil(system) -> None:
    system(proc__meminfo="MemTotal: 4000 kB\nMemAvailable: 3000 kB\n")
    assert memory.memory_at_hand() == 3000 * 1024


def test_memory_of_control_groups(system) -> None:
    """The tightest on the way up bounds; cached files count as free."""
    system(
        proc__meminfo="MemAvailable: 3000 kB\n",
        proc__self__cgroup="0::/job/step\n",
        cgroup__job__step__memory_DOT_max="max\n",
        cgroup__job__step__memory_DOT_current="9000\n",
        cgroup__job__memory_DOT_max="100000\n",
        cgroup__job__memory_DOT_current="90000\n",
        cgroup__job__memory_DOT_stat="anon 1\ninactive_file 500\n",
    )
    assert memory.memory_at_hand() == 10500


def test_memory_of_control_groups_of_version_1(system) -> None:
    system(
        proc__meminfo="MemAvailable: 3000 kB\n",
        proc__self__cgroup="5:cpu,cpuacct:/x\n4:memory:/docker/ab:c\n",
        cgroup__memory__memory_DOT_limit_in_bytes="70000\n",
        cgroup__memory__memory_DOT_usage_in_bytes="90000\n",
    )
    assert memory.memory_at_hand() == 0


def test_memory_under_a_limit_on_the_address_space(monkeypatch: pytest.MonkeyPatch) -> None:
    resource = pytest.importorskip("resource")
    monkeypatch.setattr(resource, "getrlimit", lambda _: (2**20, 2**20))
    assert memory.memory_at_hand() == 0  # Python alone takes more


@pytest.mark.parametrize("backend", ["cholmod", "superlu"])
def test_factorization_fits_by_its_memory(monkeypatch: pytest.MonkeyPatch, backend: str) -> None:
    needed = memory.factorization_memory(10**6, backend)
    assert 5 * 10**8 < needed < 5 * 10**9
    assert memory.factorization_memory(4 * 10**6, backend) > 4 * needed
    for at_hand, fits in ((needed, True), (needed - 1, False)):
        monkeypatch.setattr(memory, "memory_at_hand", lambda at_hand=at_hand: at_hand)
        assert memory.factorization_fits(10**6, backend) == fits

"""Threads, cvxopt's global options, and memory over many maps; at full length in long_run.py."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from long_run import differing, growth

import conformal_uv as cuv
from conformal_uv.linear import cholesky
from conformal_uv.samples import mask


def test_threads_give_the_serial_results_bit_for_bit() -> None:
    assert differing(4, 12, 3000) == []


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_maps_leave_no_memory_behind() -> None:
    """cvxopt's spsolve left 5.3 KB a map: 2.6 MB over these."""
    assert growth(800, warm=300) < 1_000_000


@pytest.mark.parametrize("options", [{"nmethods": 1}, {"supernodal": 0, "dbound": 1e300}, {"nmethods": "many"}])
def test_the_users_cholmod_options_are_kept_and_do_not_matter(options: dict[str, object]) -> None:
    cholmod = pytest.importorskip("cvxopt").cholmod
    V, F = mask(300)
    expected = cuv.disk_map(V, F, backend="cholmod").uv
    cholmod.options.update(options)
    try:
        found = cuv.disk_map(V, F, backend="cholmod").uv
        assert cholmod.options == options
    finally:
        cholmod.options.clear()
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("kind", [ValueError, TypeError, MemoryError, ArithmeticError])
def test_whatever_a_factorization_raises_is_a_solver_error(
    kind: type[Exception], monkeypatch: pytest.MonkeyPatch
) -> None:
    cholmod = pytest.importorskip("cvxopt").cholmod

    def failing(*args: object, **keywords: object) -> None:
        raise kind("no")

    V, F = mask(300)
    for module, name, backend in (
        (cholmod, "symbolic", "cholmod"),
        (cholmod, "numeric", "cholmod"),
        (cholmod, "solve", "cholmod"),
        (cholesky, "splu", "superlu"),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(module, name, failing)
            with pytest.raises(cuv.SolverError):
                cuv.disk_map(V, F, backend=backend)

"""The limit: SuperLU's factorization of the interior Laplacian and three solves, from a matrix in memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from .outcome import Arrays, Outcome, Stage
from .residual import worst_residual


def run(arrays: Arrays, stage: Stage, *, ordered: bool) -> Outcome:
    """Factorize in minimum degree order, or in the order that came with the matrix."""
    stage("build")
    data, indices, indptr = arrays["data"], arrays["indices"], arrays["indptr"].astype(np.int32)
    n = len(indptr) - 1
    lower = csc_array((data, indices, indptr), shape=(n, n))
    strict = lower.copy()
    strict.data[indptr[:-1]] = 0.0
    full = (lower + strict.T).tocsc()
    del lower, strict
    perm: NDArray[np.integer] = np.arange(n)
    if ordered:
        perm = arrays["perm"]
        full = full[perm][:, perm].tocsc()
    full.indices, full.indptr = full.indices.astype(np.int32), full.indptr.astype(np.int32)
    stage("factorization")
    factor = splu(
        full,
        permc_spec="NATURAL" if ordered else "MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    stage("solves")
    for _ in range(3):
        x = factor.solve(np.ones(n))

    def residual() -> float:
        back = np.empty(n)
        back[perm] = x
        return worst_residual(arrays, back)

    return Outcome(None, {"residual": residual})

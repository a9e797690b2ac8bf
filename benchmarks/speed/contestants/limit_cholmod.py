"""The limit: CHOLMOD's factorization of the interior Laplacian and three solves, from a matrix in memory."""

from __future__ import annotations

import numpy as np
from cvxopt import cholmod, matrix, spmatrix

from .outcome import Arrays, Outcome, Stage
from .residual import worst_residual


def run(arrays: Arrays, stage: Stage, *, ordered: bool) -> Outcome:
    """Factorize with CHOLMOD's own choice of an ordering, or with the one that came with the matrix."""
    stage("build")
    data, indices, indptr = arrays["data"], arrays["indices"], arrays["indptr"]
    n = len(indptr) - 1
    columns = np.repeat(np.arange(n), np.diff(indptr))
    lower = spmatrix(matrix(data), matrix(indices.astype(np.int64)), matrix(columns), (n, n))
    del columns
    stage("ordering")
    if ordered:
        cholmod.options["nmethods"] = 1
        factor = cholmod.symbolic(lower, p=matrix(arrays["perm"].astype(np.int64)), uplo="L")
    else:
        factor = cholmod.symbolic(lower, uplo="L")
    stage("factorization")
    cholmod.numeric(lower, factor)
    stage("solves")
    for _ in range(3):
        x = matrix(1.0, (n, 1))
        cholmod.solve(factor, x)
    return Outcome(None, {"residual": lambda: worst_residual(arrays, np.array(x).reshape(-1))})

"""The matrix of the limit, made in a process of its own: ``python -m benchmarks.speed.matrices MESH OUT``.

It is the interior block of the Laplacian that the map of the mesh is solved with, and, where there is one, the order
in which ours eliminates it.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np

from conformal_uv.linear.nested_dissection import nested_dissection
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators.dirichlet import interior_matrix
from conformal_uv.operators.edge_laplacian import edge_laplacian

__all__ = ["save_matrix"]


def save_matrix(mesh: Path, out: Path) -> None:
    """Lower triangle in CSC form, and `perm`."""
    with np.load(mesh) as arrays:
        surface = Surface.from_arrays(arrays["V"], arrays["F"])
    boundary = surface.require_disk()
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, "auto")
    lower = interior_matrix(laplacian, boundary, surface.n)
    told: dict[str, Any] = {"data": lower.data, "indices": lower.indices, "indptr": lower.indptr}
    inside = np.ones(surface.n, dtype=bool)
    inside[boundary] = False
    perm = nested_dissection(surface.V[inside], lower.indices, lower.indptr)
    if perm is not None:
        told["perm"] = perm
    np.savez(out, **told)


if __name__ == "__main__":
    save_matrix(Path(sys.argv[1]), Path(sys.argv[2]))

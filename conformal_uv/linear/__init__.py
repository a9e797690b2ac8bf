"""Solvers of sparse systems, which know nothing of meshes: factorizations, multigrid, elimination orders, memory."""

from .backends import choose_backend, linear_solver
from .linear_system import LinearSolver, LowerTriangle
from .nested_dissection import nested_dissection

__all__ = [
    "LinearSolver",
    "LowerTriangle",
    "choose_backend",
    "linear_solver",
    "nested_dissection",
]

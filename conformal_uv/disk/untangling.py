"""Folds taken out by optimisation: a barrier that is soft at first, and hardened until nothing is folded.

V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, "Foldover-free maps in 50 lines of code", ACM
Transactions on Graphics 40(4), 2021. Only vertices near folds move, and these to where angles are best; so it costs
few angles, and unlike means of neighbours it moves a boundary that is free.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..mesh.stars import faces_at
from ..mesh.surface import Surface
from ..operators.conformal_barrier import BarrierPlace, FaceDerivatives
from ..optimize import lbfgs
from ..progress import Progress

__all__ = ["untangled"]

Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]

RINGS = (1, 2, 4, 8)  # of the vertices that move, around a fold
HARDENINGS = 12
STEPS = 30  # at each
HARD = 1e-9  # of the mean area scale; as good as a barrier
TOLERANCE = 1e-3
SMALLEST = 1e-140  # mean area scale of a patch that has not shrunk to a point: its hardest softness has a square


def untangled(
    surface: Surface,
    z: Complex,
    movable: NDArray[np.bool_],
    folds_of: Callable[[Complex], Ints],
    backend: str,
    progress: Progress,
) -> Complex:
    """Positions with fewer folds; z itself where none are found.

    Parameters
    ----------
    movable : (n,) bool
        Vertices that may move, if they are near a fold.
    folds_of : callable
        The faces folded at positions.
    """
    folds = folds_of(z)
    for number, rings in enumerate(RINGS):
        if not len(folds):
            break
        progress("repair", number / len(RINGS))
        patch = _around(surface.corners, folds, rings, surface.n) & movable
        if not patch.any():
            continue
        try:
            moved = _hardened(surface, z, patch, backend, progress)
        except SolverError:  # slivers: the patch's Hessian is singular
            continue
        left = folds_of(moved)
        if len(left) < len(folds):
            z, folds = moved, left
    return z


def _around(corners: NDArray[np.int32], faces: Ints, rings: int, n: int) -> NDArray[np.bool_]:
    """Vertices of the faces, and those within so many rings of them."""
    near = np.zeros(n, dtype=bool)
    near[corners[:, faces]] = True
    for _ in range(rings):
        near[corners.take(faces_at(corners, near), axis=1)] = True
    return near


def _hardened(surface: Surface, z: Complex, patch: NDArray[np.bool_], backend: str, progress: Progress) -> Complex:
    """z with the patch where the energy is least, its barrier as hard as it gets."""
    if patch.all():
        patch = patch.copy()
        patch[surface.loops[0][:2]] = False  # a similarity changes nothing
    faces = np.setdiff1d(faces_at(surface.corners, patch), surface.degenerate, assume_unique=True)
    near = np.unique(surface.corners.take(faces, axis=1)).astype(np.int64)
    free = np.flatnonzero(patch.take(near))  # others of the patch have nothing that holds them
    if not len(free):
        return z
    place = BarrierPlace(FaceDerivatives(surface, faces, near), free, z.take(near))
    size = float(np.abs(place.jacobian).mean())
    if size < SMALLEST:
        return z
    place = place.softened(_softness(float(place.jacobian.min()), size))
    for _ in range(HARDENINGS):
        inverse = place.held_hessian(surface.V[near[free]], backend).solve
        place, _status = lbfgs(
            place, inverse, tolerance=TOLERANCE, max_iterations=STEPS, progress=progress, stage="repair"
        )
        worst = float(place.jacobian.min())
        if worst > 0.0 and place.softness <= HARD * size:
            break
        place = place.softened(HARD * size if worst > 0.0 else _softness(worst, 0.5 * place.softness))
    out = z.copy()
    out[near] = place.z
    return out


def _softness(worst: float, size: float) -> float:
    """A softness in which the most folded face still has some weight."""
    return float(np.sqrt(size * (size + max(-worst, 0.0)))) * 0.5

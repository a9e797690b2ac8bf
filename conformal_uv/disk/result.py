"""The result of a map to the disk."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..concise import Concise
from ..mesh.surface import Surface
from ..operators.distortion import Distortion, distortion_of
from ..operators.orientation_sign import orientation_signs
from ..operators.plane_map import unresolved_faces
from ..operators.wirtinger import conformal_energy, enclosed_area
from ..optimize import AugmentedLagrangianStep, NewtonStep
from ..options import DiskOptions
from ..shown import Shown
from .repair import Repair
from .solution import Solution

__all__ = ["DiskMap", "disk_map_result"]

Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False, repr=False)
class DiskMap(Shown, Concise):
    """A map of a surface to the unit disk.

    Attributes
    ----------
    uv : (n, 2) float64
        Position of every vertex, ``|uv| <= 1``; boundary vertices on the circle to 1e-12.
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.
    dirichlet_energy : float
        1/2 uv' L uv, L the cotangent Laplacian with weights (cot a + cot b) / 2; where faces have no area, the
        Laplacian that was solved with.
    conformal_energy : float
        Dirichlet energy minus signed area of the image; 0 where all angles are kept.
    flipped : (k,) int64
        Faces with non-positive signed area in uv, decided exactly.
    lost_to_double : (k,) int64
        Those of them whose height is within the rounding of the positions: crowded faces, too small in the disk for
        doubles to hold.
    converged : bool
        Whether the method reached its tolerance; always true of "linear", which does not iterate.
    history : tuple
        A row for each iteration: NewtonStep or AugmentedLagrangianStep; empty for "linear".
    repair : Repair or None
        What restoring folded faces cost; None where nothing was done.
    method, objective : str
        What was solved; of "auto", which of the two it is. On boundaries of few vertices its objective may be
        "relative": the shear of the faces, least of all boundary angles.
    status : str
        Why that stopped: "direct" (nothing to iterate), "converged", "stalled" (no step lowers the energy any more in
        doubles), "max-iterations"; of "auto" that kept the linear map, "angles" (Newton's method made them worse) or
        "no-gain" (it promised too little to be begun).
    laplacian : str
        "cotan" or "intrinsic-delaunay".
    center : int or None
        The vertex at 0, where there is one.
    pins : tuple of int or None
        The boundary vertices at 1, w, w^2, w = exp(2 pi i / 3), where they were asked for.
    backend : str
        Library of the factorization; always "superlu" for the augmented Lagrangian, whose systems are indefinite.
    """

    uv: NDArray[np.float64]
    boundary: NDArray[np.int64]
    dirichlet_energy: float
    conformal_energy: float
    flipped: NDArray[np.int64]
    lost_to_double: NDArray[np.int64]
    converged: bool
    history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...]
    repair: Repair | None
    method: str
    status: str
    objective: str
    laplacian: str
    center: int | None
    pins: tuple[int, int, int] | None
    backend: str
    surface: Surface = field(repr=False)

    @cached_property
    def distortion(self) -> Distortion:
        """Angle error, quasi-conformal ratio and area scale of every face (area in units of V squared)."""
        return distortion_of(self.surface.geometry, self.surface.corners, self.uv, self.surface.unit)

    @cached_property
    def lost_to_float32(self) -> NDArray[np.int64]:
        """Faces with no positive area left once the disk is put into the unit square in single precision.

        That is what image textures and modelling programs keep: u, v = 0.5 + 0.5 (x, y) as float32.
        """
        stored = (0.5 + 0.5 * self.uv).astype(np.float32).astype(np.float64)
        return np.flatnonzero(orientation_signs(stored, self.surface.corners) <= 0)

    @property
    def gradient_norm(self) -> float | None:
        """Norm of the projected gradient at the end of Newton's method; None for the other methods."""
        last = self.history[-1] if self.history else None
        return last.gradient_norm if isinstance(last, NewtonStep) else None


def disk_map_result(
    surface: Surface,
    solution: Solution,
    options: DiskOptions,
    z: Complex,
    flipped: NDArray[np.int64],
    repair: Repair | None,
    center: int | None,
) -> DiskMap:
    """Measure positions z (n,).

    `flipped` are the faces folded there.
    """
    uv = z.copy().view(np.float64).reshape(-1, 2)
    area = enclosed_area(z[surface.loops[0]])
    if len(surface.degenerate) and solution.problem is not None:
        dirichlet = solution.problem.laplacian.energy(z)
        conformal = dirichlet - area
    else:
        conformal = conformal_energy(surface.geometry, z, surface.corners)
        dirichlet = conformal + area
    return DiskMap(
        uv=uv,
        boundary=surface.loops[0],
        dirichlet_energy=dirichlet,
        conformal_energy=conformal,
        flipped=flipped,
        lost_to_double=unresolved_faces(z, surface.corners, flipped),
        converged=solution.converged,
        history=solution.history,
        repair=repair,
        method=solution.method,
        status=solution.status,
        objective="relative" if solution.relative else str(options.objective),
        laplacian="cotan" if solution.problem is None else solution.problem.laplacian.kind,
        center=center,
        pins=options.pins,
        backend="superlu" if solution.problem is None else solution.problem.backend,
        surface=surface,
    )

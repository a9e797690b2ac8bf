"""The result of a map with a free boundary."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..concise import Concise
from ..disk.repair import Repair
from ..errors import NonFiniteError
from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..operators.distortion import Distortion, distortion_of
from ..operators.orientation_sign import flipped_faces
from ..operators.plane_map import PlaneMap
from ..operators.polygon_crossings import polygon_crossings
from ..shown import Shown

__all__ = ["FreeMap", "free_map_result"]


@dataclass(frozen=True, eq=False, repr=False)
class FreeMap(PlaneMap, Shown, Concise):
    """A map of a surface to the plane whose boundary takes its own shape.

    Attributes
    ----------
    uv : (n, 2) float64
        Position of every vertex, in the units of V. The first boundary vertex is at 0, the first boundary edge along
        the first axis, unless a repair or a refinement moved them.
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.
    flipped : (k,) int64
        Faces with non-positive signed area in uv, decided exactly.
    crossings : (c, 2) int64
        Pairs of boundary edges that cross each other: the map then covers some of the plane twice. Edge k goes from
        ``boundary[k]`` to the next. Edges that only touch do not count.
    repair : Repair or None
        What restoring folded faces cost; None where nothing was done.
    status : str
        "direct" (nothing to iterate); after a refinement why that stopped: "converged", "stalled" (no step lowers the
        energy any more in doubles), "max-iterations", or "angles" (it made the angles worse, and was left out).
    laplacian : str
        "cotan" or "intrinsic-delaunay".
    backend : str
        Library of the factorization.
    """

    uv: NDArray[np.float64]
    boundary: NDArray[np.int64]
    flipped: NDArray[np.int64]
    crossings: NDArray[np.int64]
    repair: Repair | None
    status: str
    laplacian: str
    backend: str
    surface: Surface = field(repr=False)

    @cached_property
    def distortion(self) -> Distortion:
        """Angle error, quasi-conformal ratio and area scale of every face."""
        return distortion_of(self.surface.geometry, self.surface.corners, self.uv / self.surface.unit)


def free_map_result(
    surface: Surface, problem: DirichletProblem, z: NDArray[np.complex128], repair: Repair | None, status: str
) -> FreeMap:
    """Measure positions z (n,) in the scaled units.

    Raises
    ------
    NonFiniteError
        The map is too large for doubles.
    """
    with np.errstate(over="ignore", under="ignore"):
        uv = z.view(np.float64).reshape(-1, 2) * surface.unit
    if not np.isfinite(uv).all():
        raise NonFiniteError("The flat surface is too large for doubles; scale the mesh down.")
    return FreeMap(
        uv=uv,
        boundary=surface.loops[0],
        flipped=flipped_faces(z, surface.corners),
        crossings=polygon_crossings(z[surface.loops[0]]),
        repair=repair,
        status=status,
        laplacian=problem.laplacian.kind,
        backend=problem.backend,
        surface=surface,
    )

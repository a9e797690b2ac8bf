"""The maps of many disks to unit disks; that of one is made when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..disk import DiskMap
from ..optimize import NewtonStep, Status
from ..options import DiskOptions, Laplacian, Method
from .disks import Disks
from .energies import energies
from .single import surface_of

__all__ = ["DiskMaps", "Candidate"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]


class Candidate(NamedTuple):
    """Solutions of c disks by one method.

    Attributes
    ----------
    z : (n,) complex128
        Positions of all vertices, placed but not turned.
    valid : (c,) bool
        The disks that have one.
    method, status
        As in `DiskMap`.
    history : callable
        The iterates of one of the disks.
    relative : bool
        Whether the shear was minimised.
    """

    z: Complex
    valid: Bools
    method: Method
    status: Status
    history: Callable[[int], tuple[NewtonStep, ...]]
    relative: bool = False


class DiskMaps:
    """Maps of c disks to unit disks.

    Attributes
    ----------
    disks : Disks
    z : (n,) complex128
        Positions of all vertices.
    good : (c,) bool
        The disks that were mapped; what is told of the others means nothing.
    conformal, dirichlet : (c,) float64
        Energies.
    """

    to_disks = True

    def __init__(
        self,
        disks: Disks,
        z: Complex,
        good: Bools,
        candidates: Sequence[Candidate],
        choice: Ints,
        options: DiskOptions,
        backend: str,
        intrinsic: Bools,
    ) -> None:
        self.disks, self.z, self.good = disks, z, good
        self._candidates, self._choice, self._options = candidates, choice, options
        self._backend, self._intrinsic = backend, intrinsic
        self.conformal, self.dirichlet = energies(disks, z)

    def __getitem__(self, disk: int) -> DiskMap:
        """The map of one of them."""
        disks, chosen = self.disks, self._candidates[self._choice[disk]]
        surface = surface_of(disks, disk)
        none = np.empty(0, dtype=np.int64)
        own = self.z[disks.first_vertex[disk] : disks.first_vertex[disk + 1]]
        return DiskMap(
            uv=own.copy().view(np.float64).reshape(-1, 2),
            boundary=surface.loops[0],
            dirichlet_energy=float(self.dirichlet[disk]),
            conformal_energy=float(self.conformal[disk]),
            flipped=none,
            lost_to_double=none,
            converged=True,
            history=chosen.history(disk),
            repair=None,
            method=chosen.method,
            status=chosen.status,
            objective="relative" if chosen.relative else str(self._options.objective),
            laplacian=Laplacian.INTRINSIC_DELAUNAY if self._intrinsic[disk] else Laplacian.COTAN,
            center=None,
            pins=None,
            backend=self._backend,
            surface=surface,
        )

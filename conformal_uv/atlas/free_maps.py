"""The maps of many disks with free boundaries; that of one is made when it is asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..free import FreeMap
from ..mesh.arrays import squared_units
from ..optimize import Status
from ..options import Laplacian
from .energies import energies
from .factorized_disks import FactorizedDisks
from .single import surface_of

__all__ = ["FreeMaps"]

Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]


class FreeMaps:
    """Maps of c disks to the plane.

    Attributes
    ----------
    disks : Disks
    z : (n,) complex128
        Positions of all vertices where they were put.
    good : (c,) bool
        The disks that were mapped; what is told of the others means nothing.
    conformal, dirichlet : (c,) float64
        Energies, in the units of V squared.
    """

    to_disks = False

    def __init__(self, factorized: FactorizedDisks, flat: Complex, z: Complex, good: Bools) -> None:
        self._factorized, self._flat = factorized, flat
        self.disks, self.z, self.good = factorized.disks, z, good
        conformal, dirichlet = energies(self.disks, flat)
        self.conformal = squared_units(conformal, self.disks.unit)
        self.dirichlet = squared_units(dirichlet, self.disks.unit)

    def __getitem__(self, disk: int) -> FreeMap:
        """The map of one of them."""
        disks, surface = self.disks, surface_of(self.disks, disk)
        own = self._flat[disks.first_vertex[disk] : disks.first_vertex[disk + 1]]
        intrinsic = self._factorized.blocks.intrinsic[disk]
        return FreeMap(
            uv=own.copy().view(np.float64).reshape(-1, 2) * surface.unit,
            boundary=surface.loops[0],
            flipped=np.empty(0, dtype=np.int64),
            crossings=np.empty((0, 2), dtype=np.int64),
            repair=None,
            status=Status.DIRECT,
            laplacian=Laplacian.INTRINSIC_DELAUNAY if intrinsic else Laplacian.COTAN,
            backend=self._factorized.problem.backend,
            surface=surface,
        )

"""The maps of many disks; that of one is made when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..disk import DiskMap
from ..mesh.geometry import TriangleGeometry
from ..mesh.halfedges import HalfEdges
from ..mesh.surface import Surface
from ..operators.wirtinger import planar_sides, unfolded_sides
from ..optimize import NewtonStep, Status
from ..options import DiskOptions, Laplacian, Method
from .disks import Disks, neighbours

__all__ = ["AtlasMaps", "Candidate"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
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


class AtlasMaps:
    """Maps of c disks.

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
        self.conformal, self.dirichlet = _energies(disks, z)

    def __getitem__(self, disk: int) -> DiskMap:
        """The map of one of them."""
        disks, chosen = self.disks, self._candidates[self._choice[disk]]
        surface = _surface(disks, disk)
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


def _energies(disks: Disks, z: Complex) -> tuple[Real, Real]:
    """Conformal and Dirichlet energies (c,), as `operators.wirtinger` has them of one map."""
    p1, p2 = unfolded_sides(disks.geometry)
    q1, q2 = planar_sides(z, disks.corners)
    residual = q2 * p1 - q1 * p2
    lost = (residual.real**2 + residual.imag**2) / (4.0 * disks.geometry.double_area)
    zb = z[disks.loop]
    ahead, _ = neighbours(disks.first_boundary)
    enclosed = np.imag(np.conj(zb) * zb[ahead])
    conformal: Real = np.bincount(disks.of_face, lost, len(disks)).astype(np.float64, copy=False)
    area: Real = 0.5 * np.bincount(disks.of_boundary, enclosed, len(disks))
    return conformal, conformal + area


def _surface(disks: Disks, disk: int) -> Surface:
    """One of the disks by itself."""
    v, f = disks.first_vertex[disk : disk + 2], disks.first_face[disk : disk + 2]
    m, first = disks.corners.shape[1], int(v[0])
    corners = disks.corners[:, f[0] : f[1]] - np.int32(first)
    e = slice(*np.searchsorted(disks.edges.lo, v).tolist())
    edge = disks.edges.edge.reshape(3, m)[:, f[0] : f[1]].reshape(-1) - np.int32(e.start)
    twin = disks.edges.twin.reshape(3, m)[:, f[0] : f[1]].reshape(-1)
    own = twin // m * (f[1] - f[0]) + twin % m - f[0]
    edges = HalfEdges(
        disks.edges.lo[e] - np.int32(first),
        disks.edges.hi[e] - np.int32(first),
        edge,
        disks.edges.count[e].copy(),
        np.where(twin < 0, twin, own).astype(np.int32),
    )
    part = slice(*f.tolist())
    geometry = TriangleGeometry(disks.geometry.dot[:, part].copy(), disks.geometry.double_area[part].copy())
    loop = disks.loop[disks.first_boundary[disk] : disks.first_boundary[disk + 1]] - first
    return Surface(disks.V[slice(*v.tolist())].copy(), corners, edges, geometry, [loop], 1, float(disks.unit[disk]))

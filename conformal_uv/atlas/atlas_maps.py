"""The maps of many disks; that of one is made when it is asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..disk import DiskMap
from ..mesh.geometry import TriangleGeometry
from ..mesh.halfedges import HalfEdges
from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..operators.wirtinger import planar_sides, unfolded_sides
from ..optimize import NewtonStep, Status
from ..options import DiskOptions, Laplacian, Method
from .disks import Disks, neighbours
from .solutions import NewtonSolver

__all__ = ["AtlasMaps"]

Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]


class AtlasMaps:
    """Maps of c disks.

    Attributes
    ----------
    disks : Disks
    z : (n,) complex128
        Positions of all vertices.
    good : (c,) bool
        The disks that were mapped; what is told of the others means nothing.
    by_newton : (c,) bool
        Whose maps Newton's method has made, not the linear one.
    conformal, dirichlet : (c,) float64
        Energies.
    """

    def __init__(
        self,
        disks: Disks,
        z: Complex,
        good: Bools,
        by_newton: Bools,
        newton: NewtonSolver | None,
        options: DiskOptions,
        problem: DirichletProblem,
        intrinsic: Bools,
    ) -> None:
        self.disks, self.z, self.good, self.by_newton = disks, z, good, by_newton
        self._newton, self._options, self._intrinsic, self._backend = newton, options, intrinsic, problem.backend
        self.conformal, self.dirichlet = _energies(disks, z)

    def __getitem__(self, disk: int) -> DiskMap:
        """The map of one of them."""
        disks, options = self.disks, self._options
        by_newton = bool(self.by_newton[disk])
        surface = _surface(disks, disk)
        history: tuple[NewtonStep, ...] = ()
        status = Status.ANGLES if options.method is Method.AUTO else Status.DIRECT
        if by_newton and self._newton is not None:
            history, status = self._newton.history(disk), Status.CONVERGED
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
            history=history,
            repair=None,
            method=Method.NEWTON if by_newton else Method.LINEAR,
            status=status,
            objective=str(options.objective),
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

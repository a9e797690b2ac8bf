"""The conformal map of one surface that is spread over MPI processes onto the unit disk."""

from __future__ import annotations

import logging
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..disk.anchors import anchored
from ..disk.boundary_energy import BoundaryEnergy
from ..disk.centre_cell import released_within
from ..disk.gauge import CentreGauge
from ..disk.harmonic_measure import CentredMeasure
from ..disk.newton import minimise_boundary_energy
from ..errors import OptionError
from ..optimize import NewtonStep, Status
from ..options import Balance, DiskOptions, DistributedSolver, Laplacian, Method, Objective, PinMode, Repair, Upright
from ..progress import Callback
from .checks import required_disk
from .dirichlet import DistributedDirichlet
from .krylov import require_petsc
from .measure import distributed_measure
from .numbers import MapNumbers, map_numbers
from .part import distributed_part
from .placement import Placement
from .ranks import Ranks, SharedProgress
from .slices import checked_slice

__all__ = ["DistributedDiskMap", "distributed_disk_map"]

Complex = NDArray[np.complex128]
log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class DistributedDiskMap:
    """A rank's part of a map to the unit disk, and what is known of the whole; all but `uv` and `first` is the same on
    every rank.

    Attributes
    ----------
    uv : (k, 2) float64
        Positions of the vertices whose rows of V this rank passed, ``|uv| <= 1``.
    first : int
        The first of these vertices.
    vertices, faces : int
        Of the whole surface.
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.
    numbers : MapNumbers
        Energies, angle errors.
    flipped : (k,) int64
        Faces with non-positive signed area in uv, decided exactly. There is no repair.
    negative_edges : int
        Interior edges with a negative cotangent weight; where there are none, nothing folds but for rounding.
    converged : bool
    history : tuple of NewtonStep
    method, status, objective : str
    center : int or None
    pins : tuple of int or None
    solver : str
        "gamg", "hypre" or "mumps".
    steps : tuple of int
        Of the conjugate gradients, for each linear system solved.
    sent : tuple of (int, int)
        Messages and bytes that each rank sent to others in exchanges of the mesh; PETSc's own are told by its option
        ``-log_view``.
    """

    uv: NDArray[np.float64]
    first: int
    vertices: int
    faces: int
    boundary: NDArray[np.int64]
    numbers: MapNumbers
    flipped: NDArray[np.int64]
    negative_edges: int
    converged: bool
    history: tuple[NewtonStep, ...]
    method: str
    status: str
    objective: str
    center: int | None
    pins: tuple[int, int, int] | None
    solver: str
    steps: tuple[int, ...]
    sent: tuple[tuple[int, int], ...]
    ranks: Ranks = field(repr=False)


def distributed_disk_map(
    V: ArrayLike,
    F: ArrayLike,
    *,
    comm: Any = None,
    method: str = "auto",
    objective: str | None = None,
    pins: tuple[int, int, int] | None = None,
    center: int | None = None,
    boundary_vertex: int | None = None,
    upright: str = "none",
    tolerance: float = 1e-10,
    relative_tolerance: float = 0.0,
    max_iterations: int = 50,
    laplacian: str = "auto",
    solver: str = "auto",
    callback: Callback | None = None,
    **others: Any,
) -> DistributedDiskMap:
    """Map one surface conformally onto the unit disk, its rows of V and F spread over the processes of an MPI job.

    Every process calls it, each with its own rows and otherwise the same arguments; no process holds arrays of the
    whole surface's size, only of its boundary's. Errors are those of `disk_map` and are raised on all processes
    together, indices being those of the whole surface.

    Parameters
    ----------
    V : (k, 3) floats
        Consecutive vertices, those of the first process first.
    F : (l, 3) integers
        Consecutive triangles, of vertices of any process.
    comm : mpi4py.MPI.Intracomm, optional
        By default MPI.COMM_WORLD.
    method : {"auto", "linear", "newton"}
        As in `disk_map`; "auto" is "linear".
    objective, pins, center, boundary_vertex, tolerance, relative_tolerance, max_iterations
        As in `disk_map`; pins are reached by a Moebius map.
    upright : {"none", "z", "y"}
        The surface's axis that is to point up in the map.
    laplacian : {"auto", "cotan"}
        The triangles' own cotangents. Where some are negative the map may fold: `DistributedDiskMap.flipped`.
    solver : {"auto", "gamg", "hypre", "mumps"}
        Conjugate gradients with PETSc's multigrid or with hypre's BoomerAMG, or MUMPS's factorization; "auto" is
        "hypre" where PETSc was built with it, else "gamg".
    callback : callable, optional
        Called on every process that passes one; all stop when one returns False.

    Returns
    -------
    DistributedDiskMap

    Raises
    ------
    MissingDependencyError
        petsc4py or mpi4py is not installed.
    MeshError, OptionError, SolverError, CancelledError
        As `disk_map` does, on all processes.
    """
    require_petsc()
    ranks = Ranks(comm)
    with ranks.agreed():
        options = _checked(
            DiskOptions(
                method=method,  # type: ignore[arg-type]
                objective=objective,  # type: ignore[arg-type]
                pins=pins,
                center=center,
                boundary_vertex=boundary_vertex,
                tolerance=tolerance,
                relative_tolerance=relative_tolerance,
                max_iterations=max_iterations,
                **others,
            ),
            laplacian,
        )
        chosen, up = DistributedSolver.of("solver", solver), Upright.of("upright", upright)
    progress = SharedProgress(ranks, callback)
    progress("checks", 0.0)
    part = distributed_part(ranks, checked_slice(ranks, V, F))
    boundary = required_disk(part)
    options = anchored(options, part.vertices.count, boundary.loop)
    progress("assembly", 0.0)
    problem = DistributedDirichlet(part, boundary, chosen)
    progress("linear", 0.0)
    measure = distributed_measure(problem, boundary)
    energy, history, status = _solved(problem, measure, options, progress)
    progress("placement", 0.0)
    placement = Placement(problem, energy.z, energy.interior)
    placement.placed(options)
    placement.turned(up)
    progress("distortion", 0.0)
    flipped = placement.flipped()
    if len(flipped) and ranks.rank == 0:
        log.warning("%d faces are folded: %d edges have negative weights", len(flipped), problem.negative)
    own = placement.z[: part.own]
    return DistributedDiskMap(
        uv=own.copy().view(np.float64).reshape(-1, 2),
        first=part.vertices.first,
        vertices=part.vertices.count,
        faces=part.faces.count,
        boundary=boundary.loop,
        numbers=map_numbers(part, placement.z, placement.zb),
        flipped=flipped,
        negative_edges=problem.negative,
        converged=status in (Status.DIRECT, Status.CONVERGED),
        history=history,
        method=str(options.method),
        status=str(status),
        objective=str(options.objective),
        center=options.center,
        pins=options.pins,
        solver=str(problem.solver),
        steps=tuple(problem.steps),
        sent=tuple(ranks.each((ranks.messages, ranks.bytes))),
        ranks=ranks,
    )


def _checked(options: DiskOptions, laplacian: str) -> DiskOptions:
    """The options, where this way can do what they ask for; "auto" decided."""
    if Laplacian.of("laplacian", laplacian) is Laplacian.INTRINSIC_DELAUNAY:
        raise OptionError('The backend "petsc" has the triangles\' own cotangents only; leave out laplacian.')
    if options.method is Method.AUGMENTED_LAGRANGIAN:
        raise OptionError('The backend "petsc" maps by "linear" or "newton".')
    if options.pin_mode is PinMode.CONSTRAINT:
        raise OptionError('The backend "petsc" reaches pins by a Moebius map; leave out pin_mode.')
    if options.balance is Balance.AREA:
        raise OptionError('The backend "petsc" has no balance="area"; pass a center.')
    if options.repair is Repair.ALWAYS:
        raise OptionError('The backend "petsc" tells folded faces and does not unfold them; leave out repair.')
    return replace(options, method=Method.LINEAR) if options.method is Method.AUTO else options


def _solved(
    problem: DistributedDirichlet, measure: CentredMeasure, options: DiskOptions, progress: SharedProgress
) -> tuple[BoundaryEnergy, tuple[NewtonStep, ...], Status]:
    """See `disk.solution`."""
    gauge = CentreGauge(measure.vertex_measure, measure.theta)
    if options.method is Method.LINEAR:
        energy = BoundaryEnergy(problem, gauge.restore(measure.theta), minus_area=True)  # type: ignore[arg-type]
        return energy, (), Status.DIRECT
    found = minimise_boundary_energy(
        problem,  # type: ignore[arg-type]
        measure.theta,
        gauge,
        minus_area=options.objective is Objective.CONFORMAL,
        tolerance=options.tolerance,
        relative_tolerance=options.relative_tolerance,
        max_iterations=options.max_iterations,
        progress=progress,
    )
    if options.objective is Objective.CONFORMAL and found.converged and measure.centre is not None:
        found = released_within(
            lambda energy: _star_radius(problem, int(measure.centre or 0), energy),
            problem,  # type: ignore[arg-type]
            measure,
            found,
            options,
            progress,
        )
    return found.energy, found.history, found.status


def _star_radius(problem: DistributedDirichlet, centre: int, energy: BoundaryEnergy) -> float:
    """See `disk.centre_cell`; the owner of the centre knows its neighbours."""
    part = problem.part
    z, reach = problem.extended(energy.z, energy.interior), 0.0
    if part.vertices.first <= centre < part.vertices.last:
        local = centre - part.vertices.first
        lo, hi = part.edges.lo, part.edges.hi
        around = np.concatenate((hi[lo == local], lo[hi == local]))
        reach = float(np.abs(z[around] - z[local]).max())
    return part.ranks.most(reach)

"""Many small disks checked and factorized together, to be mapped again and again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..disk.auto import GOOD
from ..disk.placement import inside_disk
from ..disk.relative_energy import FEW
from ..operators.dirichlet import DirichletProblem
from ..optimize.choice import ALIKE
from ..options import Balance, DiskOptions, Laplacian, Method, Objective
from ..progress import Progress
from .atlas_maps import AtlasMaps
from .block_laplacian import block_laplacian
from .disks import Disks
from .finish import angle_means, placed, plain_maps
from .measures import Measures, measures
from .solutions import NewtonSolver, linear_positions

__all__ = ["DiskAtlas", "Turns", "takes"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]
Turns = Callable[[Complex], Complex]


def takes(options: DiskOptions) -> bool:
    """Whether disks are mapped together with these options; others want to see each disk."""
    return (
        options.method is not Method.AUGMENTED_LAGRANGIAN
        and options.objective is Objective.CONFORMAL
        and options.balance is Balance.MIDDLE
        and options.center is None
        and options.boundary_vertex is None
        and not options.needs_pins
    )


class DiskAtlas:
    """Disks whose Laplacians are the blocks of one matrix, factorized once.

    Results are those of `DiskMapper`, disk by disk, to rounding. Disks of which that can not be said beyond doubt (an
    angle or an area next to nothing, a folded face, a step that has to be thought about) are left out of the results:
    `DiskMapper` knows what to do with them.

    Parameters
    ----------
    disks : Disks
    laplacian : Laplacian
    backend : str
    progress : Progress

    Raises
    ------
    SolverError
        A block is singular to working precision.
    """

    def __init__(self, disks: Disks, laplacian: Laplacian, backend: str, progress: Progress) -> None:
        progress("assembly", 0.0)
        self.disks = disks
        self._blocks = block_laplacian(
            disks.corners, disks.edges, disks.geometry, disks.of_vertex, len(disks), laplacian
        )
        self._problem = DirichletProblem(
            self._blocks.laplacian, disks.loop, disks.n, backend=backend, progress=progress
        )
        progress("linear", 0.0)
        self._measures: Measures = measures(disks, self._problem, backend)
        self._newton: tuple[tuple[object, ...], NewtonSolver] | None = None

    def maps(self, options: DiskOptions, turns: Turns | None, progress: Progress) -> AtlasMaps:
        """The maps with such options as `takes` says, every disk turned by what `turns` says of the positions (n,)."""
        progress("linear", 0.0)
        disks, seen = self.disks, self._measures
        good = seen.found.copy()
        linear = linear_positions(disks, self._problem, seen) if options.method is not Method.NEWTON else None
        newton = None
        if options.method is not Method.LINEAR:
            progress("newton", 0.0)
            newton = self._newton_solutions(options)
            good &= newton.converged
            if options.method is Method.AUTO:
                good &= ~self._want_all_angles(newton.z)
        progress("placement", 0.0)
        z, by_newton = self._better(linear, None if newton is None else newton.z, turns, good)
        return AtlasMaps(disks, z, good, by_newton, newton, options, self._problem, self._blocks.intrinsic)

    def _newton_solutions(self, options: DiskOptions) -> NewtonSolver:
        key = options.tolerance, options.relative_tolerance, options.max_iterations
        if self._newton is None or self._newton[0] != key:
            self._newton = key, NewtonSolver(self.disks, self._problem, self._measures, options)
        return self._newton[1]

    def _want_all_angles(self, z: Complex) -> Bools:
        """Disks (c,) whose few boundary vertices decide on many faces, and could do better; see `disk.auto`."""
        disks = self.disks
        count, faces = np.diff(disks.first_boundary), np.diff(disks.first_face)
        few = (count <= FEW) & (faces >= 2 * count)
        return few & (angle_means(disks, z) >= GOOD) if few.any() else few

    def _better(
        self, linear: Complex | None, newton: Complex | None, turns: Turns | None, good: Bools
    ) -> tuple[Complex, Bools]:
        """Positions of the better solutions, and which disks have Newton's; what is not plain is struck from `good`."""
        disks = self.disks
        candidates = [placed(disks, z) for z in (linear, newton) if z is not None]
        for z in candidates:
            good &= plain_maps(disks, z)
        by_newton = np.full(len(disks), newton is not None)
        if len(candidates) == 2:
            before, after = (angle_means(disks, z) for z in candidates)
            by_newton = before > after + ALIKE
        z = np.where(by_newton[disks.of_vertex], candidates[-1], candidates[0])
        if turns is not None:
            z = inside_disk(z * turns(z)[disks.of_vertex])
            good &= plain_maps(disks, z)
        return z, by_newton

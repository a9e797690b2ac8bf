"""Many small disks factorized together, mapped to unit disks again and again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..disk.auto import GOOD
from ..disk.placement import inside_disk
from ..disk.relative_energy import FEW
from ..optimize import NewtonStep, Status
from ..optimize.choice import ALIKE
from ..options import Balance, DiskOptions, Method, Objective
from ..progress import Progress
from .disk_maps import Candidate, DiskMaps
from .factorized_disks import FactorizedDisks
from .finish import angle_means, placed, plain_maps
from .measures import Measures, measures
from .shear import ShearAngles, least_shears
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
    """Maps of many disks to unit disks.

    Results are those of `DiskMapper`, disk by disk, to rounding. Disks of which that can not be said beyond doubt (an
    angle or an area next to nothing, a folded face, a step that has to be thought about) are left out of the results:
    `DiskMapper` knows what to do with them.

    Parameters
    ----------
    factorized : FactorizedDisks
    progress : Progress

    Raises
    ------
    SolverError
        A copy with split chords is singular to working precision.
    """

    def __init__(self, factorized: FactorizedDisks, progress: Progress) -> None:
        self.disks, self._blocks, self._problem = factorized.disks, factorized.blocks, factorized.problem
        progress("linear", 0.0)
        self._measures: Measures = measures(self.disks, self._problem, factorized.backend)
        self._newton: tuple[tuple[object, ...], tuple[NewtonSolver, list[ShearAngles]]] | None = None

    def maps(self, options: DiskOptions, turns: Turns | None, progress: Progress) -> DiskMaps:
        """The maps with such options as `takes` says, every disk turned by what `turns` says of the positions (n,)."""
        disks, seen = self.disks, self._measures
        every = np.ones(len(disks), dtype=bool)
        good, candidates = seen.found.copy(), list[Candidate]()
        auto = options.method is Method.AUTO
        if options.method is not Method.NEWTON:
            progress("linear", 0.0)
            z = placed(disks, linear_positions(disks, self._problem, seen))
            candidates.append(Candidate(z, every, Method.LINEAR, Status.ANGLES if auto else Status.DIRECT, _untold))
        if options.method is not Method.LINEAR:
            progress("newton", 0.0)
            newton, shears = self._newton_solutions(options)
            good &= newton.converged
            z = placed(disks, newton.z)
            candidates.append(Candidate(z, every, Method.NEWTON, Status.CONVERGED, newton.history))
            for shear in shears if auto else ():
                if shear.found.any():
                    z = placed(disks, self._problem.extend(np.exp(1j * shear.theta)))
                    candidates.append(Candidate(z, shear.found, Method.NEWTON, Status.CONVERGED, shear.history, True))
        progress("placement", 0.0)
        choice = self._best(candidates, good)
        z = candidates[0].z.copy()
        for number, candidate in enumerate(candidates[1:], 1):
            own = (choice == number)[disks.of_vertex]
            z[own] = candidate.z[own]
        if turns is not None:
            z = inside_disk(z * turns(z)[disks.of_vertex])
            good &= plain_maps(disks, z)
        return DiskMaps(disks, z, good, candidates, choice, options, self._problem.backend, self._blocks.intrinsic)

    def _newton_solutions(self, options: DiskOptions) -> tuple[NewtonSolver, list[ShearAngles]]:
        key = options.tolerance, options.relative_tolerance, options.max_iterations, options.method
        if self._newton is None or self._newton[0] != key:
            newton = NewtonSolver(self.disks, self._problem, self._measures, options)
            shears: list[ShearAngles] = []
            if options.method is Method.AUTO:
                few = np.flatnonzero(self._want_all_angles(newton.z) & newton.converged)
                shears = least_shears(self.disks, self._problem, newton.S, self._blocks.intrinsic, newton.theta, few)
            self._newton = key, (newton, shears)
        return self._newton[1]

    def _want_all_angles(self, z: Complex) -> Bools:
        """Disks (c,) whose few boundary vertices decide on many faces, and could do better; see `disk.auto`."""
        disks = self.disks
        count, faces = np.diff(disks.first_boundary), np.diff(disks.first_face)
        few = (count <= FEW) & (faces >= 2 * count)
        return few & (angle_means(disks, z) >= GOOD) if few.any() else few

    def _best(self, candidates: list[Candidate], good: Bools) -> Ints:
        """The place (c,) of each disk's best map among the candidates; what is not plain is struck from `good`.

        As `optimize.choice.best_map` of maps without folds.
        """
        disks = self.disks
        for candidate in candidates:
            good &= plain_maps(disks, candidate.z)
        if len(candidates) == 1:
            return np.zeros(len(disks), dtype=np.int64)
        means = np.stack([np.where(one.valid, angle_means(disks, one.z), np.inf) for one in candidates])
        return np.argmax(means <= means.min(axis=0) + ALIKE, axis=0)


def _untold(disk: int) -> tuple[NewtonStep, ...]:
    """The linear method does not iterate."""
    return ()

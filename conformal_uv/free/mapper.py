"""From a factorized surface and options to a map with a free boundary."""

from __future__ import annotations

import numpy as np

from ..errors import OptionError
from ..operators.factorized_disk import FactorizedDisk
from ..optimize import Status
from ..options import FreeOptions
from ..progress import Progress
from .refine import refined
from .repair import unfolded
from .result import FreeMap, free_map_result
from .solution import solve_free

__all__ = ["mapped_free"]


def mapped_free(factorized: FactorizedDisk, options: FreeOptions, progress: Progress) -> FreeMap:
    """The map of a surface that may be factorized already, and is from now on.

    Raises
    ------
    OptionError
        Options that do not fit this surface.
    """
    surface, loop = factorized.surface, factorized.boundary
    for name in ("boundary_scale", "boundary_angles"):
        given = getattr(options, name)
        if given is not None and len(given) != len(loop):
            raise OptionError(
                f"{name} has {len(given)} values; the boundary has {len(loop)} vertices. Pass one for each, in the "
                "order of the boundary loop."
            )
    problem = factorized.problem(progress)
    z = solve_free(surface, problem, options, progress)
    inside, held = np.ones(surface.n, dtype=bool), options.boundary_angles is not None
    inside[loop] = False
    z, cost = unfolded(surface, inside, z, held, options.repair, factorized.asked, progress)
    status = Status.DIRECT
    if options.refine:
        z, status = refined(surface, loop, z, factorized.asked, progress)
    result = free_map_result(surface, problem, z, cost, status)
    progress("extension", 1.0)
    return result

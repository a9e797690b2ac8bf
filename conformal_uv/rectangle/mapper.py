"""From a checked surface and options to a map to a rectangle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.curvature import curvatures
from ..operators.distortion import distortion_of
from ..operators.edge_laplacian import EdgeLaplacian
from ..operators.factorized_disk import FactorizedDisk
from ..operators.orientation_sign import flipped_faces
from ..optimize import Status
from ..options import CornerChoice, RectangleOptions
from ..progress import Progress
from .corners import given_corners, quarters, require_four, turning_corners
from .modulus import enclosure, modulus
from .repair import squashed_faces, unfolded
from .result import RectangleMap
from .solution import RectangleSolution, solve_rectangle

__all__ = ["mapped_rectangle"]

Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]

ROTATIONS = 8  # of quarters of the boundary's length, that are tried
LEAST_SCALE = 1e-12  # of area, whose logarithm counts


def mapped_rectangle(factorized: FactorizedDisk, options: RectangleOptions, progress: Progress) -> RectangleMap:
    """The map of a surface that is checked already, and may have its Laplacian.

    Raises
    ------
    OptionError
        Corners that are not four boundary vertices in order.
    TopologyError
        The boundary has fewer than four vertices.
    """
    surface, loop = factorized.surface, factorized.boundary
    require_four(loop)
    laplacian = factorized.laplacian(progress)
    tried = [
        solve_rectangle(surface, laplacian, loop, corners, factorized.asked, progress)
        for corners in _candidates(surface, loop, options)
    ]
    solution = (
        tried[0] if len(tried) == 1 else min(tried, key=lambda one: _area_spread(surface, _placed(laplacian, one)))
    )
    result = _measured(factorized, solution, options, progress)
    progress("extension", 1.0)
    return result


def _candidates(surface: Surface, loop: Ints, options: RectangleOptions) -> Iterator[Ints]:
    """Places of corners in the loop: those given, those that turn most, or these and quarters all around."""
    if options.corners is not None:
        yield given_corners(loop, options.corners)
        return
    lengths = np.linalg.norm(surface.V[np.roll(loop, -1)] - surface.V[loop], axis=1)
    yield turning_corners(curvatures(surface, loop)[loop], lengths)
    if options.corner_choice is CornerChoice.AREA:
        for number in range(ROTATIONS):
            corners = quarters(lengths, 0.25 * number / ROTATIONS)
            if corners is not None:
                yield corners


def _placed(laplacian: EdgeLaplacian, solution: RectangleSolution) -> Complex:
    """Positions in the rectangle; what negative weights have put beyond it, on its sides."""
    z = np.empty(len(solution.u), dtype=np.complex128)
    z.real, z.imag = np.clip(solution.u, 0.0, 1.0), np.clip(solution.v, 0.0, 1.0)
    z.real *= modulus(laplacian, solution.u, solution.v)
    return z


def _area_spread(surface: Surface, z: Complex) -> float:
    """Standard deviation of the logarithm of the area scale over the surface's area."""
    scale = distortion_of(surface.geometry, surface.corners, z.view(np.float64).reshape(-1, 2)).area_scale
    weights = np.where(np.isfinite(scale), surface.geometry.double_area, 0.0)
    logs = np.log(np.where(weights > 0.0, np.maximum(scale, LEAST_SCALE), 1.0))
    mean = weights @ logs / weights.sum()
    return float(np.sqrt(weights @ (logs - mean) ** 2 / weights.sum()))


def _measured(
    factorized: FactorizedDisk, solution: RectangleSolution, options: RectangleOptions, progress: Progress
) -> RectangleMap:
    surface, laplacian = factorized.surface, factorized.laplacian(progress)
    z, cost = unfolded(
        surface, _placed(laplacian, solution), solution.sides, options.repair, factorized.asked, progress
    )
    flipped = flipped_faces(z, surface.corners)
    return RectangleMap(
        uv=z.view(np.float64).reshape(-1, 2),
        boundary=factorized.boundary,
        corners=np.array([side[0] for side in solution.sides]),
        modulus=float(z[solution.sides[0][-1]].real),
        modulus_bounds=enclosure(surface, laplacian, solution.u, solution.v),
        flipped=flipped,
        squashed=np.intersect1d(flipped, squashed_faces(surface, solution.sides), assume_unique=True),
        repair=cost,
        status=Status.DIRECT,
        laplacian=laplacian.kind,
        backend=solution.backend,
        surface=surface,
    )

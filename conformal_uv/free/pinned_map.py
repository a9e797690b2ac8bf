"""Least squares conformal maps of a surface with some vertices at given places.

B. Levy, S. Petitjean, N. Ray, J. Maillot, "Least squares conformal maps for automatic texture atlas generation", ACM
Transactions on Graphics 21(3), 2002: of all maps with the pinned vertices at their places the one with the least
conformal energy. It is unique from two pins on. Multiplying and adding complex numbers keeps angles, so the map depends
on the places as a complex linear function: once the influence of a pin is known, moving it costs a multiplication.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DisconnectedError, OptionError, TopologyError
from ..mesh.surface import Surface
from ..operators.edge_laplacian import EdgeLaplacian, edge_laplacian
from ..operators.factorized_disk import FactorizedDisk
from ..operators.orientation_sign import flipped_faces
from ..operators.polygon_crossings import polygon_crossings
from ..optimize import Status
from ..options import Laplacian
from ..progress import Callback, Progress
from .conformal_operator import HeldConformal
from .result import FreeMap

__all__ = ["PinnedMapper", "pinned_map"]

Complex = NDArray[np.complex128]
FEWEST = 2


class PinnedMapper:
    """A surface with its pins, factorized once for all places of theirs.

    Parameters
    ----------
    V : (n, 3) floats
        Vertex positions, any units.
    F : (m, 3) integers
        Triangles, consistently wound: one connected surface with a boundary; it may have holes.
    pins : (p,) integers
        Two different vertices or more.
    laplacian : {"auto", "cotan", "intrinsic-delaunay"}
        As in `disk_map`.
    backend : {"auto", "cholmod", "superlu", "multigrid"}
        As in `disk_map`.
    callback : callable, optional
        Called as ``callback(stage, fraction)``; the work stops with CancelledError when it returns False.

    Attributes
    ----------
    pins : (p,) int64

    Raises
    ------
    MeshError
        Or the subclass that says what is wrong with the mesh.
    OptionError
        Pins that are fewer than two, repeated, or no vertices.
    SolverError
        The factorization failed.
    CancelledError
        The callback returned False.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> V, F = mask(500)
    >>> mapper = cuv.PinnedMapper(V, F, [0, 499])
    >>> mapper.map([[0, 0], [1, 0]]).uv[[0, 499]].tolist()
    [[0.0, 0.0], [1.0, 0.0]]
    """

    def __init__(
        self,
        V: ArrayLike,
        F: ArrayLike,
        pins: ArrayLike,
        *,
        laplacian: str = "auto",
        backend: str = "auto",
        callback: Callback | None = None,
    ) -> None:
        progress = Progress(callback)
        progress("checks", 0.0)
        kind = Laplacian.of("laplacian", laplacian)
        surface = Surface.from_arrays(V, F)
        if surface.pieces > 1:
            raise DisconnectedError(f"The mesh has {surface.pieces} pieces that do not touch; map each by itself.")
        if not surface.loops:
            raise TopologyError("The surface is closed and has no map to the plane; cut it open along seams.")
        surface.require_extent()
        own = _checked_pins(pins, surface.n)
        progress("assembly", 0.0)
        weighted = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, kind)
        self._take(surface, weighted, own, backend, progress)

    @classmethod
    def of(cls, factorized: FactorizedDisk, pins: ArrayLike, progress: Progress) -> PinnedMapper:
        """A mapper of a surface that was checked for other shapes, too."""
        mapper = cls.__new__(cls)
        surface = factorized.surface
        mapper._take(
            surface, factorized.laplacian(progress), _checked_pins(pins, surface.n), factorized.asked, progress
        )
        return mapper

    def _take(
        self, surface: Surface, weighted: EdgeLaplacian, pins: NDArray[np.int64], backend: str, progress: Progress
    ) -> None:
        self.surface, self.pins, self._laplacian = surface, pins, weighted.kind
        self._solved = HeldConformal(surface, weighted, pins, backend, progress)

    def influence(self, pin: int) -> Complex:
        """By how much every vertex (n,) moves, times the move of this pin, the others being where they are.

        Parameters
        ----------
        pin : int
            Its number among the pins. The influences of all pins add up to 1.
        """
        return self._solved.extended(np.eye(len(self.pins), dtype=np.complex128)[pin])

    def map(self, places: ArrayLike) -> FreeMap:
        """The map with the pins at places (p, 2).

        Raises
        ------
        OptionError
            Places that are not finite, not as many as the pins, or all the same.
        """
        at = np.asarray(places, dtype=np.float64)
        if at.shape != (len(self.pins), 2) or not np.isfinite(at).all():
            raise OptionError(f"There are {len(self.pins)} pins; pass as many finite places, ({len(self.pins)}, 2).")
        if (at == at[0]).all():
            raise OptionError("All pins have the same place: the map would be one point. Move one of them.")
        middle = at.mean(axis=0)
        z = self._solved.extended(np.ascontiguousarray(at - middle).view(np.complex128)[:, 0])
        uv = z.view(np.float64).reshape(-1, 2) + middle
        uv[self.pins] = at
        surface = self.surface
        return FreeMap(
            uv=uv,
            boundary=surface.loops[0],
            flipped=flipped_faces(np.ascontiguousarray(uv).view(np.complex128)[:, 0], surface.corners),
            crossings=polygon_crossings(z[surface.loops[0]]),
            repair=None,
            status=Status.DIRECT,
            laplacian=self._laplacian,
            backend=self._solved.backend,
            surface=surface,
        )


def pinned_map(
    V: ArrayLike,
    F: ArrayLike,
    pins: Mapping[int, ArrayLike],
    *,
    laplacian: str = "auto",
    backend: str = "auto",
    callback: Callback | None = None,
) -> FreeMap:
    """Flatten a triangle mesh with some vertices at given places, angles kept in the sense of least squares.

    Places that no conformal map reaches are reached all the same; the map then has angle errors, and may fold, which
    `FreeMap.flipped` tells.

    Parameters
    ----------
    V : (n, 3) floats
    F : (m, 3) integers
        One connected surface with a boundary; it may have holes.
    pins : mapping of int to (2,) floats
        The place of each pinned vertex, two or more.
    laplacian, backend, callback
        As in `disk_map`.

    Returns
    -------
    FreeMap
        In the units of the places.

    Raises
    ------
    MeshError, OptionError, SolverError, CancelledError
        As `PinnedMapper` and its `map`.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> square = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> cuv.pinned_map(*square, {0: [3, 3], 1: [3, 4]}).uv.round(12).tolist()
    [[3.0, 3.0], [3.0, 4.0], [2.0, 4.0], [2.0, 3.0]]
    """
    mapper = PinnedMapper(V, F, list(pins), laplacian=laplacian, backend=backend, callback=callback)
    return mapper.map(np.array([np.asarray(place, dtype=np.float64) for place in pins.values()]))


def _checked_pins(pins: ArrayLike, n: int) -> NDArray[np.int64]:
    given = np.asarray(pins)
    if given.ndim != 1 or len(given) < FEWEST or not np.issubdtype(given.dtype, np.integer):
        raise OptionError(f"Two or more pinned vertices are needed; got {given.tolist()}.")
    if given.min() < 0 or given.max() >= n:
        raise OptionError(f"The mesh has the vertices 0 to {n - 1}; the pins are {given.tolist()}.")
    if len(np.unique(given)) < len(given):
        raise OptionError(f"A vertex is pinned twice: {given.tolist()}.")
    return given.astype(np.int64)

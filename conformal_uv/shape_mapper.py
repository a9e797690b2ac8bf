"""A surface checked and factorized once, to be mapped to one shape after the other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from .disk import DiskMap, DiskMapper
from .free import FreeMap, mapped_free
from .mesh.mesh_objects import MeshObject
from .operators.factorized_disk import FactorizedDisk
from .options import FreeOptions, RectangleOptions
from .progress import Callback, Progress
from .rectangle import RectangleMap, mapped_rectangle

__all__ = ["ShapeMapper"]


class ShapeMapper:
    """A mesh checked once and factorized at its first map, to be mapped to other shapes or with other options.

    The disk and the free boundary share one factorization. Rectangles share the checks and the Laplacian; each choice
    of corners has factorizations of its own.

    Parameters
    ----------
    V, F, laplacian, backend, callback
        As in `disk_map`, with the same errors.

    Attributes
    ----------
    surface : Surface
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> mapper = cuv.ShapeMapper(*mask(500))
    >>> disk, free, rectangle = mapper.disk(method="linear"), mapper.free(), mapper.rectangle()
    >>> free.distortion.angle_mean < min(disk.distortion.angle_mean, rectangle.distortion.angle_mean)
    True
    """

    def __init__(
        self,
        V: ArrayLike | MeshObject,
        F: ArrayLike | None = None,
        *,
        laplacian: str = "auto",
        backend: str = "auto",
        callback: Callback | None = None,
    ) -> None:
        self._factorized = FactorizedDisk(V, F, laplacian=laplacian, backend=backend, callback=callback)
        self._disk = DiskMapper.of(self._factorized)
        self.surface, self.boundary = self._factorized.surface, self._factorized.boundary

    def disk(self, *, callback: Callback | None = None, **options: Any) -> DiskMap:
        """The map to the disk with the given options; see `disk_map`."""
        return self._disk.map(callback=callback, **options)

    def free(self, *, callback: Callback | None = None, **options: Any) -> FreeMap:
        """The map with a free boundary; see `free_map`."""
        return mapped_free(self._factorized, FreeOptions(**options), Progress(callback))

    def rectangle(
        self, corners: Sequence[int] | None = None, *, callback: Callback | None = None, **options: Any
    ) -> RectangleMap:
        """The map to a rectangle; see `rectangle_map`."""
        return mapped_rectangle(
            self._factorized,
            RectangleOptions(corners=corners, **options),  # type: ignore[arg-type]
            Progress(callback),
        )

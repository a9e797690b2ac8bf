"""A surface and its map on the same triangles, of whatever result: what pictures, pages and exports are made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .charts import Unwrapped
from .concise import Concise
from .disk import DiskMap
from .errors import MeshError
from .free import FreeMap
from .operators import Distortion, distortion
from .rectangle import RectangleMap
from .sphere import SphereMap

__all__ = ["AnyMap", "MappedMesh", "mapped_mesh"]

AnyMap = DiskMap | FreeMap | RectangleMap | SphereMap | Unwrapped


@dataclass(frozen=True, eq=False, repr=False)
class MappedMesh(Concise):
    """Positions on the surface and in the map, of the same vertices.

    Attributes
    ----------
    V : (n, 3) float64
        On the surface, in the caller's units.
    F : (m, 3) int64
    image : (n, 2) or (n, 3) float64
        In the map: the unit disk, the plane, the texture of several charts, or the unit sphere.
    vertices : (n,) int64
        The caller's vertex of each; one on a seam stands twice.
    distortion : Distortion
        Of the triangles F.
    shape : str
        "disk", "free", "rectangle", "sphere", or "charts" for several.
    """

    V: NDArray[np.float64]
    F: NDArray[np.int64]
    image: NDArray[np.float64]
    vertices: NDArray[np.int64]
    distortion: Distortion
    shape: str

    def at_vertices(self, of_faces: NDArray[np.float64]) -> NDArray[np.float64]:
        """The mean over the triangles around each vertex, (n,), of finite values (m,)."""
        corner = self.F.reshape(-1)
        count = np.bincount(corner, minlength=len(self.V))
        return np.bincount(corner, np.repeat(of_faces, 3), minlength=len(self.V)) / np.maximum(count, 1)


def mapped_mesh(result: AnyMap) -> MappedMesh:
    """The surface and the map of a result; filled holes and virtual caps are left out.

    Raises
    ------
    MeshError
        No chart of an unwrapped mesh was mapped.
    """
    if isinstance(result, Unwrapped):
        return _of_charts(result)
    surface = result.surface
    image = result.xyz if isinstance(result, SphereMap) else result.uv
    own = np.all(surface.corners < len(image), axis=0)
    return MappedMesh(
        V=surface.V[: len(image)] * surface.unit,
        F=surface.F[own].astype(np.int64),
        image=image,
        vertices=np.arange(len(image)),
        distortion=_of_faces(result.distortion, own),
        shape=_shape(result),
    )


def _of_charts(result: Unwrapped) -> MappedMesh:
    """All charts that were mapped, where the texture has them; one disk alone is the unit disk."""
    charts = result.charts
    if not charts.mapped.any():
        raise MeshError(f"No chart was mapped: {result.summary}")
    own = charts.mapped[charts.chart_of_triangle]
    meshes = charts.meshes
    used, F = np.unique(meshes.F_of_all[own], return_inverse=True)
    F = F.reshape(-1, 3)
    image = np.empty((len(used), 2))
    image[F] = result.uv[charts.corner[own]]
    shape = "charts"
    if charts.mapped.sum() == 1:
        chart = charts[int(np.flatnonzero(charts.mapped)[0])]
        assert chart.map is not None
        shape = _shape(chart.map)
        if isinstance(chart.map, DiskMap):
            image = (image - chart.placement.center) / chart.placement.scale
    V = meshes.V[used]
    return MappedMesh(V, F, image, meshes.vertex_of_site[meshes.site[used]], distortion(V, F, image), shape)


def _shape(result: DiskMap | FreeMap | RectangleMap | SphereMap) -> str:
    named = {DiskMap: "disk", FreeMap: "free", RectangleMap: "rectangle", SphereMap: "sphere"}
    return named[type(result)]


def _of_faces(measured: Distortion, own: NDArray[np.bool_]) -> Distortion:
    if own.all():
        return measured
    number = np.cumsum(own) - 1
    return Distortion(
        measured.angle_error[own],
        measured.quasi_conformal[own],
        measured.area_scale[own],
        number[measured.flipped[own[measured.flipped]]],
    )

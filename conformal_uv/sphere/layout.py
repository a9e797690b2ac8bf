"""The sphere laid out in the unit square: texture coordinates for every polygon corner, torn where they must be."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.polygons import PolygonMesh

__all__ = ["equirectangular", "octahedral", "on_sphere"]

Real = NDArray[np.float64]


def equirectangular(xyz: Real, mesh: PolygonMesh) -> Real:
    """Longitude and latitude, (k, 2): u in turns from -x eastwards, v from the south pole.

    A polygon across the seam lies wholly on its east side, with u beyond 1, where a repeating texture goes on; a
    corner at a pole takes the mean longitude of its polygon's others. A polygon with a pole in its inside has all
    longitudes and no good place; `octahedral` has none such.
    """
    x, y, z = xyz.T
    pole = (np.hypot(x, y) < 1e-12)[mesh.corners]
    u = (0.5 + np.arctan2(y, x) / (2.0 * np.pi))[mesh.corners]
    v = (0.5 + np.arcsin(np.clip(z, -1.0, 1.0)) / np.pi)[mesh.corners]
    first, poles = mesh.starts[:-1], bool(pole.any())
    least = np.minimum.reduceat(np.where(pole, np.inf, u) if poles else u, first)
    most = np.maximum.reduceat(np.where(pole, -np.inf, u) if poles else u, first)
    across = np.repeat(most - least > 0.5, mesh.sizes)
    u[across & (u < 0.5)] += 1.0
    if poles:
        count = np.add.reduceat(~pole, first, dtype=np.int64)
        mean = np.add.reduceat(np.where(pole, 0.0, u), first) / np.maximum(count, 1)
        u[pole] = np.repeat(mean, mesh.sizes)[pole]
    return np.column_stack((u, v))


def octahedral(xyz: Real, mesh: PolygonMesh) -> Real:
    """The octahedron unfolded to a square, (k, 2): the northern half in the middle, the southern in the corners.

    Each polygon lies in the plane of the octahedron's face that holds its middle, so that none is torn (Meyer,
    Suessmuth, Sussner, Stamminger, Greiner 2010).
    """
    corner = xyz[mesh.corners]
    middle = np.add.reduceat(corner, mesh.starts[:-1], axis=0)
    sign = np.repeat(np.where(middle < 0.0, -1.0, 1.0), mesh.sizes, axis=0)
    flat = corner / np.maximum((sign * corner).sum(axis=1, keepdims=True), 1e-12)
    x, y = flat[:, 0], flat[:, 1]
    south = sign[:, 2] < 0.0
    u = np.where(south, sign[:, 0] * (1.0 - sign[:, 1] * y), x)
    v = np.where(south, sign[:, 1] * (1.0 - sign[:, 0] * x), y)
    return np.column_stack((0.5 + 0.5 * u, 0.5 + 0.5 * v))


def on_sphere(uv: Real, *, octahedron: bool = False) -> Real:
    """Points (k, 3) of the sphere for points (k, 2) of the unit square, laid out by one of these; others are taken as
    the nearest of it, or one turn further.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> cuv.on_sphere(np.array([[0.5, 0.5]])).tolist(), cuv.on_sphere(np.array([[0.5, 0.5]]), octahedron=True).tolist()
    ([[1.0, 0.0, 0.0]], [[0.0, 0.0, 1.0]])
    """
    if not octahedron:
        longitude = 2.0 * np.pi * (uv[:, 0] - 0.5)
        latitude = np.pi * (np.clip(uv[:, 1], 0.0, 1.0) - 0.5)
        across = np.cos(latitude)
        return np.column_stack((across * np.cos(longitude), across * np.sin(longitude), np.sin(latitude)))
    x, y = np.clip(2.0 * uv - 1.0, -1.0, 1.0).T
    z = 1.0 - np.abs(x) - np.abs(y)
    south = z < 0.0
    flat = np.column_stack(
        (
            np.where(south, np.copysign(1.0 - np.abs(y), x), x),
            np.where(south, np.copysign(1.0 - np.abs(x), y), y),
            z,
        )
    )
    return flat / np.linalg.norm(flat, axis=1, keepdims=True)

"""A map to the sphere as it is stored, in positions and in texture coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh.polygons import PolygonMesh
from .layout import equirectangular, octahedral

__all__ = ["StoredSphere", "stored_sphere"]

Real = NDArray[np.float64]

TOLERANCE = 1e-4  # of the radius: single precision, and a digit or two lost since
MOST = 0.95  # of the corners have to lie where the layout puts them; faces at its seams may have gone either way
FEWEST = 5  # points; four always lie on a sphere


@dataclass(frozen=True, eq=False)
class StoredSphere:
    """Positions on a sphere, and the layout of the texture coordinates that belong to them.

    Attributes
    ----------
    mesh : PolygonMesh
    center : (3,) float64
    radius : float
    xyz : (n, 3) float64
        Vertices on the unit sphere; what belongs to no face lies somewhere.
    octahedron : bool or None
        Whether the layout is `octahedral`, or `equirectangular`; None where it is neither.
    """

    mesh: PolygonMesh
    center: Real
    radius: float
    xyz: Real
    octahedron: bool | None

    def positions(self, xyz: Real) -> Real:
        """Positions (n, 3) for points (n, 3) of the unit sphere."""
        return self.center + self.radius * xyz

    def uv(self, xyz: Real) -> Real:
        """Texture coordinates (k, 2) of the corners for them."""
        return (octahedral if self.octahedron else equirectangular)(xyz, self.mesh)


def stored_sphere(mesh: PolygonMesh, positions: ArrayLike, corner_uv: ArrayLike | None = None) -> StoredSphere | None:
    """The sphere that positions (n, 3) lie on, None where they lie on none.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> cube = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    >>> faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    >>> mesh = cuv.PolygonMesh(cube, np.concatenate(faces), np.arange(0, 25, 4))
    >>> cuv.stored_sphere(mesh, cube).center.round(12).tolist()
    [0.5, 0.5, 0.5]
    """
    places = np.asarray(positions, dtype=np.float64)
    used = np.unique(mesh.corners)
    if len(used) < FEWEST or not np.isfinite(places[used]).all():
        return None
    middle = places[used].mean(axis=0)
    x = places[used] - middle
    unit = float(np.abs(x).max())
    if not unit > 0.0:
        return None
    x = x / unit
    *c, s = np.linalg.lstsq(np.column_stack((2.0 * x, np.ones(len(x)))), (x * x).sum(axis=1), rcond=None)[0]
    center, square = np.array(c), float(s + np.dot(c, c))
    distance = np.linalg.norm(x - center, axis=1)
    if not square > 0.0 or np.abs(distance / np.sqrt(square) - 1.0).max() > TOLERANCE:
        return None
    xyz = np.tile([0.0, 0.0, 1.0], (len(places), 1))
    xyz[used] = (x - center) / distance[:, None]
    return StoredSphere(mesh, middle + unit * center, unit * float(np.sqrt(square)), xyz, _layout(mesh, xyz, corner_uv))


def _layout(mesh: PolygonMesh, xyz: Real, corner_uv: ArrayLike | None) -> bool | None:
    """Which layout texture coordinates come from."""
    if corner_uv is None:
        return None
    uv = np.asarray(corner_uv, dtype=np.float64)
    for octahedron, layout in ((False, equirectangular), (True, octahedral)):
        away = np.abs(layout(xyz, mesh) - uv)
        if not octahedron:
            away[:, 0] = np.abs(away[:, 0] - np.rint(away[:, 0]))  # whole turns
            away[:, 0] *= np.hypot(*xyz[mesh.corners][:, :2].T)  # near the poles longitude means little
        if (away.max(axis=1) < 10.0 * TOLERANCE).mean() >= MOST:
            return octahedron
    return None

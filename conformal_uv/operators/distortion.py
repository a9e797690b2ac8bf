"""How far a map is from keeping angles and areas."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..concise import Concise
from ..errors import MeshError, NonFiniteError, listed
from ..mesh.arrays import face_array, scaled, vertex_array
from ..mesh.blocks import by_blocks
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from .orientation_sign import orientation_signs, outward_signs
from .wirtinger import Sides, planar_sides, unfolded_sides, wirtinger

__all__ = ["Distortion", "angle_between", "distortion", "distortion_of"]

Real = NDArray[np.float64]

RATIOS = (2.0**-1000, 2.0**1000)  # of units, whose squares then make every area 0 or infinite


@dataclass(frozen=True, eq=False, repr=False)
class Distortion(Concise):
    """Distortion of a piecewise linear map, face by face.

    Attributes
    ----------
    angle_error : (m, 3) float64
        ``|angle in the image - angle on the surface|`` at each corner, degrees.
    quasi_conformal : (m,) float64
        Larger over smaller singular value, at least 1; infinite where a face or its image has no area.
    area_scale : (m,) float64
        Area of the image over area of the face, not negative; infinite where the face has none.
    flipped : (k,) int64
        Faces whose image has non-positive signed area.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    >>> d = cuv.distortion(V, [[0, 1, 2]], [[0, 0], [0, 3], [1, 0]])  # mirrored, and three times as long one way
    >>> d.quasi_conformal.round(12).tolist(), d.area_scale.tolist(), d.flipped.tolist()
    ([3.0], [3.0], [0])
    """

    angle_error: NDArray[np.float64]
    quasi_conformal: NDArray[np.float64]
    area_scale: NDArray[np.float64]
    flipped: NDArray[np.int64]

    @cached_property
    def angle_mean(self) -> float:
        """Mean angle error over all corners, degrees."""
        return float(self.angle_error.mean())

    @cached_property
    def angle_sd(self) -> float:
        """Standard deviation of the angle error, degrees."""
        return float(self.angle_error.std())

    @cached_property
    def angle_max(self) -> float:
        """Largest angle error, degrees."""
        return float(self.angle_error.max())


def distortion(V: ArrayLike, F: ArrayLike, image: ArrayLike) -> Distortion:
    """Distortion of the map that takes the vertices V to `image`.

    Parameters
    ----------
    V : (n, 3) floats
    F : (m, 3) integers
    image : (n, 2) or (n, 3) floats
        Positions in the plane, or on a sphere around the origin (a face is flipped when it is seen from outside
        in the opposite sense).

    Raises
    ------
    MeshError
        The arrays are not a mesh or the image has another number of vertices; NonFiniteError on positions that are
        NaN or infinite.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    >>> d = cuv.distortion(V, [[0, 1, 2]], [[0, 0], [2, 0], [0, 2]])
    >>> round(d.angle_max, 12), d.area_scale.tolist()
    (0.0, [4.0])
    """
    vertices = vertex_array(V)
    corners = face_array(F, len(vertices))
    try:
        raw = np.asarray(image)
        if raw.dtype.kind not in "biuf":
            raise TypeError(f"dtype {raw.dtype}")
        positions = raw.astype(np.float64)
    except (TypeError, ValueError) as error:
        raise MeshError(f"The image is not an array of real numbers ({error}); pass (n, 2) or (n, 3).") from error
    if positions.ndim != 2 or positions.shape[1] not in (2, 3) or len(positions) != len(vertices):
        raise MeshError(f"The image has shape {positions.shape}; pass ({len(vertices)}, 2) or ({len(vertices)}, 3).")
    bad = np.flatnonzero(~np.isfinite(positions).all(axis=1))
    if len(bad):
        raise NonFiniteError(f"The image of {len(bad)} vertices is NaN or infinite: vertices {listed(bad)}.", bad)
    (vertices, unit), (positions, image_unit) = scaled(vertices), scaled(positions)
    with np.errstate(over="ignore", under="ignore"):
        ratio = float(np.clip(unit / np.float64(image_unit), *RATIOS))
    return distortion_of(triangle_geometry(vertices, corners), corners, positions, ratio)


def distortion_of(
    geometry: TriangleGeometry, corners: NDArray[np.int32], image: NDArray[np.float64], unit: float = 1.0
) -> Distortion:
    """The same for geometry at hand, its unit of length being `unit` of the image's, and positions already checked."""
    m = corners.shape[1]
    angle, quasi_conformal, area_scale, signs = np.empty((m, 3)), np.empty(m), np.empty(m), orientations(image, corners)

    def measure(part: slice) -> None:
        here, there = geometry.part(part), triangle_geometry(image, corners[:, part])
        sides = _image_sides(image, corners[:, part], there)
        has_area = here.double_area > 0
        fz, fzbar = wirtinger(unfolded_sides(here), sides, np.where(has_area, here.double_area, 1.0))
        plus, minus = np.abs(fz), np.abs(fzbar)
        small = np.abs(plus - minus)
        angle[part] = angle_between(here, there).T
        quasi_conformal[part] = _ratio(plus + minus, small, has_area & (small > 0))
        area_scale[part] = _ratio(there.double_area, here.double_area, has_area, unit)

    by_blocks(measure, m)
    return Distortion(np.degrees(angle, out=angle), quasi_conformal, area_scale, np.flatnonzero(signs <= 0))


def orientations(image: Real, corners: NDArray[np.int32]) -> NDArray[np.int8]:
    """Exact sign of each face's area in the plane, or on a sphere around the origin seen from outside, (m,)."""
    return (orientation_signs if image.shape[1] == 2 else outward_signs)(image, corners)


def _image_sides(image: Real, corners: NDArray[np.int32], shape: TriangleGeometry) -> Sides:
    """Two edges of each face's image, laid into a plane; from the sphere always anticlockwise."""
    if image.shape[1] == 2:
        return planar_sides(np.ascontiguousarray(image).view(np.complex128).reshape(-1), corners)
    return unfolded_sides(shape)


def angle_between(one: TriangleGeometry, other: TriangleGeometry) -> Real:
    """Size of the difference of the angles at each corner, (3, m) radians, without taking either angle itself.

    A corner with an edge of no length has angle 0.
    """
    (x, y), (u, v) = ((np.where(t.double_area + np.abs(t.dot) > 0, t.dot, 1.0), t.double_area) for t in (one, other))
    return np.abs(np.arctan2(y * u - x * v, x * u + y * v))


def _ratio(
    over: NDArray[np.float64], under: NDArray[np.float64], where: NDArray[np.bool_], unit: float = 1.0
) -> NDArray[np.float64]:
    """Quotient divided by the unit squared, infinite elsewhere and where it is too large for doubles."""
    out = np.full(len(over), np.inf)
    with np.errstate(over="ignore", under="ignore"):
        np.divide(over, under, out=out, where=where)
        return out / unit / unit

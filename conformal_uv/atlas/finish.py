"""Solutions of many disks put in their places, and which of them leave nothing to be mended."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..disk.ears import DOUBTFUL_ARC
from ..disk.placement import inside_disk
from ..mesh.geometry import triangle_geometry
from ..operators.distortion import angle_between
from ..operators.orientation_sign import collapsed_faces
from .disks import Disks, neighbours

__all__ = ["angle_means", "placed", "plain_maps"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]
Bools = NDArray[np.bool_]


def placed(disks: Disks, z: Complex) -> Complex:
    """Positions (n,) with the first boundary vertex of every disk at 1."""
    first = disks.loop[disks.first_boundary[:-1]]
    turn = np.conj(z[first])
    z = z * (turn / np.abs(turn))[disks.of_vertex]
    z[disks.loop] /= np.abs(z[disks.loop])
    z = inside_disk(z)
    z[first] = 1.0
    return z


def plain_maps(disks: Disks, z: Complex) -> Bools:
    """Disks (c,) whose boundary vertices doubles tell apart, and none of whose faces are folded, flat or narrow ears.

    On the others `disk.mapper` has to see what is to be done.
    """
    plain = np.ones(len(disks), dtype=bool)
    zb = z[disks.loop]
    ahead, _ = neighbours(disks.first_boundary)
    together = (zb[ahead] == zb) | ~(np.angle(zb[ahead] / zb) > 0.0)
    plain[disks.of_boundary[together]] = False
    plain[disks.of_face[collapsed_faces(z, disks.corners)]] = False
    on_boundary = np.zeros(disks.n, dtype=bool)
    on_boundary[disks.loop] = True
    ears = np.flatnonzero(on_boundary[disks.corners].all(axis=0))
    a, b, c = (z[corner] for corner in disks.corners[:, ears])
    longest = np.maximum(np.maximum(np.abs(b - a), np.abs(c - b)), np.abs(a - c))
    plain[disks.of_face[ears[longest < DOUBTFUL_ARC]]] = False
    return plain


def angle_means(disks: Disks, z: Complex) -> Real:
    """Mean angle error of each map (c,), degrees."""
    image = triangle_geometry(np.ascontiguousarray(z).view(np.float64).reshape(-1, 2), disks.corners)
    error = angle_between(disks.geometry, image).sum(axis=0)
    return np.degrees(np.bincount(disks.of_face, error, len(disks)) / (3 * np.diff(disks.first_face)))

"""Angles, upright and mirror symmetry of UVs as Blender stores them, by other means than the extension's."""

from __future__ import annotations

import numpy as np
import scenes

ROUNDING = 2.0**-25 / np.sqrt(3.0)  # standard deviation of what single precision takes from coordinates near 1


def triangles(ob):
    """Corners of the mesh's triangles as Blender cuts its faces, (m, 3)."""
    ob.data.calc_loop_triangles()
    return np.array([triangle.loops[:] for triangle in ob.data.loop_triangles])


def angles(X, corners):
    """At the corners of triangles, degrees, (m, 3)."""
    P = np.zeros((*corners.shape, 3))
    P[..., : X.shape[1]] = X[corners]
    first, second = np.roll(P, -1, axis=1) - P, np.roll(P, 1, axis=1) - P
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(first, second), axis=2), (first * second).sum(axis=2)))


def positions(ob):
    """Of every corner in space, (k, 3)."""
    return scenes.arrays(ob)[0][[loop.vertex_index for loop in ob.data.loops]]


def mean_angle_error(ob):
    """Over all corners of triangles, degrees."""
    corners, uv = triangles(ob), scenes.uvs(ob).astype(float)
    return float(np.abs(angles(uv, corners) - angles(positions(ob), corners)).mean())


def rounding_of_angles(ob):
    """The mean angle error that single precision alone makes, degrees.

    Both ends of an edge of length l are moved across it by a normal deviate of ROUNDING, which turns it by sqrt(2)
    ROUNDING / l; an angle has two edges, and the mean of a normal deviate's modulus is sqrt(2 / pi).
    """
    Q = scenes.uvs(ob).astype(float)[triangles(ob)]
    square = (np.linalg.norm(np.roll(Q, -1, axis=1) - Q, axis=2) ** -2)[..., None]
    turned = np.sqrt(2.0 * (square + np.roll(square, 1, axis=1))) * ROUNDING
    return float(np.degrees(turned.mean()) * np.sqrt(2.0 / np.pi))


def tilt(ob, up, face=None):
    """Degrees from v to where the surface rises along an axis, in the mean over its area; of one face's island."""
    corners, uv, P = triangles(ob), scenes.uvs(ob).astype(float), positions(ob)
    if face is not None:
        owner = np.repeat(scenes.face_islands(ob), [polygon.loop_total for polygon in ob.data.polygons])
        corners = corners[owner[corners[:, 0]] == face]
    total = np.zeros(2)
    for p, q in zip(P[corners], uv[corners], strict=True):
        sides = q[1:] - q[0]
        if np.linalg.det(sides) > 0.0:
            gradient = np.linalg.solve(sides, p[1:, up] - p[0, up])
            normal = np.cross(p[1] - p[0], p[2] - p[0])
            total += np.hypot(*np.delete(normal, up)) * gradient / max(np.linalg.norm(gradient), 1e-300)
    return float(np.degrees(np.arctan2(total[0], total[1])))


def mirror_misfit(ob, face):
    """How far UVs of a face's island are from those of the vertices mirrored in x, reflected about the upright line
    through their middle: root mean square over the island's size. Vertices on seams, with several UVs, are left out."""
    owner = np.repeat(scenes.face_islands(ob), [polygon.loop_total for polygon in ob.data.polygons])
    P, uv = positions(ob), scenes.uvs(ob).astype(float)
    place = {}
    for corner in np.flatnonzero(owner == face):
        place.setdefault(tuple(np.round(1e4 * P[corner]).astype(int).tolist()), set()).add(tuple(uv[corner].tolist()))
    alone = {key: np.array(*found) for key, found in place.items() if len(found) == 1}
    pairs = [(uv, alone[-x, y, z]) for (x, y, z), uv in alone.items() if (-x, y, z) in alone]
    assert len(pairs) > 0.9 * len(place)
    one, other = (np.array(side) for side in zip(*pairs, strict=True))
    reflected = np.column_stack((one[:, 0].mean() + other[:, 0].mean() - other[:, 0], other[:, 1]))
    size = np.ptp(uv[owner == face], axis=0).max()
    return float(np.sqrt(((one - reflected) ** 2).sum(axis=1).mean()) / size)


def largest_island(ob):
    """The first face of the island with the most faces."""
    first, count = np.unique(scenes.face_islands(ob), return_counts=True)
    return int(first[np.argmax(count)])

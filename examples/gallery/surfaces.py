"""Surfaces of the gallery that are no samples of the library: by formula, and nilearn's brain."""

from importlib.resources import files

import numpy as np
from scipy.spatial import ConvexHull


def sphere_points(count=40000):
    """Points spread over the unit sphere along a spiral, and the triangles of their convex hull, outwards."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    P = np.column_stack((np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z))
    return P, outward(P, ConvexHull(P).simplices)


def outward(P, F):
    """Triangles around the origin wound anticlockwise, seen from outside."""
    return np.where((np.linalg.det(P[F]) < 0)[:, None], F[:, ::-1], F)


def bumpy_ball(count=40000, seed=3):
    """A ball moved in and out by waves."""
    P, F = sphere_points(count)
    waves = np.random.default_rng(seed).normal(size=(6, 3)) * 2.0
    return P * (1.0 + 0.085 * np.cos(P @ waves.T + np.arange(6)).sum(axis=1))[:, None] * [1.0, 1.2, 0.9], F


def head(count=30000):
    """A head whose left half mirrors its right, vertices and triangles too: x left, y up, z to the front."""
    k = np.arange(count // 2) + 0.5
    z, turn = 1 - 2 * k / (count // 2), np.pi * (1 + np.sqrt(5)) * k
    P = np.column_stack((np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z))
    seam = np.linspace(0, 2 * np.pi, int(1.6 * np.sqrt(count)), endpoint=False)
    half = np.vstack((np.column_stack((0 * seam, np.sin(seam), np.cos(seam))), P[P[:, 0] > 0.6 / np.sqrt(count)]))
    F = ConvexHull(half).simplices
    F = outward(half, F[(half[F, 0] > 1e-9).any(axis=1)])  # without the flat side of the half ball
    other = np.where(
        np.arange(len(half)) < len(seam), np.arange(len(half)), np.arange(len(half)) + len(half) - len(seam)
    )
    P = np.vstack((half, half[len(seam) :] * [-1, 1, 1]))
    F = np.vstack((F, other[F[:, ::-1]]))
    x, y, z = np.abs(P[:, 0]), P[:, 1], P[:, 2]

    def bump(cx, cy, cz, width, height, across=None):
        far = ((x - cx) / (across or width)) ** 2 + ((y - cy) ** 2 + (z - cz) ** 2) / width**2
        return height * np.exp(-far)

    r = 1.0 + bump(0, -0.10, 1.0, 0.15, 0.22, 0.10) + bump(0, 0.10, 1.0, 0.15, 0.10, 0.08)  # the nose,
    r += bump(0.10, -0.17, 0.98, 0.06, 0.06)
    r += bump(0.33, 0.14, 0.93, 0.14, -0.11, 0.17) + bump(0.33, 0.14, 0.93, 0.08, 0.09, 0.10)  # eyes and brows,
    r += bump(0.30, 0.33, 0.88, 0.08, 0.05, 0.2)
    r += bump(0, -0.41, 0.9, 0.05, 0.055, 0.2) + bump(0, -0.52, 0.85, 0.05, 0.055, 0.16)  # lips, chin, ears, cheeks
    r += bump(0, -0.80, 0.6, 0.2, 0.12, 0.28) + bump(0.5, -0.2, 0.8, 0.22, 0.05)
    r += bump(0.98, 0.02, -0.05, 0.17, 0.22) + bump(1.0, 0.02, 0.06, 0.08, -0.10)
    return P * r[:, None] * [0.78, 1.08, 0.92], F


def grid(columns, rows):
    """The unit square as a grid of triangles: places (n, 2), F."""
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    number = np.arange(columns * rows).reshape(rows, columns)
    a, b, c, d = (part.ravel() for part in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]))
    return np.column_stack((u.ravel(), v.ravel())), np.vstack((np.column_stack((a, b, c)), np.column_stack((a, c, d))))


def hat(count=20000):
    """A crown on a brim with a dent: like the surface of the report's first figure, by a formula of our own."""
    from conformal_uv.samples import irregular_disk

    xy, F = irregular_disk(count)
    r, turn = np.hypot(*xy.T), np.arctan2(xy[:, 1], xy[:, 0])
    crown = (
        0.75
        / (1 + np.exp((r - 0.52) / 0.035))
        * (1 - 0.35 * np.exp(-((xy[:, 0] / 0.12) ** 2) - ((xy[:, 1] / 0.4) ** 2)))
    )
    brim = 0.10 * r**4 * np.cos(2 * turn)
    return np.column_stack((xy * [1.0, 0.85], crown + brim)), F


def hemisphere(side="left", kind="pial"):
    """V, F and the depth of sulci of FreeSurfer's fsaverage5, out of nilearn's package."""
    import nibabel

    folder = files("nilearn") / "datasets" / "data" / "fsaverage5"
    V, F = (array.data for array in nibabel.load(folder / f"{kind}_{side}.gii.gz").darrays)
    return V.astype(float), F.astype(int), nibabel.load(folder / f"sulc_{side}.gii.gz").darrays[0].data


def cortex(side="left", kind="pial"):
    """A hemisphere without its medial wall, with the cuts of FreeSurfer's flat patch: V, F, the depth of sulci."""
    import nibabel

    V, _, depth = hemisphere(side, kind)
    folder = files("nilearn") / "datasets" / "data" / "fsaverage5"
    F = nibabel.load(folder / f"flat_{side}.gii.gz").darrays[1].data.astype(int)
    kept, F = np.unique(F, return_inverse=True)
    return V[kept], F.reshape(-1, 3), depth[kept]

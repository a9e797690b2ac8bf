"""Sphere maps side by side: this package's linear and newton, and LaPy's spherical_conformal_map.

    python -m pip install lapy nilearn nibabel
    python benchmarks/sphere_against_lapy.py [MESH ...]

Without meshes: an ellipsoid, and the fsaverage5 left pial surface that comes with nilearn. Angle error is the mean over
all corners, in degrees, of the positions each program returns; seconds are the median of three runs in this process.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

import conformal_uv as cuv
from conformal_uv.files import read_mesh
from conformal_uv.mesh.triangulate import triangulate

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def ellipsoid(count: int = 2562) -> Mesh:
    """Axes 1 : 1.5 : 2.5 over the convex hull of spiral points of the sphere."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    ring = np.sqrt(1 - z * z)
    P = np.column_stack((ring * np.cos(turn), ring * np.sin(turn), z))
    F = ConvexHull(P).simplices.astype(np.int64)
    inward = np.linalg.det(P[F]) < 0
    F[inward] = F[inward][:, ::-1]
    return P * [1.0, 1.5, 2.5], F


def cortex() -> Mesh:
    """The brain surface in the nilearn wheel."""
    import nibabel
    import nilearn

    path = Path(nilearn.__file__).parent / "datasets" / "data" / "fsaverage5" / "pial_left.gii.gz"
    V, F = (array.data for array in nibabel.load(path).darrays[:2])
    return V.astype(np.float64), F.astype(np.int64)


def from_file(name: str) -> Mesh:
    """A mesh file's triangles."""
    mesh = read_mesh(name).mesh
    return mesh.V, triangulate(mesh)[0]


def lapy_map(V: NDArray[np.float64], F: NDArray[np.int64]) -> NDArray[np.float64]:
    """LaPy's map, turned inside out where it comes mirrored."""
    from lapy import TriaMesh
    from lapy.conformal import spherical_conformal_map

    xyz = np.asarray(spherical_conformal_map(TriaMesh(V, F)))
    a, b, c = (xyz[F[:, k]] for k in range(3))
    return xyz * np.sign(np.einsum("ij,ij->", a, np.cross(b, c)))


def main() -> None:
    """Print the table."""
    meshes = {name: from_file(name) for name in sys.argv[1:]} or {"ellipsoid": ellipsoid(), "fsaverage5": cortex()}
    ways: dict[str, Callable[..., NDArray[np.float64]]] = {
        "linear": lambda V, F: cuv.sphere_map(V, F, method="linear").xyz,
        "newton": lambda V, F: cuv.sphere_map(V, F).xyz,
        "lapy": lapy_map,
    }
    print(f"{'mesh':24} {'method':8} {'angle error':>12} {'flipped':>8} {'seconds':>9}")
    for name, (V, F) in meshes.items():
        for way, function in ways.items():
            spent = []
            for _ in range(3):
                start = time.perf_counter()
                xyz = function(V, F)
                spent.append(time.perf_counter() - start)
            d = cuv.distortion(V, F, xyz)
            told = f"{d.angle_mean:12.4f} {len(d.flipped):8} {statistics.median(spent):9.3f}"
            print(f"{Path(name).name:24} {way:8} {told}", flush=True)


if __name__ == "__main__":
    main()

"""The filter beside pymeshlab's own parametrizations, on one mesh with the topology of a disk.

    python benchmarks/meshlab_peers.py scan.obj

pymeshlab's harmonic map goes onto the same circle, its boundary by arc length; its least-squares conformal map has a
free boundary. Their texture coordinates are read back from the mesh and all measured alike.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np
import pymeshlab

import conformal_uv
from meshlab_filter import compute_texcoord_parametrization_conformal_disk


def measured(path: str, run: Any) -> dict[str, float]:
    """Distortion of the coordinates that `run(ms)` leaves on the mesh of a file."""
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(path)
    mesh = ms.current_mesh()
    V, F = mesh.vertex_matrix(), mesh.face_matrix()
    conformal_uv.DiskMapper(V, F)  # raises on topology that pymeshlab's own filters would crash on
    start = time.perf_counter()
    run(ms)
    spent = time.perf_counter() - start
    if mesh.has_wedge_tex_coord():
        uv, corner = mesh.wedge_tex_coord_matrix(), np.arange(3 * len(F)).reshape(-1, 3)
    else:
        uv, corner = mesh.vertex_tex_coord_matrix(), F
    d = conformal_uv.distortion(V[F.reshape(-1)], np.arange(3 * len(F)).reshape(-1, 3), uv[corner.reshape(-1)])
    return {
        "angle_mean": d.angle_mean,
        "angle_max": d.angle_max,
        "ratio_mean": float(d.quasi_conformal.mean()),
        "ratio_max": float(d.quasi_conformal.max()),
        "flipped": float(len(d.flipped)),
        "seconds": spent,
    }


METHODS = {
    "conformal disk": compute_texcoord_parametrization_conformal_disk,
    "conformal disk, linear": lambda ms: compute_texcoord_parametrization_conformal_disk(ms, method="linear"),
    "harmonic": lambda ms: ms.compute_texcoord_parametrization_harmonic(harm_function=1),
    "least squares": lambda ms: ms.compute_texcoord_parametrization_least_squares_conformal_maps(),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    options = parser.parse_args()
    rows = {name: measured(options.mesh, run) for name, run in METHODS.items()}
    print(f"{'':24}" + "".join(f"{key:>12}" for key in next(iter(rows.values()))))
    for name, row in rows.items():
        print(f"{name:24}" + "".join(f"{value:12.4g}" for value in row.values()))


if __name__ == "__main__":
    main()

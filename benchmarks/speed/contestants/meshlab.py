"""In pymeshlab: its harmonic map to the circle by arc length, its least squares conformal map, and our filter."""

from __future__ import annotations

import numpy as np
import pymeshlab

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage, *, method: str) -> Outcome:
    """A mesh of MeshLab's from the arrays, the filter, and its coordinates read back."""
    stage("copying")
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(arrays["V"], arrays["F"].astype(np.int32)))
    stage("filter")
    if method == "harmonic":
        ms.compute_texcoord_parametrization_harmonic(harm_function=1)
    elif method == "conformal disk":
        from meshlab_filter import compute_texcoord_parametrization_conformal_disk

        compute_texcoord_parametrization_conformal_disk(ms)
    else:
        ms.compute_texcoord_parametrization_least_squares_conformal_maps()
    stage("copying")
    mesh = ms.current_mesh()
    if not mesh.has_wedge_tex_coord():
        return Outcome(mesh.vertex_tex_coord_matrix())
    uv = np.empty((len(arrays["V"]), 2))
    uv[arrays["F"].reshape(-1)] = mesh.wedge_tex_coord_matrix()
    return Outcome(2.0 * uv - 1.0 if method == "conformal disk" else uv)  # ours fills the square [0, 1]^2

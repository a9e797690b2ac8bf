"""libigl: the harmonic map to the circle by arc length, and the least squares conformal map with two pins."""

from __future__ import annotations

import igl
import numpy as np

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage, *, method: str) -> Outcome:
    """As libigl's tutorial does it (chapter 5)."""
    V, F = arrays["V"], arrays["F"]
    stage("boundary")
    loop = igl.boundary_loop(F)
    if method == "lscm":
        pins = np.array([loop[0], loop[len(loop) // 2]])
        stage("lscm")
        return Outcome(igl.lscm(V, F, pins, np.array([[0.0, 0.0], [1.0, 0.0]]))[0])
    circle = igl.map_vertices_to_circle(V, loop.astype(np.int32))
    stage("harmonic")
    return Outcome(igl.harmonic(V, F, loop, circle, 1))

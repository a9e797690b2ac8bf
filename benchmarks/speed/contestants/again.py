"""Ours: a mapper asked a second and a third time, for another centre and for three pins."""

from __future__ import annotations

import numpy as np

import conformal_uv as cuv

from .disk import RELATIVE_TOLERANCE
from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage, *, method: str, backend: str) -> Outcome:
    """The first map with its checks and factorization, then the two others, each a stage."""
    stage("first")
    mapper = cuv.DiskMapper(arrays["V"], arrays["F"], backend=backend)
    mapper.map(method=method, relative_tolerance=RELATIVE_TOLERANCE)
    stage("choice of vertices")
    loop = mapper.boundary
    inside = np.setdiff1d(np.arange(len(arrays["V"])), loop)
    center = int(inside[len(inside) // 3])
    pins = tuple(int(loop[k * len(loop) // 3]) for k in range(3))
    stage("again, center")
    mapper.map(center=center, method=method, relative_tolerance=RELATIVE_TOLERANCE)
    stage("again, pins")
    result = mapper.map(pins=pins, method=method, relative_tolerance=RELATIVE_TOLERANCE)
    return Outcome(result.uv)

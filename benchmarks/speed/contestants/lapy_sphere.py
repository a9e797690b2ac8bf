"""LaPy: its spherical conformal map (Choi, Lam, Lui 2015)."""

from __future__ import annotations

import numpy as np
from lapy import TriaMesh
from lapy.conformal import spherical_conformal_map

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage) -> Outcome:
    """As it comes, mirrored or not."""
    stage("lapy")
    return Outcome(np.asarray(spherical_conformal_map(TriaMesh(arrays["V"], arrays["F"])), dtype=np.float64))

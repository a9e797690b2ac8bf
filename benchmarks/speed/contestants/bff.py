"""confmap: boundary first flattening with the least distortion of scale (Sawhney, Crane 2018), in numpy and scipy.

The confmap on the package index is another program; this one comes from github.com/russelmann/confmap.
"""

from __future__ import annotations

import numpy as np
from confmap.confmap import BFF

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage) -> Outcome:
    """The layout, each vertex taken from a corner of its faces."""
    stage("bff")
    image = BFF(arrays["V"], arrays["F"]).layout()
    uv = np.empty((len(arrays["V"]), 2))
    uv[arrays["F"].reshape(-1)] = np.asarray(image.vertices)[np.asarray(image.faces).reshape(-1), :2]
    return Outcome(uv)

"""Ours: the map of a closed mesh to the sphere."""

from __future__ import annotations

import conformal_uv as cuv

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage, *, method: str) -> Outcome:
    """Everything from the checks of the arrays on."""
    stage("checks")
    result = cuv.sphere_map(arrays["V"], arrays["F"], method=method, callback=lambda name, fraction: stage(name))
    return Outcome(result.xyz)

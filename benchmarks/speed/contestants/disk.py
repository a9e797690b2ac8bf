"""Ours: the map to the disk, with the energies and flips that come with its result."""

from __future__ import annotations

import conformal_uv as cuv

from .outcome import Arrays, Outcome, Stage

RELATIVE_TOLERANCE = 1e-6  # of the projected gradient, relative to where Newton's method starts


def run(arrays: Arrays, stage: Stage, *, method: str, backend: str, prefix: str = "") -> Outcome:
    """Everything from the checks of the arrays on, of those whose names have the prefix."""
    stage("checks")
    result = cuv.disk_map(
        arrays[f"{prefix}V"],
        arrays[f"{prefix}F"],
        method=method,
        backend=backend,
        callback=lambda name, fraction: stage(name),
        relative_tolerance=RELATIVE_TOLERANCE,
    )
    return Outcome(result.uv, {"distortion, if asked for": lambda: result.distortion.angle_mean})

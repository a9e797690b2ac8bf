"""Ours: many islands at once, split, mapped and packed."""

from __future__ import annotations

import conformal_uv as cuv

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage, **options: str) -> Outcome:
    """Polygons in, coordinates of all corners out."""
    stage("unwrap")
    result = cuv.unwrap(arrays["V"], arrays["F"], **options)
    if not result.mapped.all():
        raise RuntimeError(f"{(~result.mapped).sum()} faces were not mapped")
    return Outcome()

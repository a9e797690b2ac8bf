"""A result in a notebook: a small picture and its numbers."""

from __future__ import annotations

import base64
import html

import numpy as np

from ..charts import Unwrapped
from ..free import FreeMap
from ..mapped_mesh import AnyMap, mapped_mesh
from ..pictures.png import png
from ..pictures.thumbnail import thumbnail
from ..rectangle import RectangleMap
from ..report import distortion_numbers
from ..sphere import SphereMap

__all__ = ["summary_html"]

MOST_TRIANGLES = 500_000  # that are drawn, in two seconds
NAMES = {
    "disk": "map to the unit disk",
    "free": "map with a free boundary",
    "rectangle": "map to a rectangle",
    "sphere": "map to the unit sphere",
    "charts": "charts in the texture",
}


def summary_html(result: AnyMap) -> str:
    """Numbers beside a thumbnail, as HTML."""
    if isinstance(result, Unwrapped) and not result.charts.mapped.any():
        return f"<p>{html.escape(result.summary)}</p>"
    mapped = mapped_mesh(result)
    numbers = distortion_numbers([mapped.distortion])
    rows = [
        ("vertices, triangles", f"{len(np.unique(mapped.vertices)):,}, {len(mapped.F):,}"),
        ("angle error", f"mean {numbers.angle_mean:.3g}°, max {numbers.angle_max:.3g}°"),
        ("flipped triangles", f"{len(mapped.distortion.flipped):,}"),
        *_own_rows(result),
    ]
    name = NAMES[mapped.shape]
    cells = "".join(
        f'<tr><th style="text-align:left">{html.escape(left)}</th>'
        f'<td style="text-align:left">{html.escape(right)}</td></tr>'
        for left, right in rows
    )
    table = f'<table><caption style="text-align:left;font-weight:bold">{name}</caption>{cells}</table>'
    picture = ""
    if len(mapped.F) <= MOST_TRIANGLES:
        data = base64.b64encode(png(thumbnail(mapped))).decode()
        picture = f'<img alt="The surface with a checker, and the {name}" src="data:image/png;base64,{data}">'
    return f'<div style="display:flex;flex-wrap:wrap;gap:1em;align-items:center">{picture}{table}</div>'


def _own_rows(result: AnyMap) -> list[tuple[str, str]]:
    """Numbers that only some results have."""
    if isinstance(result, Unwrapped):
        return [("charts", result.summary)]
    rows = [("conformal energy", f"{result.conformal_energy:.4g}")]
    if isinstance(result, RectangleMap):
        low, high = result.modulus_bounds
        rows.append(("modulus", f"{result.modulus:.5g}, between {low:.5g} and {high:.5g}"))
    elif isinstance(result, FreeMap):
        if len(result.crossings):
            rows.append(("boundary", f"crosses itself {len(result.crossings)} times"))
    else:
        rows.append(("method", f"{result.method}, {result.status}"))
    if isinstance(result, SphereMap):
        rows.append(("centred by", result.normalization))
    return rows

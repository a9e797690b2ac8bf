"""The page that sums up a batch: counts, histograms of the angle error, pictures of the worst maps, and what failed."""

from __future__ import annotations

import base64
import io
import os
from collections import Counter
from collections.abc import Iterable, Sequence
from html import escape
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from .._version import __version__
from ..batches import BatchRow, Outcome
from ..batches.sphere_file import used_triangles
from ..console.terminal import plain
from ..errors import ConformalUVError
from ..files import read_mesh, replaced_file
from ..options import MapKind, Upright
from ..pictures.figure import sphere_picture, texture_picture
from .texture import texture_of

__all__ = ["PAGE", "write_page"]

PAGE = "summary.html"
WORST = 10
MOST_BINS = 40
COLOUR = "#31688e"
WIDE = 50.0  # largest over smallest, from which a histogram's bins grow
DPI = 60.0
STYLE = """body{font:15px/1.45 system-ui,sans-serif;max-width:68rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2.2rem}table{border-collapse:collapse;font-size:.9rem}
td,th{text-align:left;padding:.2rem .9rem .2rem 0;vertical-align:top;border-bottom:1px solid #ddd}
td.n{text-align:right;font-variant-numeric:tabular-nums}img{max-width:100%}figure{margin:1.4rem 0}
figcaption{color:#555;font-size:.9rem;overflow-wrap:anywhere}"""


def write_page(out: Path, rows: Sequence[BatchRow]) -> Path:
    """Write the page of these rows into the folder of the maps, in one file with its pictures; the path of the page.

    Without matplotlib it has no pictures.
    """
    mapped = sorted(
        (row for row in rows if row.status in (Outcome.DONE, Outcome.PARTIAL) and row.angle_mean is not None),
        key=lambda row: -(row.angle_mean or 0.0),
    )
    parts = [f"<h1>{len(rows)} meshes</h1>", _counts(rows)]
    if find_spec("matplotlib") is None:
        parts.append('<p>For pictures here: pip install "conformal-uv[plot]".</p>')
    elif mapped:
        parts += ["<h2>Angle error</h2>", _histograms(mapped)]
        parts += [f"<h2>Largest mean angle error: {min(WORST, len(mapped))} maps</h2>"]
        parts += [_worst(row) for row in mapped[:WORST]]
    bad = [row for row in rows if not row.ok]
    if bad:
        parts += ["<h2>Not mapped, or not whole</h2>", _table(("mesh", "status", "error", ""), map(_bad_cells, bad))]
    head = f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{len(rows)} meshes</title>'
    foot = f"<p><small>conformal_uv {__version__}; all numbers are in rows.csv and rows.jsonl.</small></p></html>\n"
    path = out / PAGE
    with replaced_file(path) as stream:
        stream.write("\n".join([head, f"<style>{STYLE}</style>", *parts, foot]).encode("utf-8", "backslashreplace"))
    return path


def _counts(rows: Sequence[BatchRow]) -> str:
    counts = Counter(row.status for row in rows)
    cells = [(str(status), str(counts[status])) for status in Outcome if counts[status]]
    kinds = Counter(row.error for row in rows if row.error is not None)
    cells += [(str(kind), str(number)) for kind, number in sorted(kinds.items(), key=lambda item: -item[1])]
    cells.append(("seconds in all", f"{sum(row.seconds or 0.0 for row in rows):.1f}"))
    return _table((), cells)


def _bad_cells(row: BatchRow) -> tuple[str, ...]:
    return row.input, str(row.status), row.error or "", row.message or ""


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    titles = "".join(f"<th>{_text(cell)}</th>" for cell in head)
    lines = ["".join(f"<td>{_text(cell)}</td>" for cell in row) for row in rows]
    return "<table>" + "".join(f"<tr>{line}</tr>" for line in ([titles] if titles else []) + lines) + "</table>"


def _text(text: str) -> str:
    return escape(plain(text))


def _histograms(rows: Sequence[BatchRow]) -> str:
    """How the mean and the largest angle error of the maps are spread."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 3.4), dpi=80, layout="constrained")
    for axes, name, title in zip(
        figure.subplots(1, 2), ("angle_mean", "angle_max"), ("mean of each map", "largest of each map"), strict=True
    ):
        values = np.array([getattr(row, name) for row in rows], dtype=np.float64)
        low, high = float(values.min()), float(values.max())
        count = min(MOST_BINS, 4 + 2 * int(np.sqrt(len(values))))
        grows = low > 0.0 and high / low > WIDE
        axes.hist(values, bins=list(np.geomspace(low, high, count + 1)) if grows else count, color=COLOUR)
        if grows:
            axes.set_xscale("log")
        axes.set_title(f"angle error, {title}")
        axes.set_xlabel("degrees")
        axes.set_ylabel("maps")
    out = io.BytesIO()
    figure.savefig(out, format="png")
    return f"<figure>{_image(out.getvalue(), 'histograms of the angle error')}</figure>"


def _worst(row: BatchRow) -> str:
    """A map's picture and numbers; without the picture where its file can not be drawn any more."""
    told = f"{row.input}: mean {row.angle_mean:.4g}, largest {row.angle_max or 0.0:.4g} degrees; {row.flipped} flipped"
    try:
        picture = _image(_picture(row), row.input)
    except (ConformalUVError, OSError) as error:
        picture = f"<p>{_text(str(error))}</p>"
    return f"<figure>{picture}<figcaption>{_text(told)}</figcaption></figure>"


def _picture(row: BatchRow) -> bytes:
    title = os.path.basename(row.input).replace("$", r"\$")
    image = read_mesh(row.output)
    if row.map == MapKind.SPHERE:
        mesh = read_mesh(row.input).mesh
        V, F, used = used_triangles(mesh)
        xyz = np.zeros_like(mesh.V)
        xyz[mesh.corners] = image.mesh.V[image.mesh.corners]  # whose vertices may have been split
        return sphere_picture(V, F, xyz[used], (title, f"{row.method} map"), DPI)
    texture = texture_of(image)
    if texture is None:
        raise ConformalUVError(f"{row.output} has no texture coordinates any more.")
    caption = row.map if row.charts == 1 else f"{row.charts} charts"
    return texture_picture(texture.corners, texture.image, texture.distortion, (title, caption), Upright.NONE, DPI)


def _image(png: bytes, alt: str) -> str:
    return f'<img alt="{_text(alt)}" src="data:image/png;base64,{base64.b64encode(png).decode()}">'

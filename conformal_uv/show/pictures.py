"""A result as a figure and as a web page."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from ..files import check_place
from ..mapped_mesh import AnyMap
from ..options import Upright
from ..page import write_page
from ..pictures.figure import check_drawable, draw_figure, map_figure
from .libraries import library

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["plot", "to_html"]


def plot(result: AnyMap, path: str | PathLike[str] | None = None, *, title: str = "", upright: str = "z") -> Figure:
    """See `Shown.plot`."""
    library("matplotlib", "plot()", '"conformal-uv[plot]"')
    axis = Upright.of("upright", upright)
    if path is not None:
        check_drawable(Path(path), "path")
        check_place(path)
    figure = map_figure(result, title, axis)
    if path is not None:
        draw_figure(Path(path), figure)
    return figure


def to_html(result: AnyMap, path: str | PathLike[str], *, title: str, upright: str) -> None:
    """See `Shown.to_html`."""
    axis = Upright.of("upright", upright)
    check_place(path)
    write_page(Path(path), result, title, axis)

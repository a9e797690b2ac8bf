"""The page: style, program, numbers and mesh in one HTML file that asks for nothing else."""

from __future__ import annotations

import base64
import html
import json
import re
import zlib
from pathlib import Path

from .._version import __version__
from ..files import replaced_file
from ..mapped_mesh import AnyMap, MappedMesh, mapped_mesh
from ..options import Upright
from .model import PageModel, page_model

__all__ = ["page_html", "write_page"]

LEVEL = 6  # of zlib
ASSETS = Path(__file__).parent / "assets"
PLACE = re.compile(r"\{\{(\w+)\}\}")


def write_page(
    path: Path, result: AnyMap | MappedMesh, title: str, upright: Upright = Upright.Z, *, note: str = ""
) -> None:
    """Write the page of a map; see `page_html`.

    Raises
    ------
    MeshError
        Nothing was mapped.
    """
    text = page_html(result, title, upright, note=note)
    with replaced_file(path) as out:
        out.write(text.encode())


def page_html(result: AnyMap | MappedMesh, title: str, upright: Upright = Upright.Z, *, note: str = "") -> str:
    """A page with the surface beside its map, as text.

    Parameters
    ----------
    result : DiskMap, FreeMap, RectangleMap, SphereMap, Unwrapped or MappedMesh
    title : str
    upright : Upright
        The axis that is up in the first view of the surface.
    note : str
        A sentence under the title.

    Raises
    ------
    MeshError
        Nothing was mapped.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.page import page_html
    >>> from conformal_uv.samples import mask
    >>> page = page_html(cuv.disk_map(*mask(500)), "A mask")
    >>> page.startswith("<!doctype html>"), "<title>A mask" in page, "http://" in page.split("<script")[0]
    (True, True, False)
    """
    mapped = result if isinstance(result, MappedMesh) else mapped_mesh(result)
    model = page_model(mapped, title, upright)
    about = {**model.about, "arrays": [array.header() for array in model.arrays]}
    filled = {
        "title": html.escape(title),
        "note": html.escape(note),
        "version": html.escape(__version__),
        "map": html.escape(_map_name(model)),
        "style": _asset("page.css"),
        "about": json.dumps(about).replace("<", "\\u003c"),
        "mesh": _compressed(model),
        "program": _asset("page.js").replace("</script", "<\\/script"),
    }
    return PLACE.sub(lambda found: filled[found[1]], _asset("page.html"))


def _map_name(model: PageModel) -> str:
    names = {
        "disk": "the unit disk",
        "free": "the plane",
        "rectangle": "a rectangle",
        "sphere": "the unit sphere",
        "charts": "the texture square",
    }
    return names[model.about["shape"]]


def _compressed(model: PageModel) -> str:
    """All arrays' bytes, one after another, by zlib and in base 64."""
    return base64.b64encode(zlib.compress(b"".join(array.data for array in model.arrays), LEVEL)).decode()


def _asset(name: str) -> str:
    return (ASSETS / name).read_text("utf-8")

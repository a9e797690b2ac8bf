"""One file of the script: load, run a filter script, map, save."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from conformal_uv import FileFormatError
from conformal_uv.console.stages import Stages
from conformal_uv.console.summary import unwrapped_summary
from conformal_uv.options import Shape

from .checker import write_checker
from .library import pymeshlab
from .saving import check_texture_linked, save_textured_mesh
from .texcoord_map import map_current_mesh

__all__ = ["CHECKER", "Conversion", "check_filter_script", "convert"]

CHECKER = "checker"


@dataclass(frozen=True)
class Conversion:
    """What is done with every file; `options` as `texcoord_map.map_current_mesh` takes them."""

    texture: str | None = None
    filter_script: Path | None = None
    options: dict[str, Any] = field(default_factory=dict)
    shape: Shape = Shape.DISK


def convert(source: Path, target: Path, conversion: Conversion, stages: Stages) -> dict[str, Any]:
    """Map one file into another; the numbers as of ``conformal-uv disk``.

    Raises
    ------
    pymeshlab.PyMeshLabException, ConformalUVError, OSError
        Nothing was written.
    """
    stages("read", 0.0)
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(source))
    if ms.mesh_number() > 1:
        ms.generate_by_merging_visible_meshes()
    if conversion.filter_script is not None:
        stages("filter script", 0.0)
        ms.load_filter_script(str(conversion.filter_script))
        ms.apply_filter_script()
    with tempfile.TemporaryDirectory() as folder:
        texture = conversion.texture
        if texture == CHECKER:
            texture = os.path.join(folder, f"{target.stem}_checker.png")
            write_checker(texture)
        if texture is None:
            check_texture_linked(ms.current_mesh(), target)
        mapped = map_current_mesh(conversion.shape, ms, texture=texture, callback=stages, **conversion.options)
        stages("distortion", 0.0)
        summary = unwrapped_summary(mapped.result, str(source), str(target), stages.seconds)
        stages("write", 0.0)
        home = (source if conversion.texture is None else Path(texture or "")).resolve().parent
        save_textured_mesh(ms, target, keep_images=home == target.resolve().parent)
    summary["filter"] = mapped.numbers
    return summary


def check_filter_script(path: Path) -> None:
    """Raise FileFormatError on what is no filter script; pymeshlab would silently apply nothing."""
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        raise FileFormatError(f"{path}: can not be read: {error.strerror or error}") from error
    except ElementTree.ParseError as error:
        raise FileFormatError(f"{path}: not a MeshLab filter script: {error}") from error
    if root.tag != "FilterScript" or not len(root):
        raise FileFormatError(f"{path}: not a MeshLab filter script: no filters in it")

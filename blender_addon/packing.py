"""Islands packed into one square by conformal_uv, as the panel's options say."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import PolygonMesh, pack_islands, pack_together
from conformal_uv.options import MarginMethod, PackRotation, PackShape, PlaceOptions

from .edit_mode import object_mode, target_objects
from .mesh_reading import read_mesh, read_uv, selected_uvs
from .mesh_writing import write_uv
from .properties import Options, PackOptions
from .tasks import Task


def placed(tasks: list[Task], options: Options) -> list[NDArray[np.float64]]:
    """UVs (k, 2) of every task's corners; the islands of all of them in one square, one alone fills it.

    Islands that are held by their pins stay where they are.
    """
    alone = sum(int((task.written & ~task.held).sum()) for task in tasks) == 1
    how = {**pack_call(options), **({"margin": 0.0} if alone else {})}
    return pack_together([task.solved for task in tasks], [task.written for task in tasks], **how)


def pack_call(options: Options | PackOptions) -> dict[str, Any]:
    """Keywords of the library's packers."""
    return {
        "margin": round(options.margin, 6),  # as it was typed; the property is of single precision
        "margin_method": MarginMethod[options.margin_method],
        "image_size": options.image_size,
        "pack_rotation": PackRotation[options.pack_rotation],
        "pack_shape": PackShape[options.pack_shape],
        "keep_scale": options.keep_scale,
        "tile": options.tile,
    }


def tile_corner(options: Options | PackOptions) -> NDArray[np.float64]:
    """Lower left corner of the tile, (2,), all options of packing being checked.

    Raises
    ------
    conformal_uv.OptionError
    """
    corner = PlaceOptions(**pack_call(options)).corner
    return np.array([corner.real, corner.imag])


def pack_objects(context: bpy.types.Context, options: PackOptions, *, average_scale: bool, only_selected: bool) -> int:
    """Pack the islands of the active UV maps of edited or selected objects together; how many faces have them.

    Raises
    ------
    conformal_uv.OptionError
    """
    objects = [ob for ob in target_objects(context) if ob.data.uv_layers.active is not None]
    edited = context.mode == "EDIT_MESH"
    with object_mode(context):
        objects = [ob for ob in objects if len(ob.data.polygons) and ob.data.library is None]
        read = [read_mesh(ob.data, ob.data.uv_layers.active.name) for ob in objects]
        uvs = [read_uv(ob.data, ob.data.uv_layers.active.name) for ob in objects]
        chosen = [arrays.selected & ~arrays.hidden if edited else ~arrays.hidden for arrays in read]
        if only_selected and edited:
            for ob, arrays, faces in zip(objects, read, chosen, strict=True):
                faces &= np.logical_and.reduceat(selected_uvs(ob.data), arrays.starts[:-1])
        count = sum(int(faces.sum()) for faces in chosen)
        if not count:
            return 0
        meshes = [
            PolygonMesh(a.V.astype(np.float64), a.corners.astype(np.int64), a.starts.astype(np.int64)) for a in read
        ]
        packed = pack_islands(meshes, uvs, chosen, average_scale=average_scale, **pack_call(options))
        for ob, arrays, faces, uv in zip(objects, read, chosen, packed, strict=True):
            write_uv(ob.data, ob.data.uv_layers.active.name, uv, np.repeat(faces, np.diff(arrays.starts)))
    return count

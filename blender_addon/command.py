"""`blender --command conformal_uv IN.blend -o OUT.blend`: meshes of a file unwrapped without a window."""

import argparse
import json
import math
import sys
from pathlib import Path

import bpy

from .choices import (
    CENTERS,
    CLOSED,
    CORNER_CHOICES,
    MARGIN_METHODS,
    METHODS,
    PACK_ROTATIONS,
    PACK_SHAPES,
    PLACES,
    SHAPES,
    UPRIGHT,
)
from .libraries import missing_library
from .properties import DEFAULTS, Options

NAME = "conformal_uv"
DONE, PARTLY, USAGE = 0, 1, 2  # exit codes

_handles = []


def run(argv):
    """Read the arguments, unwrap, save.

    Returns
    -------
    int
        0: every island was unwrapped; 1: some were not, or a file can not be used; 2: wrong usage.
    """
    try:
        arguments = parser().parse_args(argv)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else USAGE
    why = missing_library() or _misplaced(arguments)
    if why:
        return _failed(why)
    try:
        bpy.ops.wm.open_mainfile(filepath=str(Path(arguments.input).resolve()))
    except RuntimeError as error:
        return _failed(f"{arguments.input}: {error}")
    missing = [name for name in arguments.collection or () if name not in bpy.data.collections]
    if missing:
        return _failed(f"{arguments.input} has no collection named {', '.join(missing)}")
    objects, unknown = _objects(arguments.object, arguments.collection)
    if unknown:
        return _failed(f"{arguments.input} has no mesh object named {', '.join(unknown)}")
    if not objects:
        return _failed(f"{arguments.input} has no mesh object{' in these collections' if arguments.collection else ''}")
    return _unwrap_and_save(arguments, objects)


def parser():
    """The command's arguments."""
    given = argparse.ArgumentParser(
        prog=f"blender --command {NAME}",
        description="Unwrap the meshes of a .blend file, keeping angles.",
        epilog="Exit code 0: every island was unwrapped; 1: some were not, or a file can not be used; 2: wrong usage.",
    )
    given.add_argument("input", metavar="IN.blend")
    given.add_argument("-o", "--output", metavar="OUT.blend", required=True)
    given.add_argument(
        "--object", action="append", metavar="NAME", help="only this object; may be given again (default: every mesh)"
    )
    given.add_argument(
        "--collection",
        action="append",
        metavar="NAME",
        help="only objects in this collection, or in those inside it; may be given again",
    )
    given.add_argument("--json", metavar="REPORT", help="write the numbers to this file")
    for name, items, default in (
        ("shape", SHAPES, DEFAULTS.shape),
        ("method", METHODS, DEFAULTS.method),
        ("closed", CLOSED, DEFAULTS.closed),
        ("place", PLACES, DEFAULTS.place),
        ("center", CENTERS, DEFAULTS.center),
        ("corner_choice", CORNER_CHOICES, DEFAULTS.corner_choice),
        ("upright", UPRIGHT, DEFAULTS.upright),
        ("margin_method", MARGIN_METHODS, DEFAULTS.margin_method),
        ("pack_rotation", PACK_ROTATIONS, DEFAULTS.pack_rotation),
        ("pack_shape", PACK_SHAPES, DEFAULTS.pack_shape),
    ):
        names = [_spelled(identifier) for identifier, _, _ in items]
        given.add_argument(f"--{_spelled(name)}", choices=names, default=_spelled(default))
    given.add_argument("--rotation", type=float, default=0.0, metavar="DEGREES")
    given.add_argument("--margin", type=float, default=DEFAULTS.margin)
    given.add_argument("--image-size", type=int, default=DEFAULTS.image_size, metavar="PIXELS")
    given.add_argument("--keep-scale", action="store_true", help="islands have the size of their surfaces")
    given.add_argument("--tile", type=int, default=DEFAULTS.tile, help="UDIM tile to pack into")
    given.add_argument("--uv-layer", default=DEFAULTS.uv_layer, metavar="NAME", help="default: the active one")
    given.add_argument("--pins", action="store_true", help="pinned UVs on an island's boundary are its pins or corners")
    given.add_argument("--refine", action="store_true", help="the last percents of angle error, for --shape free")
    given.add_argument("--subsurf", action="store_true", help="map the subdivided surface")
    given.add_argument("--selected", action="store_true", help="only faces that are selected in the file")
    given.add_argument("--no-fill-holes", action="store_true")
    given.add_argument("--no-repair", action="store_true")
    return given


def forget_work():
    """Drop factorizations that are kept for the redo panel."""
    kept_work = sys.modules.get(f"{__package__}.kept_work")
    if kept_work is not None:
        kept_work.KEPT.keep_only(set())
    spheres = sys.modules.get(f"{__package__}.spheres")
    if spheres is not None:
        spheres.forget()


def _objects(names, collections):
    """Objects to unwrap, those that share a mesh once, and names that no mesh object has."""
    meshes = {ob.name: ob for ob in bpy.data.objects if ob.type == "MESH"}
    inside = {ob.name for name in collections or () for ob in bpy.data.collections[name].all_objects}
    everything = names is None and collections is None
    wanted = [*(names or ()), *(name for name in meshes if everything or name in inside)]
    unique = {}
    for name in wanted:
        if name in meshes:
            unique.setdefault(meshes[name].data, meshes[name])
    return list(unique.values()), [name for name in wanted if name not in meshes]


def _unwrap_and_save(arguments, objects):
    from conformal_uv import ConformalUVError, OptionError
    from conformal_uv.files import replaced_file

    from .unwrap_objects import unwrap_objects

    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        result = unwrap_objects(bpy.context, objects, _options(arguments))
    except OptionError as error:
        return _failed(str(error), USAGE)
    _tell(result.message)
    for remark in result.remarks:
        _tell(remark)
    failures = []
    if result.unwrapped:
        try:
            bpy.ops.wm.save_as_mainfile(filepath=str(Path(arguments.output).resolve()))
        except RuntimeError as error:
            failures.append(f"{arguments.output}: {error}")
    if arguments.json:
        report = {"input": arguments.input, "output": arguments.output, **result.as_dict()}
        try:
            with replaced_file(arguments.json) as out:
                out.write(f"{json.dumps(report, indent=2)}\n".encode())
        except (ConformalUVError, OSError) as error:
            failures.append(str(error))
    if failures:
        return _failed("; ".join(failures))
    return DONE if result.complete else PARTLY


def _misplaced(arguments):
    """Why an output can not be written, empty where all can."""
    from conformal_uv import ConformalUVError
    from conformal_uv.files import check_distinct, check_place, is_stream

    try:
        check_distinct(arguments.input, {"-o": arguments.output, "--json": arguments.json}, in_place="-o")
        if is_stream(arguments.output):
            return f"{arguments.output}: a .blend file can not be written there; give the name of a file"
        for place in (arguments.output, arguments.json):
            if place is not None:
                check_place(place)
    except ConformalUVError as error:
        return str(error)
    return ""


def _options(arguments):
    return Options(
        shape=_identifier(arguments.shape),
        method=_identifier(arguments.method),
        fill_holes=not arguments.no_fill_holes,
        use_subsurf_data=arguments.subsurf,
        use_pins=arguments.pins,
        corner_choice=_identifier(arguments.corner_choice),
        refine=arguments.refine,
        center=_identifier(arguments.center),
        upright=_identifier(arguments.upright),
        rotation=math.radians(arguments.rotation),
        repair=not arguments.no_repair,
        closed=_identifier(arguments.closed),
        place=_identifier(arguments.place),
        margin=arguments.margin,
        margin_method=_identifier(arguments.margin_method),
        image_size=arguments.image_size,
        pack_rotation=_identifier(arguments.pack_rotation),
        pack_shape=_identifier(arguments.pack_shape),
        keep_scale=arguments.keep_scale,
        tile=arguments.tile,
        faces="SELECTED" if arguments.selected else "ALL",
        uv_layer=arguments.uv_layer,
    )


def _spelled(identifier):
    return identifier.lower().replace("_", "-")


def _identifier(spelled):
    return spelled.upper().replace("-", "_")


def _tell(text):
    sys.stdout.write(f"{text}\n")


def _failed(text, code=PARTLY):
    sys.stderr.write(f"{NAME}: {text}\n")
    return code


def register():
    _handles.append(bpy.utils.register_cli_command(NAME, run))


def unregister():
    while _handles:
        bpy.utils.unregister_cli_command(_handles.pop())

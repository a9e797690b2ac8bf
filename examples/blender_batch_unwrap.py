"""Unwrap every mesh of many .blend files and save the results in another folder.

    blender --background --python examples/blender_batch_unwrap.py -- a.blend b.blend --folder unwrapped
    python examples/blender_batch_unwrap.py a.blend b.blend --folder unwrapped        # with pip's bpy

The extension must be installed; without it, the repository's own add-on is used. Exit code 0 when every mesh of every
file was unwrapped, 1 otherwise.
"""

import argparse
import sys
from pathlib import Path

import bpy


def enable():
    """Make bpy.ops.uv.conformal_unwrap available."""
    if hasattr(bpy.types, "UV_OT_conformal_unwrap"):
        return
    import addon_utils  # importable once bpy is

    if addon_utils.enable("bl_ext.user_default.conformal_uv", handle_error=lambda error: None) is None:
        sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
        import blender_addon

        blender_addon.register()


def unwrap_file(path, target, options):
    """Unwrap all meshes of one file; True where all of them could be. What goes wrong is told, and the next file read.

    The operator raises RuntimeError where nothing of a mesh could be unwrapped; of some islands its result tells.
    """
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path.resolve()))
    except RuntimeError as error:
        print(f"{path}: {error}", file=sys.stderr)
        return False
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    meshes = [ob for ob in bpy.context.view_layer.objects if ob.type == "MESH" and ob.data.polygons]
    addon = sys.modules[bpy.types.UV_OT_conformal_unwrap.__module__.rpartition(".")[0]]
    complete = True
    for ob in meshes:
        for other in bpy.context.view_layer.objects:
            other.select_set(other == ob)
        bpy.context.view_layer.objects.active = ob
        try:
            bpy.ops.uv.conformal_unwrap(faces="ALL", **options)
            why = "" if addon.last_result.last().complete else addon.last_result.last().message
        except RuntimeError as error:
            why = str(error)
        if why:
            complete = False
            print(f"{path}: {why}", file=sys.stderr)
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(target.resolve()))
    except RuntimeError as error:
        print(f"{target}: {error}", file=sys.stderr)
        return False
    print(f"{path} -> {target}: {len(meshes)} meshes")
    return complete


def main():
    after = sys.argv.index("--") + 1 if "--" in sys.argv else 1
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--shape", default="DISK", choices=("DISK", "FREE", "RECTANGLE"))
    parser.add_argument("--method", default="NEWTON", choices=("LINEAR", "NEWTON", "AUGMENTED_LAGRANGIAN"))
    parser.add_argument("--closed", default="REFUSE", choices=("REFUSE", "CUT"))
    arguments = parser.parse_args(sys.argv[after:])
    targets = [arguments.folder / path.name for path in arguments.files]
    if len({target.resolve() for target in targets} | {path.resolve() for path in arguments.files}) < 2 * len(targets):
        parser.error("results would replace each other or the files given; rename files, or give another folder")
    enable()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    options = {"shape": arguments.shape, "method": arguments.method, "closed": arguments.closed}
    done = [unwrap_file(path, target, options) for path, target in zip(arguments.files, targets, strict=True)]
    sys.exit(0 if all(done) else 1)


if __name__ == "__main__":
    main()

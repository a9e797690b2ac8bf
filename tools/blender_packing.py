"""Share of the square covered, and seconds, of our packer and of Blender's own, in one session of Blender.

    python -m tools.blender_packing [--islands 100 --islands 1000] [--picture PNG]

Suzanne, with the seams of its own UV map and subdivided up to twice, unwrapped with a free boundary; and stars,
rectangles and ellipses of many sizes at all angles. Both keep Blender's default margin.
"""

from __future__ import annotations

import argparse
import importlib
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

MARGIN = {"margin_method": "SCALED", "margin": 0.001}
OURS = {"any": "ANY", "axes": "AXES", "not turned": "NONE"}
THEIRS = {"Blender, any": {}, "Blender, not turned": {"rotate": False}}


def main() -> None:
    """Print a line for each mesh and packer."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--islands", type=int, action="append")
    parser.add_argument("--picture", help="draw the largest set, packed by both, into this file")
    arguments = parser.parse_args()
    importlib.import_module("bpy")
    importlib.import_module("blender_addon").register()
    drawn = {}
    for name, ob in meshes(arguments.islands or [100, 300, 1000]):
        before = uvs(ob)
        for packer in (*OURS, *THEIRS):
            ob.data.uv_layers.active.uv.foreach_set("vector", before.reshape(-1))
            seconds = packed(packer)
            drawn[packer] = uvs(ob)[triangles(ob)]
            print(f"{name:24s} {packer:22s} {area(drawn[packer]):6.3f} {seconds:7.2f} s", flush=True)
    if arguments.picture:
        draw({name: drawn[name] for name in ("any", "Blender, any")}, arguments.picture)


def meshes(islands: list[int]) -> Iterator[tuple[str, Any]]:
    """Names and objects, each the only one, selected."""
    import bpy

    for levels in (0, 1, 2):
        empty()
        bpy.ops.mesh.primitive_monkey_add()
        ob = bpy.context.view_layer.objects.active
        edit_all()
        bpy.ops.uv.seams_from_islands(mark_seams=True)
        bpy.ops.object.mode_set(mode="OBJECT")
        if levels:
            ob.modifiers.new("Subdivision", "SUBSURF").levels = levels
            bpy.ops.object.modifier_apply(modifier="Subdivision")
        bpy.ops.uv.conformal_unwrap(shape="FREE", closed="CUT")
        yield f"Suzanne, {len(ob.data.polygons)} faces", ob
    for count in islands:
        empty()
        yield f"{count} islands", atlas(count)


def atlas(count: int, sides: int = 24) -> Any:
    """An object of fans, an island each, shapes and sizes mixed."""
    import bpy

    rng, turn = np.random.default_rng(1), 2 * np.pi * np.arange(sides) / sides
    V, faces = [], []
    for number in range(count):
        z = (
            (1 + 0.45 * np.cos(rng.integers(2, 6) * turn + 1)) * np.exp(1j * turn),
            np.exp(1j * turn) / np.maximum(np.abs(np.cos(turn)), 1.5 * np.abs(np.sin(turn))),
            np.cos(turn) + 0.4j * np.sin(turn),
        )[number % 3]
        z = np.append(z, 0.0) * rng.lognormal(0.0, 0.5) * np.exp(2j * np.pi * rng.random()) + 20.0 * number
        first = number * (sides + 1)
        faces += [(first + k, first + (k + 1) % sides, first + sides) for k in range(sides)]
        V += np.column_stack((z.real, z.imag, 0.0 * z.real)).tolist()
    mesh = bpy.data.meshes.new("atlas")
    mesh.from_pydata(V, [], faces)
    mesh.uv_layers.new(name="UVMap")
    uv = 0.01 * np.array(V)[np.array(faces).reshape(-1), :2]
    mesh.uv_layers.active.uv.foreach_set("vector", uv.astype(np.float32).reshape(-1))
    ob = bpy.data.objects.new("atlas", mesh)
    bpy.context.scene.collection.objects.link(ob)
    bpy.context.view_layer.update()
    ob.select_set(True)
    bpy.context.view_layer.objects.active = ob
    return ob


def packed(packer: str) -> float:
    """Seconds of packing the selected object's islands, in Edit Mode."""
    import bpy

    edit_all()
    start = time.perf_counter()
    if packer in OURS:
        bpy.ops.uv.conformal_pack(pack_rotation=OURS[packer], **MARGIN)
    else:
        bpy.ops.uv.pack_islands(**THEIRS[packer], **MARGIN)
    seconds = time.perf_counter() - start
    bpy.ops.object.mode_set(mode="OBJECT")
    return seconds


def empty() -> None:
    """No objects any more; the file stays, and with it the window where there is one."""
    import bpy

    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for mesh in list(bpy.data.meshes):
        bpy.data.meshes.remove(mesh)


def edit_all() -> None:
    """Edit Mode, all faces and UVs selected."""
    import bpy

    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")


def uvs(ob: Any) -> NDArray[np.float32]:
    """Of every corner."""
    values = np.empty((len(ob.data.loops), 2), dtype=np.float32)
    ob.data.uv_layers.active.uv.foreach_get("vector", values.reshape(-1))
    return values


def triangles(ob: Any) -> NDArray[np.int64]:
    """Corners of triangles, (m, 3)."""
    ob.data.calc_loop_triangles()
    return np.array([triangle.loops[:] for triangle in ob.data.loop_triangles])


def area(P: NDArray[np.float32]) -> float:
    """Of triangles (m, 3, 2)."""
    return 0.5 * float(np.abs(np.linalg.det((P[:, 1:] - P[:, :1]).astype(np.float64))).sum())


def draw(layouts: dict[str, NDArray[np.float32]], path: str) -> None:
    """Layouts side by side."""
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6 * len(layouts), 6.3), layout="constrained")
    for axes, (name, P) in zip(figure.subplots(1, len(layouts)), layouts.items(), strict=True):
        axes.add_collection(PolyCollection(P, facecolor="#3b528b", edgecolor="#3b528b", linewidth=0.1))
        axes.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xticks=[], yticks=[], title=f"{name}: {area(P):.2f}")
    figure.savefig(path, dpi=80)


if __name__ == "__main__":
    main()

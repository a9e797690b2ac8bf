"""Seconds and angle error of the operator beside Blender's own unwrap, in one process of Blender's Python.

    python -m tools.blender_speed [--vertices 50000 --vertices 200000] [--repeat 3] [--without-blender]

Run it with a Python that has bpy and the extension's libraries. Best of the repeats; Blender's own runs once. The last
column is how many times as long as the free boundary each takes in this run.
"""

from __future__ import annotations

import argparse
import importlib
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

OURS = (
    {"shape": "FREE"},
    {"shape": "FREE", "refine": True},
    {"shape": "DISK", "method": "LINEAR"},
    {"shape": "DISK", "method": "NEWTON"},
    {"shape": "RECTANGLE"},
)
THEIRS = ("CONFORMAL", "ANGLE_BASED")


def main() -> None:
    """Print a table for each size."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vertices", type=int, action="append", help="may be given again")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--without-blender", action="store_true")
    arguments = parser.parse_args()
    import bpy

    addon = importlib.import_module("blender_addon")
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    addon.register()
    for vertices in arguments.vertices or (50_000, 200_000):
        rows = [(_named(how), *_best(addon, vertices, how, arguments.repeat)) for how in OURS]
        if not arguments.without_blender:
            rows += [(f"Blender's {method}", *blenders_own(vertices, method)) for method in THEIRS]
        print(f"{vertices} vertices")
        for name, seconds, error in rows:
            print(f"{name:32s} {seconds:8.2f} s {error:9.4f} degrees {seconds / rows[0][1]:8.2f} x")
    seconds = min(transfer_seconds(addon) for _ in range(arguments.repeat))
    print(f"{'1M triangles read and written':32s} {seconds:8.2f} s")


def _named(how: dict[str, Any]) -> str:
    return " ".join(str(value) if value is not True else name for name, value in how.items())


def _best(addon: Any, vertices: int, how: dict[str, Any], repeat: int) -> tuple[float, float]:
    return min(operator(addon, vertices, how) for _ in range(repeat))


def operator(addon: Any, vertices: int, how: dict[str, Any]) -> tuple[float, float]:
    """Seconds from call to written UVs, in Object Mode, with nothing kept; and the mean angle error as stored."""
    import bpy

    ob = bumpy_grid(vertices)
    addon.forget()
    start = time.perf_counter()
    bpy.ops.uv.conformal_unwrap(**how)
    return time.perf_counter() - start, mean_angle_error(ob)


def blenders_own(vertices: int, method: str) -> tuple[float, float]:
    """The same of Blender's own, in Edit Mode, where it works."""
    import bpy

    ob = bumpy_grid(vertices)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    start = time.perf_counter()
    bpy.ops.uv.unwrap(method=method)
    seconds = time.perf_counter() - start
    bpy.ops.object.mode_set(mode="OBJECT")
    return seconds, mean_angle_error(ob)


def mean_angle_error(ob: Any) -> float:
    """Of the active UV map, degrees; the mesh is one of triangles, its UVs in one piece."""
    from conformal_uv import distortion

    mesh = ob.data
    uv, corner = np.empty((len(mesh.loops), 2), dtype=np.float32), np.empty(len(mesh.loops), dtype=np.int32)
    V = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.uv_layers.active.uv.foreach_get("vector", uv.reshape(-1))
    mesh.loops.foreach_get("vertex_index", corner)
    mesh.vertices.foreach_get("co", V.reshape(-1))
    at_vertex = np.zeros((len(V), 2))
    at_vertex[corner] = uv
    return float(distortion(V.astype(np.float64), corner.reshape(-1, 3).astype(np.int64), at_vertex).angle_mean)


def transfer_seconds(addon: Any) -> float:
    """Reading the arrays of a million triangles and writing their UVs."""
    reading, writing = (importlib.import_module(f"{addon.__name__}.mesh_{name}") for name in ("reading", "writing"))
    mesh = bumpy_grid(708 * 708).data
    uv = np.random.default_rng(0).random((len(mesh.loops), 2))
    start = time.perf_counter()
    arrays = reading.read_mesh(mesh, "UVMap")
    writing.write_uv(mesh, "UVMap", uv, np.ones(len(arrays.corners), dtype=bool))
    return time.perf_counter() - start


def bumpy_grid(vertices: int) -> Any:
    """A new object of about so many vertices, triangles, the only one selected."""
    import bpy

    V, F = grid_arrays(round(vertices**0.5))
    mesh = bpy.data.meshes.new("bumpy")
    mesh.vertices.add(len(V))
    mesh.vertices.foreach_set("co", V.astype(np.float32).reshape(-1))
    mesh.loops.add(F.size)
    mesh.loops.foreach_set("vertex_index", F.astype(np.int32).reshape(-1))
    mesh.polygons.add(len(F))
    mesh.polygons.foreach_set("loop_start", np.arange(0, F.size, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.uv_layers.new(name="UVMap")
    for other in list(bpy.data.objects):
        bpy.data.objects.remove(other)
    ob = bpy.data.objects.new("bumpy", mesh)
    bpy.context.scene.collection.objects.link(ob)
    bpy.context.view_layer.update()
    ob.select_set(True)
    bpy.context.view_layer.objects.active = ob
    return ob


def grid_arrays(n: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices and triangles of n x n points over a disk, with bumps."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, n), np.linspace(-1.0, 1.0, n))
    x, y = x * np.sqrt(1.0 - 0.5 * y**2), y * np.sqrt(1.0 - 0.5 * x**2)
    z = 0.15 * np.sin(5.0 * x) * np.cos(4.0 * y) + 0.05 * np.sin(17.0 * x + 9.0 * y)
    k = np.arange(n * n).reshape(n, n)
    a, b, c, d = (q.reshape(-1) for q in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    F = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    return np.column_stack((x.reshape(-1), y.reshape(-1), z.reshape(-1))), F


if __name__ == "__main__":
    main()

"""Seconds of the operator beside Blender's own conformal unwrap, in one process of Blender's Python.

    python -m tools.blender_speed [--vertices 200000] [--repeat 3] [--without-blender]

Run it with a Python that has bpy and the extension's libraries. Best of the repeats; Blender's own runs once.
"""

from __future__ import annotations

import argparse
import importlib
import time

import numpy as np
from numpy.typing import NDArray


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vertices", type=int, default=200_000)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--without-blender", action="store_true")
    arguments = parser.parse_args()
    import bpy

    addon = importlib.import_module("blender_addon")
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    addon.register()
    rows = [
        (method, min(operator_seconds(addon, arguments.vertices, method) for _ in range(arguments.repeat)))
        for method in ("LINEAR", "NEWTON")
    ]
    if not arguments.without_blender:
        rows.append(("Blender's CONFORMAL", blender_seconds(arguments.vertices)))
    rows.append(("1M triangles read and written", min(transfer_seconds(addon) for _ in range(arguments.repeat))))
    for name, seconds in rows:
        print(f"{name:32s} {seconds:8.2f} s")


def operator_seconds(addon: object, vertices: int, method: str) -> float:
    """From call to written UVs, in Object Mode, with nothing kept."""
    import bpy

    bumpy_grid(vertices)
    addon.forget()
    start = time.perf_counter()
    bpy.ops.uv.conformal_unwrap(method=method)
    return time.perf_counter() - start


def blender_seconds(vertices: int) -> float:
    """Blender's own, in Edit Mode, where it works."""
    import bpy

    bumpy_grid(vertices)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    start = time.perf_counter()
    bpy.ops.uv.unwrap(method="CONFORMAL")
    seconds = time.perf_counter() - start
    bpy.ops.object.mode_set(mode="OBJECT")
    return seconds


def transfer_seconds(addon: object) -> float:
    """Reading the arrays of a million triangles and writing their UVs."""
    mesh_io = importlib.import_module(f"{addon.__name__}.mesh_io")
    mesh = bumpy_grid(708 * 708).data
    uv = np.random.default_rng(0).random((len(mesh.loops), 2))
    start = time.perf_counter()
    arrays = mesh_io.read_mesh(mesh, "UVMap")
    mesh_io.write_uv(mesh, "UVMap", uv, np.ones(len(arrays.corners), dtype=bool))
    return time.perf_counter() - start


def bumpy_grid(vertices: int) -> object:
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

"""What tests/test_blender_extension.py runs inside Blender: install a zip, then use what was installed.

    python -S installed_extension.py PACKAGES install ZIP
    python -S installed_extension.py PACKAGES use FOLDER

PACKAGES is a folder of packages without those that the extension must bring; FOLDER is where it was installed.
"""

import sys
from importlib import import_module

sys.path.insert(0, sys.argv[1])
MODULE = "bl_ext.user_default.conformal_uv"


def install(path):
    import bpy

    done = bpy.ops.extensions.package_install_files(filepath=path, repo="user_default", enable_on_install=True)
    bpy.ops.wm.save_userpref()
    return done == {"FINISHED"}


def use(folder):
    import bpy
    import numpy as np

    addon_utils = import_module("addon_utils")  # importable once bpy is

    if addon_utils.enable(MODULE) is None or import_module(MODULE).__file__.startswith(folder) is False:
        return False
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=24, y_subdivisions=16)
    ob = bpy.context.object
    for vertex in ob.data.vertices:
        vertex.co.z = 0.2 * np.sin(4.0 * vertex.co.x + 1.0) * np.cos(3.0 * vertex.co.y)
    finished = bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    import rpack
    import scipy

    import conformal_uv as cuv

    brought = all(module.__file__.startswith(folder) for module in (cuv, scipy, rpack))
    V = np.array([tuple(vertex.co) for vertex in ob.data.vertices], dtype=np.float64)
    result = cuv.unwrap(V, [list(polygon.vertices) for polygon in ob.data.polygons], place="disk")
    uv = np.array([tuple(item.vector) for item in ob.data.uv_layers.active.uv])
    error = np.abs(uv - (0.5 + 0.5 * result.uv)).max()
    sys.stdout.write(f"finished {finished}, brought {brought}, error {error:.2g}, {result.charts[0].map.backend}\n")
    addon_utils.disable(MODULE)
    return finished and brought and error < 3e-7 and not hasattr(bpy.types, "UV_OT_conformal_unwrap")


if __name__ == "__main__":
    sys.exit(0 if {"install": install, "use": use}[sys.argv[2]](sys.argv[3]) else 1)

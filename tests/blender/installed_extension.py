"""What tests/test_blender_extension.py and tools.blender_matrix run inside Blender: install a zip, then use it.

    python -S installed_extension.py PACKAGES install ZIP
    python -S installed_extension.py PACKAGES use FOLDER

PACKAGES is a folder of packages without those that the extension must bring; FOLDER is where it was installed.
"""

import logging
import pickle
import sys
from importlib import import_module
from pathlib import Path

sys.path.insert(0, sys.argv[1])
MODULE = "bl_ext.user_default.conformal_uv"
OPTIONAL = {"dask", "distributed", "mpi4py", "petsc4py"}  # of what one process does not need


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
    import scipy

    cuv = import_module(f"{MODULE}.conformal_uv")
    brought = all(module.__file__.startswith(folder) for module in (cuv, scipy))
    alone = not any(name.partition(".")[0] == "conformal_uv" for name in sys.modules)
    V = np.array([tuple(vertex.co) for vertex in ob.data.vertices], dtype=np.float64)
    result = cuv.unwrap(V, [list(polygon.vertices) for polygon in ob.data.polygons], place="disk")
    uv = np.array([tuple(item.vector) for item in ob.data.uv_layers.active.uv])
    error = np.abs(uv - (0.5 + 0.5 * result.uv)).max()
    again = pickle.loads(pickle.dumps(result))
    kept = np.array_equal(again.uv, result.uv) and type(again) is cuv.Unwrapped
    names = [name for name in logging.root.manager.loggerDict if "conformal_uv" in name]
    logged = bool(names) and all(name.startswith(MODULE) for name in names)
    told = dict(finished=finished, brought=brought, alone=alone, kept=kept, logged=logged, whole=every_module(cuv))
    sys.stdout.write(f"{told}, error {error:.2g}, {result.charts[0].map.backend}\n")
    addon_utils.disable(MODULE)
    return all(told.values()) and error < 3e-7 and not hasattr(bpy.types, "UV_OT_conformal_unwrap")


def every_module(package):
    """Whether all that is carried can be imported, each of its names, and each module that needs nothing optional."""
    home = Path(package.__file__).parent
    for name in package.__all__:
        getattr(package, name)
    for path in home.rglob("*.py"):
        parts = path.relative_to(home).with_suffix("").parts
        try:
            import_module(".".join((package.__name__, *(part for part in parts if part != "__init__"))))
        except ModuleNotFoundError as error:
            if error.name not in OPTIONAL:
                raise
    return not any(name.partition(".")[0] == "conformal_uv" for name in sys.modules)


if __name__ == "__main__":
    sys.exit(0 if {"install": install, "use": use}[sys.argv[2]](sys.argv[3]) else 1)

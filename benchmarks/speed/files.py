"""A mesh as a file, made in a process of its own: ``python -m benchmarks.speed.files MESH OUT``, OUT .obj or .ply.

OBJ with nine digits; binary PLY as scanners write it, single precision and a list for each face.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["write_obj", "write_ply"]

Array = NDArray[Any]


def write_obj(path: Path, V: Array, F: Array) -> None:
    """Positions and faces, nothing else."""
    with path.open("w") as file:
        file.writelines(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in V.tolist())
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in (F + 1).tolist())


def write_ply(path: Path, V: Array, F: Array) -> None:
    """Little endian."""
    faces = np.empty(len(F), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, F
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(V)}\n"
    header += "".join(f"property float {axis}\n" for axis in "xyz")
    header += f"element face {len(F)}\nproperty list uchar int vertex_indices\nend_header\n"
    path.write_bytes(header.encode() + V.astype("<f4").tobytes() + faces.tobytes())


if __name__ == "__main__":
    out = Path(sys.argv[2])
    with np.load(sys.argv[1]) as arrays:
        {".obj": write_obj, ".ply": write_ply}[out.suffix](out, arrays["V"], arrays["F"])

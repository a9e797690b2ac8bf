"""Files in, files out, with progress: what a script of one's own looks like."""

import sys
import tempfile
from pathlib import Path

import numpy as np

import conformal_uv as cuv
from conformal_uv.files import MeshFile, read_mesh, write_mesh
from conformal_uv.samples import mask

folder = Path(tempfile.mkdtemp()) if len(sys.argv) < 2 else Path(sys.argv[1])
np.savez(folder / "scan.npz", **dict(zip("VF", mask(3000), strict=True)))


def progress(stage: str, fraction: float) -> bool:
    print(f"{stage} {fraction:.0%}", end="\r")
    return True  # False would cancel


mesh: MeshFile = read_mesh(folder / "scan.npz")
try:
    result = cuv.unwrap(None, mesh.mesh, callback=progress)
except cuv.ConformalUVError as error:
    sys.exit(f"{type(error).__name__}: {error}")
write_mesh(folder / "scan.obj", mesh, corner_uv=result.uv)
print(f"\n{result.summary} -> {folder / 'scan.obj'}")
assert len(read_mesh(folder / "scan.obj").corner_uv) == len(result.uv)

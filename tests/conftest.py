"""Where tests find the meshes that the project does not ship."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from conformal_uv.files import read_mesh
from conformal_uv.mesh.triangulate import triangulate

REPOSITORY = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def data_folder() -> Path:
    """CONFORMAL_UV_DATA, else ../shared/data beside the repository; the test is skipped without it."""
    folder = Path(os.environ.get("CONFORMAL_UV_DATA") or REPOSITORY.parent / "shared" / "data")
    if not folder.is_dir():
        pytest.skip("no mesh data: set CONFORMAL_UV_DATA to a folder with choi_report/, scans/, meshes/")
    return folder


@pytest.fixture(scope="session")
def load_scan(data_folder: Path):
    """A function from a path within the data folder to (V, F), unreferenced vertices left out."""

    def load(name: str) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        mesh = read_mesh(data_folder / name).mesh
        F, _, _ = triangulate(mesh)
        used, F = np.unique(F, return_inverse=True)
        return mesh.V[used], F.reshape(-1, 3)

    return load

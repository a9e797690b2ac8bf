"""What tests put into Dask's workers; a module of its own, for workers load it by its name."""

from __future__ import annotations

import os
import signal
from pathlib import Path
from typing import Any

from distributed.diagnostics.plugin import WorkerPlugin

from conformal_uv.batches import worked
from conformal_uv.files import MeshFile, read_mesh


class Deadly(WorkerPlugin):
    """Workers die of files whose name has "deadly" in it, and write a line beside it before."""

    def setup(self, worker: Any) -> None:
        worked.read_mesh = _deadly

    def teardown(self, worker: Any) -> None:
        worked.read_mesh = read_mesh


def _deadly(path: str) -> MeshFile:
    if "deadly" in Path(path).name:
        with open(f"{path}.deaths", "a") as deaths:
            deaths.write("died\n")
        os.kill(os.getpid(), signal.SIGKILL)
    return read_mesh(path)

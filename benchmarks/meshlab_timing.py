"""What the pymeshlab filter costs above the map itself: a generated disk of many vertices.

    python benchmarks/meshlab_timing.py [--vertices 500000] [--repeat 3]

Exit code 1 when the filter takes more than 1.5 times `conformal_uv.disk_map` plus one second.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pymeshlab

import conformal_uv
from conformal_uv.samples import terrain
from meshlab_filter import compute_texcoord_parametrization_conformal_disk
from meshlab_filter.current_mesh import read_current_mesh
from meshlab_filter.quality import map_numbers
from meshlab_filter.texcoords import new_texcoords, write_texcoords


def mesh_set(V: np.ndarray, F: np.ndarray) -> Any:
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(V, F))
    return ms


def seconds(work: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def once(V: np.ndarray, F: np.ndarray) -> dict[str, float]:
    """Seconds of everything, one after the other on one mesh."""
    told: dict[str, float] = {}
    told["disk_map"], _ = seconds(lambda: conformal_uv.disk_map(V, F))
    ms = mesh_set(V, F)
    told["filter"], _ = seconds(lambda: compute_texcoord_parametrization_conformal_disk(ms))
    ms = mesh_set(V, F)
    told["of it copying in"], source = seconds(lambda: read_current_mesh(ms))
    told["of it unwrap"], result = seconds(lambda: conformal_uv.unwrap(None, source.polygons))

    def written() -> None:
        texcoords = new_texcoords(source, result.uv, result.mapped)
        map_numbers(source, result, texcoords)
        write_texcoords(ms, source.mesh, texcoords, None)

    told["of it numbers, copying out"], _ = seconds(written)
    return told


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vertices", type=int, default=500_000)
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    V, F = terrain(options.vertices)
    runs = [once(V, F) for _ in range(options.repeat)]
    print(f"{len(V)} vertices, {len(F)} triangles; seconds, the best of {options.repeat}")
    best = {name: min(run[name] for run in runs) for name in runs[0]}
    for name, value in best.items():
        print(f"{name:>28} {value:8.2f}")
    allowed = 1.5 * best["disk_map"] + 1.0
    print(f"{'allowed':>28} {allowed:8.2f}")
    raise SystemExit(best["filter"] > allowed)


if __name__ == "__main__":
    main()

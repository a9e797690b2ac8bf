"""What the tests of distributed maps run under mpiexec: the cases named, their outcome as JSON on standard output."""

from __future__ import annotations

import gc
import json
import sys
import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import conformal_uv as cuv
from conformal_uv.distributed import distributed_disk_map
from conformal_uv.distributed.ranks import Ranks
from conformal_uv.samples import mask, terrain

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def rows(ranks: Ranks, array: NDArray[Any]) -> NDArray[Any]:
    """This rank's rows of an array."""
    n = len(array)
    return array[n * ranks.rank // ranks.size : n * (ranks.rank + 1) // ranks.size].copy()


def renumbered(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """Vertices and faces in no order."""
    rng = np.random.default_rng(3)
    at, faces = rng.permutation(len(V)), rng.permutation(len(F))
    number = np.argsort(at)
    return V[at], number[F[faces]]


def difference(ranks: Ranks, V: NDArray[np.float64], F: NDArray[np.int64], **options: Any) -> dict[str, Any]:
    """Of the distributed map from the serial one."""
    shared = {name: value for name, value in options.items() if name not in ("solver", "upright")}
    serial = cuv.disk_map(V, F, laplacian="cotan", repair="never", **({"method": "linear"} | shared))
    found = distributed_disk_map(rows(ranks, V), rows(ranks, F), comm=ranks.comm, **options)
    mine = serial.uv[found.first : found.first + len(found.uv)]
    numbers = found.numbers
    return {
        "difference": ranks.most(float(np.abs(found.uv - mine).max(initial=0.0))),
        "boundary": found.boundary.tolist() == serial.boundary.tolist(),
        "flipped": found.flipped.tolist() == serial.flipped.tolist(),
        "energy": abs(numbers.conformal_energy - serial.conformal_energy),
        "angle": abs(numbers.angle_mean - serial.distortion.angle_mean),
        "angle_max": abs(numbers.angle_max - serial.distortion.angle_max),
        "converged": found.converged,
        "gradient": found.history[-1].gradient_norm if found.history else 0.0,
        "steps": max(found.steps),
    }


def same_maps(ranks: Ranks) -> dict[str, Any]:
    """Methods, numberings, placements."""
    flat, round_ = terrain(2500, seed=1), mask(1500, seed=2)
    loop = cuv.Surface.from_arrays(*round_).require_disk()
    third = len(loop) // 3
    inner = int(np.setdiff1d(np.arange(len(round_[0])), loop)[700])
    wheel = np.exp(2j * np.pi * np.arange(6) / 6)
    hexagon = np.concatenate((np.column_stack((wheel.real, wheel.imag, 0 * wheel.real)), [[0.1, 0.0, 0.0]]))
    spokes = np.array([[k, (k + 1) % 6, 6] for k in range(6)])
    return {
        "terrain linear": difference(ranks, *flat),
        "terrain newton": difference(ranks, *flat, method="newton"),
        "mask newton dirichlet": difference(ranks, *round_, method="newton", objective="dirichlet"),
        "renumbered": difference(ranks, *renumbered(*flat)),
        "center": difference(ranks, *round_, center=inner),
        "boundary vertex": difference(ranks, *round_, boundary_vertex=int(loop[5])),
        "pins": difference(ranks, *round_, pins=(int(loop[3]), int(loop[third]), int(loop[2 * third]))),
        "hexagon": difference(ranks, hexagon, spokes),
        "gamg": difference(ranks, *flat, solver="gamg"),
        "gamg newton": difference(ranks, *flat, solver="gamg", method="newton"),
        "hypre": difference(ranks, *flat, solver="hypre"),
        "mumps": difference(ranks, *flat, solver="mumps"),
    }


def broken_meshes() -> dict[str, Mesh]:
    """A grid with one fault each; faults lie between ranks, or on the last."""
    V, F = terrain(400, seed=4)
    V, F = np.array(V, dtype=np.float64), np.array(F, dtype=np.int64)
    n = len(V)
    loop = set(cuv.Surface.from_arrays(V, F).require_disk().tolist())
    inner = np.array([not loop & set(face) for face in F.tolist()])
    middle = int(np.flatnonzero(inner)[inner.sum() // 2])
    last = int(np.flatnonzero(inner)[-1])
    nan, turned, doubled, range_, twice = V.copy(), F.copy(), F.copy(), F.copy(), F.copy()
    nan[n - 3, 1] = np.nan
    turned[[middle, last]] = turned[[middle, last]][:, ::-1]
    doubled = np.concatenate((F, F[[3]][:, [1, 2, 0]]))
    range_[last, 0], twice[last, 1] = n + 5, twice[last, 0]
    a, b = F[middle][:2]
    fin = np.concatenate((F, [[a, b, n]])), np.concatenate((V, V[[a]] + [0.0, 0.0, 1.0]))
    ring = 10
    turn = 2 * np.pi * np.arange(ring) / ring
    band = np.array([[np.cos(t) * r, np.sin(t) * r, z] for t in turn for r, z in ((1.0, 0.0), (1.2, 0.2))])
    k = np.arange(ring)
    quads = np.column_stack((2 * k, 2 * ((k + 1) % ring), 2 * ((k + 1) % ring) + 1, 2 * k + 1))
    annulus = np.concatenate((quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]))
    twisted = annulus.copy()
    for face in (ring - 1, 2 * ring - 1):
        twisted[face] = [{0: 1, 1: 0}.get(v, v) for v in twisted[face]]
    sphere = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    tetrahedron = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    touching = np.concatenate((F, np.where(F == 0, n - 1, F + n - 1)))  # a corner of one grid is one of the other
    return {
        "nan": (nan, F),
        "outside": (V, range_),
        "repeated": (V, twice),
        "one-based": (V, F + 1),
        "negative": (V, F - 1),
        "unreferenced": (np.concatenate((V, [[0.0, 0.0, 9.0]])), F),
        "doubled": (V, doubled),
        "three faces": (fin[1], fin[0]),
        "turned": (V, turned),
        "one-sided": (band, twisted),
        "two loops": (band, annulus),
        "closed": (tetrahedron, sphere),
        "two pieces": (np.concatenate((V, V + 5.0)), np.concatenate((F, F + n))),
        "touching": (np.concatenate((V, V[1:] + 5.0)), touching),
        "hole": (V, np.delete(F, middle, axis=0)),
        "pinched spheres": (
            np.concatenate((tetrahedron, tetrahedron[1:] + 2.0)),
            np.concatenate((sphere, np.where(sphere == 0, 0, sphere + 3))),
        ),
        "handle": torus_with_a_hole(),
        "line": (np.outer(np.arange(7.0), [1.0, 2.0, 3.0]), np.array([[k, (k + 1) % 6, 6] for k in range(6)])),
        "no area": (flattened(V, F, middle), F),
        "empty": (V, F[:0]),
        "four columns": (V, np.column_stack((F, F[:, 0]))),
        "text": (V.astype(str), F),
        "real indices": (V, F + 0.5),
    }


def flattened(V: NDArray[np.float64], F: NDArray[np.int64], face: int) -> NDArray[np.float64]:
    """Two corners of a face in one place."""
    out = V.copy()
    out[F[face][1]] = out[F[face][0]]
    return out


def torus_with_a_hole() -> Mesh:
    """One loop, one handle."""
    a, b = 8, 6
    i, j = (x.reshape(-1) for x in np.meshgrid(np.arange(a), np.arange(b), indexing="ij"))
    s, t = 2 * np.pi * i / a, 2 * np.pi * j / b
    V = np.column_stack(((3 + np.cos(t)) * np.cos(s), (3 + np.cos(t)) * np.sin(s), np.sin(t)))

    def at(x: NDArray[np.int64], y: NDArray[np.int64]) -> NDArray[np.int64]:
        return x % a * b + y % b

    quads = np.column_stack((at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return V, np.concatenate((quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]))[:-1]


def told(work: Callable[[], object]) -> tuple[str, str, list[int]] | None:
    """The error that work ends in."""
    try:
        work()
    except cuv.ConformalUVError as error:
        return type(error).__name__, str(error), list(error.indices)
    return None


def refusals(ranks: Ranks) -> dict[str, Any]:
    """The errors of each rank, and the serial one."""
    out = {}
    for name, (V, F) in broken_meshes().items():
        serial = told(lambda V=V, F=F: cuv.disk_map(V, F, method="linear", laplacian="cotan"))
        each = ranks.each(told(lambda V=V, F=F: distributed_disk_map(rows(ranks, V), rows(ranks, F), comm=ranks.comm)))
        out[name] = {"serial": serial, "ranks": each}
    return out


def failures(ranks: Ranks) -> dict[str, Any]:
    """What only one rank meets is raised on all."""
    V, F = terrain(400, seed=4)
    last = ranks.rank == ranks.size - 1

    def mapped(callback: Any = None, **options: Any) -> Any:
        given = {"comm": ranks.comm, "callback": callback} | options
        return told(lambda: distributed_disk_map(rows(ranks, V), rows(ranks, F), **given))

    def out_of_memory(stage: str, fraction: float) -> None:
        if stage == "linear":
            raise MemoryError("not enough")

    def ill() -> str:
        try:
            mapped(out_of_memory if last else None)
        except MemoryError as error:
            return f"MemoryError {error}"
        return "nothing"

    return {
        "cancelled": ranks.each(mapped((lambda stage, fraction: stage != "placement") if last else None)),
        "option": ranks.each(mapped(method="linear" if not last else "lineal")),
        "vertex": ranks.each(mapped(center=10**6)),
        "delaunay": ranks.each(mapped(laplacian="intrinsic-delaunay")),
        "memory": ranks.each(ill()),
    }


def counted(ranks: Ranks) -> dict[str, Any]:
    """Sizes of the arrays that a rank holds, at each stage, and the peak, for so many vertices a rank."""
    per_rank = 12000
    V, F = terrain(per_rank * ranks.size, seed=5)
    n, m = len(V), len(F)
    V, F = rows(ranks, V), rows(ranks, F)
    gc.collect()
    tracemalloc.start()
    full = {count * columns * size for count in (n, m) for columns in (1, 2, 3) for size in (1, 2, 4, 8, 16)}
    seen: list[int] = []

    def look(stage: str, fraction: float) -> None:
        for trace in tracemalloc.take_snapshot().traces:
            if trace.size in full or trace.size - 16 in full:
                seen.append(trace.size)

    distributed_disk_map(V, F, comm=ranks.comm, callback=look)
    peak = tracemalloc.get_traced_memory()[1]
    return {"per_vertex": max(ranks.each(peak)) / (n / ranks.size), "full": sum(map(len, ranks.each(seen))), "n": n}


CASES: dict[str, Callable[[Ranks], dict[str, Any]]] = {
    "same_maps": same_maps,
    "refusals": refusals,
    "failures": failures,
    "counted": counted,
}

if __name__ == "__main__":
    together = Ranks()
    outcome = {name: CASES[name](together) for name in sys.argv[1:]}
    if together.rank == 0:
        print(json.dumps(outcome))

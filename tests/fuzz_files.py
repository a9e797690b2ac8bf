"""Mutated mesh files of every format, read and mapped: only typed errors, no hang, no great memory.

    python tests/fuzz_files.py [--count 20000] [--jobs 2] [--first 0] [--large 0.15]

Exit code 1, and the seeds, where a file ends in another exception than ConformalUVError, takes longer than 10 seconds
or more than 1 GB over what the interpreter had. The same seed always makes the same file; `--first N --count 1` runs
one again. The part `--large` of the files have 100 KB to 5 MB. The script runs where /proc tells memory (Linux).
"""

from __future__ import annotations

import argparse
import gzip
import io
import os
import signal
import sys
import tempfile
import time
import traceback
import warnings
import zipfile
from collections import Counter
from collections.abc import Callable
from functools import cache
from multiprocessing import get_context
from pathlib import Path

import numpy as np

SECONDS, MEGABYTES = 10.0, 1000.0
MAPPED_FACES = 4000  # larger meshes are read only, but for one in ten
FORMATS = (
    "obj",
    "ply",
    "ply-ascii",
    "off",
    "stl",
    "stl-ascii",
    "npz",
    "obj.gz",
    "ply.gz",
    "glb",
    "gltf",
    "3mf",
    "vtk",
    "vtu",
)
NUMBERS = (b"0", b"-1", b"1e400", b"nan", b"inf", b"-0.0", b"9" * 20, b"4294967295", b"2147483648", b"1e-320")


class Hang(BaseException):
    """The time is over."""


@cache
def seed_file(kind: str, size: int) -> bytes:
    """A whole file of a format with a mesh of about so many vertices."""
    from conformal_uv import unwrap
    from conformal_uv.charts.arguments import polygon_mesh
    from conformal_uv.files import MeshFile, write_mesh
    from conformal_uv.samples import mask

    V, F = mask(size)
    with tempfile.TemporaryDirectory() as folder:
        suffix = kind.removesuffix("-ascii")
        path = Path(folder) / f"seed.{suffix}"
        if kind in {"obj", "ply", "npz"}:
            mesh = polygon_mesh(V, F)[0]
            uv = unwrap(None, mesh, method="linear", place="disk").uv
            write_mesh(path, MeshFile(path, mesh), corner_uv=uv)
            return path.read_bytes()
        if kind in {"obj.gz", "ply.gz"}:
            return gzip.compress(seed_file(kind[:3], size), 1)
        if kind in {"vtk", "vtu"}:
            import meshio

            meshio.Mesh(V, [("triangle", F)]).write(path)
            return path.read_bytes()
        import trimesh

        mesh = trimesh.Trimesh(V, F, process=False)
        if kind == "ply-ascii":
            return bytes(trimesh.exchange.ply.export_ply(mesh, encoding="ascii"))
        if kind == "stl-ascii":
            return str(trimesh.exchange.stl.export_stl_ascii(mesh)).encode()
        mesh.export(path)
        if kind == "gltf":
            return bytes(trimesh.exchange.gltf.export_gltf(mesh, embed_buffers=True)["model.gltf"])
        return path.read_bytes()


def mutated(data: bytes, rng: np.random.Generator) -> bytes:
    """Mostly one kind of harm, seldom up to eight; one in five early, where headers are.

    Of packed files (gzip, zip) most often a member is harmed and packed again.
    """
    if data[:2] == b"\x1f\x8b" and rng.random() < 0.7:
        return gzip.compress(mutated(gzip.decompress(data), rng), 1)
    if data[:2] == b"PK" and rng.random() < 0.7:
        return _member_harmed(data, rng)
    out = bytearray(data)
    for _ in range(min(8, int(rng.geometric(0.6)))):
        if not out:
            break
        reach = min(len(out), 300) if rng.random() < 0.2 else len(out)
        at = int(rng.integers(reach))
        match int(rng.integers(13)):
            case 0:
                out[at] ^= 1 << int(rng.integers(8))
            case 1:
                out[at] = int(rng.integers(256))
            case 2:
                del out[at : at + int(rng.integers(1, 64))]
            case 3:
                out[at:at] = out[at : at + int(rng.integers(1, 64))] * int(rng.integers(1, 20))
            case 4:
                out[at:at] = rng.bytes(int(rng.integers(1, 32)))
            case 5:
                del out[int(rng.integers(len(out))) :]
            case 6 | 7 | 8:
                _replace_number(out, at, NUMBERS[int(rng.integers(len(NUMBERS)))])
            case 9 | 10:
                _lose_line(out, at)
            case 11:
                out[at : at + 4] = int(rng.integers(2**32)).to_bytes(4, "little")
            case _:
                other = int(rng.integers(len(out)))
                length = int(rng.integers(1, 200))
                out[at : at + length], out[other : other + length] = out[other : other + length], out[at : at + length]
    return bytes(out)


def _member_harmed(data: bytes, rng: np.random.Generator) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as archive, zipfile.ZipFile(out, "w") as harmed:
        names = archive.namelist()
        chosen = names[int(rng.integers(len(names)))]
        for name in names:
            content = archive.read(name)
            harmed.writestr(name, mutated(content, rng) if name == chosen else content)
    return out.getvalue()


def _lose_line(out: bytearray, at: int) -> None:
    """Drop the line at a byte."""
    start, end = out.rfind(b"\n", 0, at) + 1, out.find(b"\n", at)
    if 0 <= end < start + 500:
        del out[start : end + 1]
    else:
        del out[at]


def _replace_number(out: bytearray, at: int, text: bytes) -> None:
    start = at
    while start < len(out) and start < at + 200 and not 48 <= out[start] <= 57:
        start += 1
    end = start
    while end < len(out) and out[end] in b"0123456789.e+-":
        end += 1
    out[start:end] = text


def read_and_map(path: Path, whole: bool) -> str:
    """What becomes of the file in one word."""
    from conformal_uv import ConformalUVError, unwrap
    from conformal_uv.files import read_mesh

    try:
        mesh = read_mesh(path).mesh
        if len(mesh.sizes) > MAPPED_FACES and not whole:
            return "read"
        result = unwrap(None, mesh, method="linear", closed="cut", nonmanifold="cut", orientation="mend")
    except ConformalUVError as error:
        return type(error).__name__
    if not np.isfinite(result.uv).all():
        raise AssertionError("NaN in the result")
    return "mapped" if result.mapped.any() else "not mapped"


def peak(reset: bool = False) -> float:
    """Largest resident memory since the last reset, megabytes."""
    if reset:
        Path("/proc/self/clear_refs").write_text("5")
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmHWM:")[2].split()[0]) / 1000.0


def tried(seed: int, folder: Path, large: float) -> tuple[str, str, str]:
    """Format, outcome and, where it is none that is allowed, the report."""
    rng = np.random.default_rng(seed)
    kind = FORMATS[seed % len(FORMATS)]
    size = int(rng.choice([3000, 8000, 20000])) if rng.random() < large else int(rng.choice([12, 60, 300]))
    data = seed_file(kind, size)
    data = mutated(data, rng)
    path = folder / f"seed_{seed}.{kind.removesuffix('-ascii')}"
    path.write_bytes(data)
    before = peak(reset=True)
    start = time.monotonic()
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    try:
        outcome, report = read_and_map(path, rng.random() < 0.1), ""
    except Hang:
        outcome, report = "HANG", f"{kind}, {len(data)} bytes"
    except MemoryError:
        outcome, report = "MEMORY", f"{kind}, {len(data)} bytes"
    except Exception:  # noqa: BLE001 - that is what is looked for
        outcome, report = "UNTYPED", traceback.format_exc()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        path.unlink()
    took = peak() - before
    if not report and took > MEGABYTES:
        outcome, report = "MEMORY", f"{kind}, {len(data)} bytes, {took:.0f} MB, {time.monotonic() - start:.1f} s"
    return kind, outcome, report


def _over(*_: object) -> None:
    raise Hang


def run(seeds: range, large: float, tell: Callable[[tuple[int, tuple[str, str, str]]], None]) -> None:
    """Try the seeds in this process."""
    signal.signal(signal.SIGALRM, _over)
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory(dir="/dev/shm" if os.path.isdir("/dev/shm") else None) as folder:
        for seed in seeds:
            tell((seed, tried(seed, Path(folder), large)))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=20000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--large", type=float, default=0.15)
    given = parser.parse_args()
    context = get_context("fork")
    queue = context.Queue()
    last = given.first + given.count
    jobs = [
        context.Process(target=run, args=(range(given.first + job, last, given.jobs), given.large, queue.put))
        for job in range(given.jobs)
    ]
    for job in jobs:
        job.start()
    counts: Counter[str] = Counter()
    bad = 0
    for done in range(1, given.count + 1):
        seed, (kind, outcome, report) = queue.get()
        counts[outcome] += 1
        if report:
            bad += 1
            print(f"seed {seed}, {kind}: {outcome}\n{report}", flush=True)
        if done % 1000 == 0:
            print(f"{done} files: {dict(counts)}", flush=True)
    for job in jobs:
        job.join()
    print(f"{given.count} files, {bad} bad: {dict(counts)}")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())

"""One surface over MPI processes: real ones, started by mpiexec, against the serial map.

The processes run the Python that CONFORMAL_UV_MPI_PYTHON names (petsc4py is often the system's), else this one.
"""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import subprocess
import sys
import time
import zipfile
import zlib
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.cli.app import app
from conformal_uv.errors import FileFormatError
from conformal_uv.files.npz_rows import ArchiveLayout, joined_crc, mesh_rows, write_rows
from conformal_uv.samples import terrain

HERE = Path(__file__).parent
PYTHON = os.environ.get("CONFORMAL_UV_MPI_PYTHON") or sys.executable
LIMIT = 240  # seconds; a job that waits for itself would go on for ever


def has_petsc() -> bool:
    """Whether real processes can be started."""
    if shutil.which("mpiexec") is None:
        return False
    if PYTHON == sys.executable:
        return all(importlib.util.find_spec(name) for name in ("petsc4py", "mpi4py"))
    return subprocess.run([PYTHON, "-c", "import petsc4py, mpi4py"], capture_output=True).returncode == 0


needs_mpi = pytest.mark.skipif(not has_petsc(), reason="needs mpiexec and petsc4py (CONFORMAL_UV_MPI_PYTHON)")


def mpiexec(processes: int, *command: str) -> subprocess.CompletedProcess[str]:
    """Run Python in so many processes, more than there are processors if need be."""
    told = subprocess.run(["mpiexec", "--version"], capture_output=True, text=True).stdout
    open_mpi = ["--allow-run-as-root", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1"]
    options = open_mpi if "Open MPI" in told or "OpenRTE" in told else []
    paths = [str(HERE.parent), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"OMP_NUM_THREADS": "1", "PYTHONPATH": os.pathsep.join(filter(None, paths))}
    return subprocess.run(
        ["mpiexec", *options, "-n", str(processes), PYTHON, *command],
        capture_output=True,
        text=True,
        timeout=LIMIT,
        env=environment,
        check=False,
    )


@cache
def outcome(processes: int, *cases: str) -> dict[str, Any]:
    """What some cases of mpi_cases.py come to."""
    done = mpiexec(processes, str(HERE / "mpi_cases.py"), *cases)
    assert done.returncode == 0, done.stderr[-3000:]
    return json.loads(done.stdout.splitlines()[-1])


@needs_mpi
@pytest.mark.parametrize("processes", [1, 2, 4])
def test_distributed_maps_are_the_serial_ones(processes: int) -> None:
    """To 1e-8, as issue 17 asks; 4 processes share 7 vertices, too."""
    for name, found in outcome(processes, "same_maps")["same_maps"].items():
        assert found["difference"] < 1e-9, name
        assert found["boundary"] and found["flipped"] and found["converged"], name
        assert max(found["energy"], found["angle"], found["angle_max"]) < 1e-7, name
        assert found["gradient"] <= 1e-10 and found["steps"] <= 60, name


@needs_mpi
@pytest.mark.parametrize("processes", [2, 3])
def test_every_process_tells_the_serial_error(processes: int) -> None:
    found = outcome(processes, "refusals", "failures")["refusals"]
    assert len(found) > 20
    for name, errors in found.items():
        assert errors["serial"] is not None, name
        assert errors["ranks"] == [errors["serial"]] * processes, name


@needs_mpi
def test_what_one_process_meets_ends_all() -> None:
    found = outcome(2, "refusals", "failures")["failures"]
    assert found["memory"] == ["MemoryError not enough"] * 2
    for name, kind in (("cancelled", "CancelledError"), ("option", "OptionError"), ("vertex", "OptionError")):
        assert [error[0] for error in found[name]] == [kind] * 2, name
    assert [error[0] for error in found["delaunay"]] == ["OptionError"] * 2


@needs_mpi
def test_no_process_holds_an_array_of_the_whole_surface() -> None:
    """Looked for by their very sizes at every stage, and four processes' peaks are as high as one's for a quarter."""
    alone, four = outcome(1, "counted")["counted"], outcome(4, "counted")["counted"]
    assert alone["full"] > 0  # they are found where they are: one process has the whole
    assert four["full"] == 0
    assert four["per_vertex"] < 1.05 * alone["per_vertex"]  # one array of doubles more would be 32 bytes of 900


@needs_mpi
def test_the_command_maps_an_archive_as_it_does_alone(tmp_path: Path) -> None:
    V, F = terrain(900, seed=2)
    np.savez(tmp_path / "in.npz", V=V, F=F)
    (tmp_path / "folder").mkdir()
    np.save(tmp_path / "folder" / "V.npy", V)
    np.save(tmp_path / "folder" / "F.npy", F)
    command = ["-m", "conformal_uv", "disk"]
    giant = ["--backend", "petsc", "--json", str(tmp_path / "numbers.json")]
    for source in ("in.npz", "folder"):
        out = tmp_path / f"{source}_out.npz"
        done = mpiexec(2, *command, str(tmp_path / source), str(out), *giant)
        assert done.returncode == 0, done.stderr
        assert done.stdout.count("angle error") == 1
        assert zipfile.ZipFile(out).testzip() is None
        alone = tmp_path / "alone.npz"
        with pytest.raises(SystemExit) as ended:
            app(
                [*command[2:], str(tmp_path / "in.npz"), str(alone), "--method", "linear", "--laplacian", "cotan", "-q"]
            )
        assert ended.value.code == 0
        with np.load(out) as one, np.load(alone) as other:
            np.testing.assert_allclose(one["uv"], other["uv"], atol=1e-9)
            np.testing.assert_array_equal(one["V"], V)
            np.testing.assert_array_equal(one["F"], F)
    numbers = json.loads((tmp_path / "numbers.json").read_text())
    assert numbers["processes"] == 2 and numbers["sent"][0]["bytes"] > 0


@needs_mpi
def test_the_command_refuses_in_one_line_and_leaves_the_output_alone(tmp_path: Path) -> None:
    V, F = terrain(900, seed=2)
    V[-4, 0] = np.inf
    source, target = tmp_path / "in.npz", tmp_path / "out.npz"
    np.savez(source, V=V, F=F)
    target.write_bytes(b"as it was")
    start = time.monotonic()
    done = mpiexec(2, "-m", "conformal_uv", "disk", str(source), str(target), "--backend", "petsc")
    assert done.returncode == 1 and time.monotonic() - start < 30
    assert done.stderr.count("NonFiniteError: 1 of 900 vertices have a NaN or infinite coordinate: 896.") == 1
    assert target.read_bytes() == b"as it was" and sorted(p.name for p in tmp_path.iterdir()) == ["in.npz", "out.npz"]
    np.savez_compressed(source, V=V, F=F)
    done = mpiexec(2, "-m", "conformal_uv", "disk", str(source), str(target), "--backend", "petsc")
    assert done.returncode == 1 and done.stderr.count("is compressed") == 1
    done = mpiexec(2, "-m", "conformal_uv", "disk", str(source), str(target), "--backend", "petsc", "--closed", "cut")
    assert done.returncode == 1 and done.stderr.count("does without --closed cut") == 1
    page = ["--html", str(tmp_path / "page.html"), "--pack-shape", "box"]
    done = mpiexec(2, "-m", "conformal_uv", "disk", str(source), str(target), "--backend", "petsc", *page)
    assert done.returncode == 1 and done.stderr.count("does without --pack-shape, --html") == 1


def test_petsc_is_no_solver_of_one_process() -> None:
    with pytest.raises(cuv.OptionError, match="distributed_disk_map"):
        cuv.disk_map(*terrain(100), backend="petsc")


def test_without_mpi_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("mpi4py", "petsc4py"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(cuv.MissingDependencyError, match=r"conformal-uv\[mpi\]"):
        cuv.distributed_disk_map(*terrain(100))


def test_archives_are_written_row_by_row_as_numpy_would(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    V, F = rng.normal(size=(11, 3)), rng.integers(0, 11, (7, 3))
    layout = ArchiveLayout({"V": (11, 3, V.dtype), "F": (7, 3, F.dtype)})
    path = tmp_path / "a.npz"
    with open(path, "xb") as stream:
        stream.truncate(layout.end)
    sums = {}
    for name, array, cuts in (("V", V, (0, 4, 4, 11)), ("F", F, (0, 1, 7))):
        sums[name] = 0
        for first, last in zip(cuts[:-1], cuts[1:], strict=True):
            crc = write_rows(layout.rows(path, name), first, array[first:last])
            sums[name] = joined_crc(sums[name], crc, array[first:last].nbytes)
        assert sums[name] == zlib.crc32(array.tobytes())
    with open(path, "r+b") as stream:
        layout.write_frame(stream, sums)
    assert zipfile.ZipFile(path).testzip() is None
    with np.load(path) as archive:
        np.testing.assert_array_equal(archive["V"], V)
        np.testing.assert_array_equal(archive["F"], F)
    rows, faces = mesh_rows(path)
    np.testing.assert_array_equal(rows.read(3, 9), V[3:9])
    np.testing.assert_array_equal(faces.read(0, 7), F)


def test_rows_that_are_not_there_are_told(tmp_path: Path) -> None:
    V, F = terrain(100)
    path = tmp_path / "a.npz"
    np.savez(path, V=np.asfortranarray(V), F=F)
    with pytest.raises(FileFormatError, match="Fortran order"):
        mesh_rows(path)
    np.savez(path, V=V, G=F)
    with pytest.raises(FileFormatError, match=r"no array 'F'.*V.npy, G.npy"):
        mesh_rows(path)
    np.savez(path, V=V, F=F.astype(float))
    with pytest.raises(FileFormatError, match="float64"):
        mesh_rows(path)
    path.write_bytes(b"no archive")
    with pytest.raises(FileFormatError, match="damaged"):
        mesh_rows(path)
    with pytest.raises(FileFormatError, match="can not be read"):
        mesh_rows(tmp_path / "none.npz")
    np.save(tmp_path / "V.npy", V)
    np.save(tmp_path / "F.npy", F)
    found, _ = mesh_rows(tmp_path)
    (tmp_path / "V.npy").write_bytes((tmp_path / "V.npy").read_bytes()[:-50])
    with pytest.raises(FileFormatError, match="ends before row"):
        found.read(0, 100)

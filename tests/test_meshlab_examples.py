"""The example pipeline as a user runs it, and the comparison with pymeshlab's own filters."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

from meshlab_sets import loaded

import conformal_uv as cuv
from conformal_uv.samples import mask

ROOT = Path(__file__).resolve().parents[1]


def run(*arguments: object, folder: Path) -> str:
    command = [sys.executable, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, cwd=folder)
    assert done.returncode == 0, done.stderr
    return done.stdout


def numbers(text: str) -> dict[str, float]:
    return {name: float(value) for name, value in (line.split() for line in text.splitlines())}


def test_pipeline_cleans_decimates_maps_colours_and_saves(tmp_path: Path):
    told = numbers(run(ROOT / "examples" / "meshlab_pipeline.py", folder=tmp_path))
    mesh = loaded(tmp_path / "meshlab_pipeline.ply")
    assert mesh.face_number() == told["faces"] == told["mapped_faces"]
    assert 4900 < mesh.face_number() <= 5000
    assert told["flipped_polygons"] == 0
    error = mesh.face_scalar_array()
    assert error.mean() == pytest.approx(told["angle_error_mean"], rel=1e-4)
    green = mesh.face_color_matrix()[np.argsort(error), 1]  # viridis: ever more of it
    assert np.diff(green).min() >= -1.5 / 255 and np.ptp(green) > 0.2
    assert list(mesh.textures()) == ["meshlab_pipeline_checker.png"]
    uv = mesh.wedge_tex_coord_matrix()
    again = cuv.unwrap(mesh.vertex_matrix(), mesh.face_matrix())
    np.testing.assert_allclose(uv, again.uv, atol=1e-6)


def test_pipeline_on_a_scan(tmp_path: Path, data_folder: Path):
    scan = data_folder / "scans" / "human_face.obj"
    told = numbers(run(ROOT / "examples" / "meshlab_pipeline.py", scan, tmp_path / "face.obj", folder=tmp_path))
    assert told["mapped_faces"] == loaded(tmp_path / "face.obj").face_number() <= 5000
    assert "map_Kd face_checker.png" in (tmp_path / "face.obj.mtl").read_text()
    assert told["angle_error_mean"] < 4.0


@pytest.fixture(scope="module")
def peers():
    import importlib.util

    spec = importlib.util.spec_from_file_location("meshlab_peers", ROOT / "benchmarks" / "meshlab_peers.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_smaller_angle_error_than_pymeshlabs_harmonic_map_on_the_same_circle(data_folder: Path, peers):
    path = str(data_folder / "scans" / "human_face.obj")
    ours, harmonic, free = (
        peers.measured(path, peers.METHODS[name]) for name in ("conformal disk", "harmonic", "least squares")
    )
    assert ours["angle_mean"] < 0.25 * harmonic["angle_mean"]
    assert ours["ratio_mean"] < harmonic["ratio_mean"]
    # A free boundary has an easier task than a circle; the circle costs no more than a tenth of the angle error.
    assert ours["angle_mean"] < 1.1 * free["angle_mean"]
    assert ours["flipped"] == 0


def test_peers_are_measured_from_what_the_mesh_holds(tmp_path: Path, peers):
    """A map known in closed form: the least-squares map of a flat surface turns and scales it."""
    V, F = mask(300)
    V[:, 2] = 0.0
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(V, F))
    ms.save_current_mesh(str(tmp_path / "flat.ply"))
    flat = peers.measured(str(tmp_path / "flat.ply"), peers.METHODS["least squares"])
    assert flat["angle_mean"] < 0.05 and flat["flipped"] == 0
    harmonic = peers.measured(str(tmp_path / "flat.ply"), peers.METHODS["harmonic"])
    assert harmonic["angle_mean"] > 1.0


def test_peers_are_never_run_on_topology_that_they_crash_on(tmp_path: Path, peers):
    V, F = mask(300)
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(np.vstack((V, [0, 0, 9])), F))
    ms.save_current_mesh(str(tmp_path / "loose.ply"))
    ran = []
    with pytest.raises(cuv.UnreferencedVertexError):
        peers.measured(str(tmp_path / "loose.ply"), ran.append)
    assert ran == []

"""The example pipeline as a user runs it, and the comparison with pymeshlab's own filters."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pymeshlab", exc_type=ImportError)

from meshlab_sets import loaded

import conformal_uv as cuv
from conformal_uv.files import read_mesh
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


def measured(method: str, V: np.ndarray, F: np.ndarray) -> cuv.Distortion:
    """What the contestant of the benchmarks leaves in pymeshlab's mesh."""
    from benchmarks.speed.contestants.meshlab import run

    return cuv.distortion(V, F, run({"V": V, "F": F}, lambda name: None, method=method).uv)


def test_smaller_angle_error_than_pymeshlabs_harmonic_map_on_the_same_circle(data_folder: Path):
    mesh = read_mesh(data_folder / "scans" / "human_face.obj").mesh
    used, F = np.unique(cuv.triangulate(mesh)[0], return_inverse=True)
    V, F = mesh.V[used], F.reshape(-1, 3)
    ours, harmonic, free = (measured(name, V, F) for name in ("conformal disk", "harmonic", "least squares"))
    assert ours.angle_mean < 0.25 * harmonic.angle_mean
    assert ours.quasi_conformal.mean() < harmonic.quasi_conformal.mean()
    # A free boundary has an easier task than a circle; the circle costs no more than a tenth of the angle error.
    assert ours.angle_mean < 1.1 * free.angle_mean
    assert len(ours.flipped) == 0


def test_peers_are_measured_from_what_the_mesh_holds():
    """A map known in closed form: the least-squares map of a flat surface turns and scales it."""
    V, F = mask(300)
    V[:, 2] = 0.0
    flat = measured("least squares", V, F)
    assert flat.angle_mean < 0.05 and len(flat.flipped) == 0
    assert measured("harmonic", V, F).angle_mean > 1.0

"""Pictures of very many triangles: which of them a sample shows, its colour, and the same figure as of shapes."""

from __future__ import annotations

import base64
import io
import re
from pathlib import Path

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.pictures import figure
from conformal_uv.pictures.raster import SAMPLES, faces_in_front, painted
from conformal_uv.pictures.triangle_picture import TrianglePicture


def bumpy_grid(side: int) -> tuple[np.ndarray, np.ndarray]:
    """A surface over a square of (side - 1)^2 pairs of triangles of different sizes."""
    at = np.linspace(0, 1, side) ** 1.3
    x, y = np.meshgrid(at, at, indexing="ij")
    V = np.stack((x, y, 0.3 * np.sin(4 * x + y) * y), axis=-1).reshape(-1, 3)
    index = np.arange(side * side).reshape(side, side)
    a, b, c, d = (part.ravel() for part in (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]))
    return V, np.concatenate([np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)])


def holds(triangle: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Whether points lie in a triangle of either orientation."""
    sides = [np.cross(np.roll(triangle, -k, 0)[1] - triangle[k], points - triangle[k]) for k in range(3)]
    return np.all(np.array(sides) > 0, axis=0) | np.all(np.array(sides) < 0, axis=0)


def test_a_sample_shows_the_last_triangle_over_it():
    triangles = np.random.default_rng(5).uniform(-4, 24, (60, 3, 2))
    y, x = np.mgrid[:17, :20] + 0.5
    expected = np.full((17, 20), -1)
    for k, triangle in enumerate(triangles):
        expected[holds(triangle, np.stack((x, y), axis=-1))] = k
    assert np.array_equal(faces_in_front(triangles, (17, 20)), expected)


def test_triangles_side_by_side_leave_no_sample_out_and_share_none():
    V, F = bumpy_grid(40)
    corners = 30.0 * (V[:, :2] - V[:, :2].min(axis=0))[F]
    size = int(corners.max())
    forwards, backwards = faces_in_front(corners, (size, size)), faces_in_front(corners[::-1], (size, size))
    inside = forwards[2:-2, 2:-2]
    assert (inside >= 0).all()
    assert np.array_equal(forwards[forwards >= 0], len(F) - 1 - backwards[backwards >= 0])


def test_triangles_without_area_or_outside_show_nowhere():
    flat = [
        [[1.0, 1.0], [5.0, 5.0], [3.0, 3.0]],
        [[1.0, 2.0], [6.0, 2.0], [3.0, 2.0]],
        [[-9.0, 1.0], [-5.0, 1.0], [-7.0, 8.0]],
    ]
    assert (faces_in_front(np.array(flat), (8, 8)) == -1).all()


def test_a_pixel_is_the_mean_of_its_samples_and_as_opaque_as_they_are_many():
    faces = np.full((SAMPLES, 2 * SAMPLES), -1, np.int32)
    faces[:, : SAMPLES // 2] = 0
    faces[:, SAMPLES:] = 1
    faces[0, SAMPLES:] = 0
    pixels = painted(faces, np.array([[1.0, 0.0, 0.2, 1.0], [0.0, 1.0, 0.2, 1.0]]))
    part = round(255 / SAMPLES)
    assert pixels.tolist() == [[[255, 0, 51, 128], [part, 255 - part, 51, 255]]]


def drawn(monkeypatch: pytest.MonkeyPatch, path: Path, detailed: int) -> bytes:
    V, F = bumpy_grid(16)
    monkeypatch.setattr(figure, "DETAILED", detailed)
    figure.draw_map(path, cuv.unwrap(V, F), "grid")
    return path.read_bytes()


def pixels(data: bytes) -> np.ndarray:
    image = pytest.importorskip("PIL.Image")
    return np.asarray(image.open(io.BytesIO(data)).convert("RGBA"), dtype=float)


def test_many_triangles_look_as_their_shapes_do(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    shapes, samples = (pixels(drawn(monkeypatch, tmp_path / "p.png", n)) for n in (len(bumpy_grid(16)[1]), 10))
    surface, error = np.s_[:, :640], np.s_[:, 1240:]  # between them is the map, whose edges are drawn with shapes alone
    for part in (surface, error):
        differ = np.abs(shapes[part] - samples[part]).max(axis=-1)
        assert np.percentile(differ, 90) <= 2
        assert differ.mean() < 2
        assert np.abs(shapes[part][::-1] - samples[part]).max(axis=-1).mean() > 10  # upside down it would be seen


def test_vector_files_hold_the_same_picture_of_many_triangles(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    def embedded(detailed: int) -> np.ndarray:
        text = drawn(monkeypatch, tmp_path / "p.svg", detailed).decode()
        return pixels(base64.b64decode(re.findall(r"base64,\s*([A-Za-z0-9+/=\s]+)", text)[0]))

    shapes, samples = embedded(len(bumpy_grid(16)[1])), embedded(10)
    assert np.abs(np.subtract(shapes.shape, samples.shape)).max() <= 2
    height, width = np.minimum(shapes.shape, samples.shape)[:2]
    some = np.s_[4 : height - 4, 4 : width - 4]
    assert np.abs(shapes[some] - samples[some]).mean() < np.abs(shapes[::-1][some] - samples[some]).mean() / 4


def test_flipped_triangles_smaller_than_a_pixel_are_seen(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    V, F = bumpy_grid(16)
    result = cuv.unwrap(V, F)
    (chart,) = result.charts
    assert chart.distortion is not None
    face = int(np.argmin(np.linalg.norm(result.uv[chart.corner].mean(axis=1) - 0.5, axis=1)))
    result.uv[chart.corner[face]] = result.uv[chart.corner[face]].mean(axis=0) + 1e-4 * np.eye(3, 2)
    monkeypatch.setattr(figure, "DETAILED", 10)
    pictures = []
    for flipped in ([], [face]):
        object.__setattr__(chart.distortion, "flipped", np.array(flipped, dtype=np.int64))
        figure.draw_map(tmp_path / "p.png", result, "grid")
        pictures.append(pixels((tmp_path / "p.png").read_bytes())[80:])  # without the title, which tells their number
    assert 1 <= np.count_nonzero(np.abs(pictures[1] - pictures[0]).max(axis=-1) > 30) <= 16


def test_a_figure_drawn_again_elsewhere_is_painted_again():
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    page = Figure(figsize=(2, 2), dpi=50)
    canvas = FigureCanvasAgg(page)
    axes = page.add_axes((0, 0, 1, 1), xlim=(0, 1), ylim=(0, 1), frame_on=False, xticks=[], yticks=[])
    axes.add_artist(TrianglePicture(np.array([[[0, 0], [0.5, 0], [0, 0.5]]]), np.array([[0.0, 0.0, 0.0, 1.0]])))
    counts = []
    for limit in (1.0, 2.0):
        axes.set_xlim(0, limit)
        canvas.draw()
        counts.append(np.count_nonzero(np.asarray(canvas.buffer_rgba())[:, :, 0] < 128))
    assert counts[1] == pytest.approx(counts[0] / 2, rel=0.1)
    assert counts[0] == pytest.approx(100 * 100 / 8, rel=0.1)

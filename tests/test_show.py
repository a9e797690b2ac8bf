"""Results that show themselves: in a line, in a notebook, as figures, pages and other libraries' meshes."""

from __future__ import annotations

import base64
import io
import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from meshes_closed import icosphere
from typer.testing import CliRunner

import conformal_uv as cuv
from conformal_uv.cli.app import app
from conformal_uv.mapped_mesh import mapped_mesh
from conformal_uv.pictures.png import png
from conformal_uv.pictures.thumbnail import DARK, LIGHT, thumbnail
from conformal_uv.samples import mask, spherical_cap
from conformal_uv.show.libraries import library

ROOT = Path(__file__).resolve().parent.parent
V, F = mask(400)
BALL = icosphere(2)
RESULTS = {
    "disk": cuv.disk_map(V, F),
    "free": cuv.free_map(V, F),
    "rectangle": cuv.rectangle_map(V, F),
    "sphere": cuv.sphere_map(BALL[0] * [1.0, 1.5, 1.0], BALL[1]),
    "charts": cuv.unwrap(V, F),
}
each_result = pytest.mark.parametrize("kind", RESULTS)


def opened(data: bytes) -> np.ndarray:
    return np.asarray(pytest.importorskip("PIL.Image").open(io.BytesIO(data)), dtype=float)


class Tags(HTMLParser):
    """That every element that is opened is closed, and what the pictures are."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.images: list[dict] = []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attrs) -> None:
        if tag == "img":
            self.images.append(dict(attrs))
        else:
            self.open.append(tag)

    def handle_endtag(self, tag) -> None:
        assert self.open.pop() == tag


@each_result
def test_a_repr_is_one_short_line_without_numbers_of_arrays(kind: str) -> None:
    text = repr(RESULTS[kind])
    assert text.startswith(type(RESULTS[kind]).__name__) and "\n" not in text and len(text) < 500
    assert "array(" not in text and re.search(r"(uv|xyz)=float64 \(\d+, [23]\)", text)


def test_arrays_of_other_objects_are_not_dumped_either() -> None:
    disk = RESULTS["disk"]
    for thing in (disk.surface, disk.surface.edges, disk.distortion, RESULTS["charts"].charts, mapped_mesh(disk)):
        assert len(repr(thing)) < 400 and "array(" not in repr(thing)


def test_reprs_say_short_values_and_count_long_ones() -> None:
    pins = tuple(RESULTS["disk"].boundary[[0, 20, 40]].tolist())
    text = repr(cuv.disk_map(V, F, method="newton", pins=pins))
    assert "method='newton'" in text and f"pins={pins}" in text and re.search(r"history=\d+ items", text)


@each_result
def test_a_notebook_gets_numbers_and_a_picture(kind: str) -> None:
    result = RESULTS[kind]
    text = result._repr_html_()
    (image,) = Tags(text).images
    assert len(image["alt"]) > 20
    pixels = opened(base64.b64decode(image["src"].removeprefix("data:image/png;base64,")))
    assert pixels.shape == (220, 440, 4)
    for half in (pixels[:, :220], pixels[:, 220:]):
        assert 0.3 < (half[:, :, 3] > 0).mean() < 0.9
    mapped = mapped_mesh(result)
    assert f"{len(mapped.V):,}, {len(mapped.F):,}" in text
    assert f"mean {mapped.distortion.angle_mean:.3g}°" in text


def test_a_notebook_is_told_why_nothing_was_mapped() -> None:
    text = cuv.unwrap(*BALL)._repr_html_()
    assert Tags(text).images == [] and "mapped 0 of 1 chart" in text


def test_a_thumbnails_map_is_a_checker_of_twelve_squares() -> None:
    """A flat disk, seen from above with y up: what is beside it is the same disk, if evenly lit."""
    from conformal_uv.samples import flat_disk

    pixels = thumbnail(mapped_mesh(cuv.disk_map(*flat_disk(500)))).astype(float)
    half = pixels[:, 220:]
    width = 0.94 * 220 / 12
    for i, j in ((0, 0), (0, 1), (1, 1), (-2, 1), (3, -3)):  # squares from the middle, to the right and up
        seen = half[int(110 - (j + 0.5) * width), int(110 + (i + 0.5) * width)]
        nearer = LIGHT if (i + j) % 2 == 0 else DARK
        assert np.abs(seen[:3] / seen[:3].max() - nearer / nearer.max()).max() < 0.05
        assert seen[3] == 255
    assert (half[[0, 0, -1, -1], [0, -1, 0, -1], 3] == 0).all()


def test_png_of_a_few_pixels() -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (3, 5, 4)).astype(np.uint8)
    assert np.array_equal(opened(png(pixels)), pixels)


@each_result
def test_plot_gives_a_figure_and_writes_it(kind: str, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    figure = RESULTS[kind].plot(tmp_path / "a.png", title="A name")
    assert "A name: " in figure.axes[0].get_title()
    assert opened((tmp_path / "a.png").read_bytes()).shape[2] == 4
    assert [axes.get_title() for axes in RESULTS[kind].plot().axes[:3]] == [
        axes.get_title().removeprefix("A name: ") for axes in figure.axes[:3]
    ]


def test_plot_says_what_it_does_not_take(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    disk = RESULTS["disk"]
    with pytest.raises(cuv.OptionError, match="path a.tiff: choose"):
        disk.plot(tmp_path / "a.tiff")
    with pytest.raises(cuv.OptionError, match="upright is 'x'"):
        disk.plot(upright="x")
    with pytest.raises(cuv.FileFormatError, match="does not exist"):
        disk.plot(tmp_path / "no" / "a.png")


def test_a_capped_sphere_is_drawn_without_its_cap(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    cuv.sphere_map(V, F, boundary="cap").plot(tmp_path / "a.png")
    assert (tmp_path / "a.png").stat().st_size > 10_000


def test_a_result_writes_its_page(tmp_path: Path) -> None:
    RESULTS["disk"].to_html(tmp_path / "a.html", title="Mine")
    assert "<title>Mine" in (tmp_path / "a.html").read_text()
    with pytest.raises(cuv.FileFormatError, match="does not exist"):
        RESULTS["disk"].to_html(tmp_path / "no" / "a.html")


@each_result
def test_trimesh_has_surface_map_and_errors(kind: str) -> None:
    pytest.importorskip("trimesh")
    result, mapped = RESULTS[kind], mapped_mesh(RESULTS[kind])
    mesh, image = result.to_trimesh(), result.to_trimesh(image=True)
    assert np.allclose(mesh.vertices, mapped.V) and np.array_equal(mesh.faces, mapped.F)
    assert np.array_equal(image.vertices[:, : mapped.image.shape[1]], mapped.image)
    assert np.array_equal(mesh.face_attributes["angle_error"], mapped.distortion.angle_error.mean(axis=1))
    if kind == "sphere":
        assert np.array_equal(mesh.vertex_attributes["sphere"], result.xyz)
    else:
        uv = np.asarray(mesh.visual.uv)
        assert uv.min() >= -1e-12 and uv.max() <= 1.0 + 1e-12 and np.ptp(uv, axis=0).max() > 0.999
        assert cuv.distortion(mesh.vertices, mesh.faces, uv).angle_mean == pytest.approx(mapped.distortion.angle_mean)


@each_result
def test_pyvista_has_surface_map_and_errors(kind: str) -> None:
    pytest.importorskip("pyvista")
    result, mapped = RESULTS[kind], mapped_mesh(RESULTS[kind])
    mesh, image = result.to_pyvista(), result.to_pyvista(image=True)
    assert np.allclose(mesh.points, mapped.V) and np.array_equal(mesh.regular_faces, mapped.F)
    assert np.allclose(image.points[:, : mapped.image.shape[1]], mapped.image)
    assert np.array_equal(mesh.cell_data["area scale"], mapped.distortion.area_scale)
    if kind == "sphere":
        assert np.array_equal(mesh.point_data["sphere"], result.xyz)
    else:
        assert np.allclose(mesh.active_texture_coordinates, result.to_trimesh().visual.uv)
    again = cuv.unwrap(mesh) if kind != "sphere" else cuv.sphere_map(mesh)  # and back
    assert again is not None


def test_positions_are_in_the_callers_units() -> None:
    pytest.importorskip("trimesh")
    large = V * 1000.0
    for result in (cuv.disk_map(large, F), cuv.unwrap(large, F)):
        assert np.allclose(mapped_mesh(result).V[np.argsort(mapped_mesh(result).vertices)], large, rtol=1e-12)


def test_a_missing_library_is_named_with_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("matplotlib", "trimesh", "pyvista", "polyscope"):
        monkeypatch.setitem(sys.modules, name, None)
    disk = RESULTS["disk"]
    for call, told in (
        (disk.plot, r'plot\(\) needs matplotlib: pip install "conformal-uv\[plot\]"'),
        (disk.to_trimesh, r"to_trimesh\(\) needs trimesh: pip install trimesh"),
        (disk.to_pyvista, r"to_pyvista\(\) needs pyvista: pip install pyvista"),
        (disk.to_polyscope, r'to_polyscope\(\) needs polyscope: pip install "conformal-uv\[view\]"'),
    ):
        with pytest.raises(cuv.MissingDependencyError, match=told):
            call()
    assert "<img" in disk._repr_html_()


def test_a_library_that_fails_in_itself_is_not_called_missing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "half_installed.py").write_text("import what_it_needs\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="what_it_needs") as raised:
        library("half_installed", "this", "it")
    assert not isinstance(raised.value, cuv.MissingDependencyError)


def test_nothing_is_loaded_before_it_is_asked_for() -> None:
    code = """
import sys, conformal_uv as cuv
from conformal_uv.samples import mask
m = cuv.disk_map(*mask(200))
repr(m)
assert not {"matplotlib", "trimesh", "pyvista", "polyscope", "conformal_uv.show"} & set(sys.modules)
m._repr_html_()
assert not {"matplotlib", "trimesh", "pyvista", "polyscope"} & set(sys.modules)
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def view(folder: Path, *arguments: str) -> subprocess.CompletedProcess:
    """In a process of its own, for polyscope begins once; without a screen."""
    pytest.importorskip("polyscope")
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    command = [sys.executable, "-m", "conformal_uv", "view", *arguments]
    environment["PYTHONPATH"] = str(ROOT)
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120)


def seen(done: subprocess.CompletedProcess, path: Path) -> np.ndarray:
    if "can not draw without a screen" in done.stderr:
        pytest.skip("polyscope has no EGL here: apt-get install libegl1 libgl1-mesa-dri")
    assert done.returncode == 0, done.stderr
    return opened(path.read_bytes())


@pytest.mark.skipif(sys.platform != "linux", reason="drawing without a screen is EGL's")
@pytest.mark.parametrize("kind", ["auto", "free", "sphere"])
def test_view_draws_the_surface_beside_its_map(kind: str, tmp_path: Path) -> None:
    surface = BALL if kind == "sphere" else spherical_cap(800)
    np.savez(tmp_path / "a.npz", V=surface[0], F=surface[1])
    done = view(tmp_path, "a.npz", "--screenshot", "a.png", "--shape", kind, "-q")
    pixels = seen(done, tmp_path / "a.png")
    assert pixels.shape[:2] == (900, 1600) and done.stdout == ""
    assert {path.name for path in tmp_path.iterdir()} == {"a.npz", "a.png"}
    drawn = np.abs(pixels[:, :, :3] - pixels[0, 0, :3]).max(axis=-1) > 20
    columns = drawn.any(axis=0)
    assert 0.2 < columns[:800].mean() < 0.95 and 0.2 < columns[800:].mean() < 0.95
    assert not drawn[:5].any() and not drawn[-5:].any() and not columns[:5].any() and not columns[-5:].any()


@pytest.mark.skipif(sys.platform != "linux", reason="drawing without a screen is EGL's")
def test_to_polyscope_registers_surface_and_map(tmp_path: Path) -> None:
    pytest.importorskip("polyscope")
    code = """
import sys
import polyscope
import conformal_uv as cuv
from conformal_uv.samples import mask
polyscope.set_allow_headless_backends(True)
try:
    polyscope.init("openGL3_egl")
except RuntimeError:
    sys.exit("can not draw without a screen")
surface, flat = cuv.disk_map(*mask(300)).to_polyscope("mask")
assert polyscope.has_surface_mesh("mask") and polyscope.has_surface_mesh("mask, map")
assert surface.n_vertices() == flat.n_vertices() == 300
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=120,
    )
    if "can not draw without a screen" in done.stderr:
        pytest.skip("polyscope has no EGL here")
    assert done.returncode == 0, done.stderr


def test_view_refuses_before_it_reads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("polyscope")
    runner = CliRunner()
    for name, told in (("a.gif", "ends in .png"), ("no/a.png", "does not exist")):
        done = runner.invoke(app, ["view", str(tmp_path / "none.obj"), "--screenshot", str(tmp_path / name)])
        assert done.exit_code == 1 and told in done.output
    monkeypatch.setitem(sys.modules, "polyscope", None)
    done = runner.invoke(app, ["view", str(tmp_path / "none.obj")])
    assert done.exit_code == 1 and 'pip install "conformal-uv[view]"' in done.output


def test_view_tells_why_a_surface_can_not_be_mapped(tmp_path: Path) -> None:
    pytest.importorskip("polyscope")
    np.savez(tmp_path / "a.npz", V=BALL[0], F=BALL[1])
    command = ["view", str(tmp_path / "a.npz"), "--shape", "disk", "--screenshot", str(tmp_path / "a.png"), "-q"]
    done = CliRunner().invoke(app, command)
    assert done.exit_code == 1 and "closed" in done.output and not (tmp_path / "a.png").exists()

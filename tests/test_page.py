"""The page's file: what is packed comes back, and the page needs nothing but itself."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import subprocess
import zlib
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import conformal_uv as cuv
from conformal_uv.cli.app import app
from conformal_uv.mapped_mesh import mapped_mesh
from conformal_uv.page import page_html
from conformal_uv.page.packing import PackedArray, packed_integers, packed_reals
from conformal_uv.samples import mask

ROOT = Path(__file__).resolve().parent.parent
WEB = ROOT / "web"
BUILT = ROOT / "conformal_uv" / "page" / "assets" / "page.js"
MEGABYTE = 1 << 20


def unpacked(header: dict, data: bytes) -> np.ndarray:
    """Rows as the page's program reads them, written after the description in packing.py."""
    rows, columns, width = header["rows"], header["columns"], header["width"]
    planes = np.frombuffer(data, np.uint8).reshape(columns, width, rows).astype(np.int64)
    near = sum(planes[:, k] << (8 * k) for k in range(width))
    steps = np.where(near % 2, -(near + 1) // 2, near // 2)
    whole = np.cumsum(steps, axis=1) % (1 << (8 * width))
    return np.array(header["low"]) + header["step"] * whole.T


def arrays_of(page: str) -> tuple[dict, dict[str, np.ndarray]]:
    about = json.loads(re.search(r'id="about">(.*?)</script>', page, re.S)[1])
    data = zlib.decompress(base64.b64decode(re.search(r'id="mesh">(.*?)</script>', page, re.S)[1]))
    found, begin = {}, 0
    for header in about["arrays"]:
        size = header["rows"] * header["columns"] * header["width"]
        found[header["name"]] = unpacked(header, data[begin : begin + size])
        begin += size
    assert begin == len(data)
    return about, found


def test_bytes_of_three_numbers_by_hand() -> None:
    """0, 65535, 1 differ by 0, -1 and 2 modulo 65536, which are the first, second and fifth from 0: 0, 1, 4."""
    packed = packed_reals("x", np.array([-1.0, 1.0, -1.0 + 2.0 / 65535]), 2)
    assert packed.data == bytes([0, 1, 4, 0, 0, 0])


@pytest.mark.parametrize("width", [1, 2, 3])
def test_reals_come_back_within_half_a_step(width: int) -> None:
    values = np.random.default_rng(0).normal(size=(300, 3)) * [1.0, 10.0, 0.0] + [0.0, 5.0, 7.0]
    packed = packed_reals("x", values, width)
    assert packed.step == pytest.approx(np.ptp(values, axis=0).max() / (2 ** (8 * width) - 1), rel=1e-12)
    assert np.abs(unpacked(packed.header(), packed.data) - values).max() <= 0.5000001 * packed.step


@pytest.mark.parametrize("most", [1, 255, 256, 70_000, 2**31])
def test_integers_come_back_exactly(most: int) -> None:
    values = np.random.default_rng(most).integers(0, most, (100, 3), endpoint=True)
    values[0, 0], values[1, 0] = most, 0
    packed: PackedArray = packed_integers("faces", values)
    assert packed.width == (most.bit_length() + 7) // 8
    assert np.array_equal(unpacked(packed.header(), packed.data), values)


def test_a_page_holds_the_surface_the_map_and_its_errors() -> None:
    V, F = mask(800)
    V = V * 40.0 + 7.0
    result = cuv.disk_map(V, F)
    about, arrays = arrays_of(page_html(result, "A mask"))
    assert about["shape"] == "disk" and about["vertices"] == 800 and about["triangles"] == len(F)
    assert about["angle"]["mean"] == result.distortion.angle_mean
    assert np.array_equal(arrays["faces"], F)
    assert np.abs(arrays["surface"] - V).max() <= np.ptp(V, axis=0).max() / 2**16
    assert np.abs(arrays["image"] - result.uv).max() <= 2.0**-24 * 1.01
    corner = F == 123
    expected = result.distortion.angle_error.mean(axis=1)[corner.any(axis=1)].mean()
    assert arrays["angle"][123, 0] == pytest.approx(expected, abs=np.ptp(arrays["angle"]) / 2**15)


def test_areas_are_doublings_over_the_middle_ones() -> None:
    """A strip whose second half is twice as long in the map: two areas, one twice the other."""
    x = np.repeat(np.arange(9.0), 2)
    V = np.column_stack((x, np.tile([0.0, 1.0], 9), np.zeros(18)))
    k = np.arange(8) * 2
    F = np.concatenate((np.column_stack((k, k + 2, k + 3)), np.column_stack((k, k + 3, k + 1))))
    image = V[:, :2].copy()
    image[:, 0] += np.maximum(image[:, 0] - 4.0, 0.0)
    from conformal_uv.mapped_mesh import MappedMesh

    mapped = MappedMesh(V, F, image, np.arange(18), cuv.distortion(V, F, image), "free")
    _, arrays = arrays_of(page_html(mapped, "strip"))
    area = arrays["area"][:, 0]
    assert area[12:].mean() - area[:6].mean() == pytest.approx(1.0, abs=1e-3)


def test_charts_are_shown_where_the_texture_has_them_cut_at_their_seams() -> None:
    cube = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    seams = [[0, 1], [1, 3], [3, 2], [2, 0]]  # one side for itself
    result = cuv.unwrap(cube, sides, seams=seams, shape="free")
    mapped = mapped_mesh(result)
    assert mapped.shape == "charts" and len(result.charts) == 2
    assert len(mapped.V) == 12 and np.array_equal(cube[mapped.vertices], mapped.V)  # four vertices stand twice
    assert np.bincount(mapped.vertices).tolist() == [2, 2, 2, 2, 1, 1, 1, 1]
    _, arrays = arrays_of(page_html(result, "cube"))
    assert np.abs(arrays["image"] - mapped.image).max() < 1e-6
    assert {tuple(row) for row in mapped.image.round(9)} == {tuple(row) for row in result.uv.round(9)}


def test_one_disk_of_an_unwrap_is_the_unit_disk() -> None:
    mapped = mapped_mesh(cuv.unwrap(*mask(300), margin=0.1))
    assert mapped.shape == "disk"
    assert np.linalg.norm(mapped.image, axis=1).max() == pytest.approx(1.0, abs=1e-12)


def test_nothing_mapped_is_an_error() -> None:
    tetrahedron = cuv.unwrap(np.eye(4, 3), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    with pytest.raises(cuv.MeshError, match="No chart was mapped: mapped 0 of 1 chart; chart 0"):
        mapped_mesh(tetrahedron)


def test_caps_are_left_out() -> None:
    V, F = mask(500)
    mapped = mapped_mesh(cuv.sphere_map(V, F, boundary="cap"))
    assert len(mapped.V) == 500 and np.array_equal(mapped.F, F)
    assert len(mapped.distortion.area_scale) == len(F)


def test_titles_are_text_and_nothing_is_asked_for() -> None:
    page = page_html(cuv.disk_map(*mask(300)), "<b>&</script>", note='"<i>"')
    assert "<title>&lt;b&gt;&amp;&lt;/script&gt;" in page and "<b>" not in page and "<i>" not in page
    head, _, _ = page.partition('id="mesh"')
    assert not re.search(r"(src|href)\s*=\s*[\"']?(?!data:)[a-z/.]", head.replace('href="data:,"', ""))
    assert page.count("</script>") == 3
    assert "default-src 'none'" in head
    assert "Permission is hereby granted" in page and "three.js" in page  # its licence travels along


def test_a_page_is_less_than_a_megabyte_without_its_mesh() -> None:
    page = page_html(cuv.disk_map(*mask(300)), "small")
    assert len(page) - len(re.search(r'id="mesh">(.*?)</script>', page, re.S)[1]) < MEGABYTE
    assert BUILT.stat().st_size < 700 * 1024


@pytest.mark.parametrize("shape", ["disk", "free", "rectangle"])
def test_commands_write_pages(shape: str, tmp_path: Path) -> None:
    mesh, page = tmp_path / "mask.obj", tmp_path / "page.html"
    runner = CliRunner()
    assert runner.invoke(app, ["sample", "mask", str(mesh), "--vertices", "300"]).exit_code == 0
    done = runner.invoke(app, [shape, str(mesh), str(tmp_path / "out.obj"), "--html", str(page), "-q"])
    assert done.exit_code == 0, done.output
    about, _ = arrays_of(page.read_text())
    assert about["shape"] == shape and about["title"] == "mask.obj"


def test_the_sphere_command_writes_a_page(tmp_path: Path) -> None:
    V = [[1, 0, 0], [-1, 0, 0], [0, 2, 0], [0, -2, 0], [0, 0, 3], [0, 0, -3]]
    F = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    np.savez(tmp_path / "a.npz", V=np.array(V, dtype=float), F=np.array(F))
    command = ["sphere", str(tmp_path / "a.npz"), str(tmp_path / "b.obj"), "--html", str(tmp_path / "c.html"), "-q"]
    done = CliRunner().invoke(app, command)
    assert done.exit_code == 0, done.output
    about, arrays = arrays_of((tmp_path / "c.html").read_text())
    assert about["shape"] == "sphere" and arrays["image"].shape == (6, 3)


def test_a_page_that_can_not_be_written_is_refused_before_any_work(tmp_path: Path) -> None:
    mesh = tmp_path / "mask.obj"
    runner = CliRunner()
    runner.invoke(app, ["sample", "mask", str(mesh), "--vertices", "300"])
    for place, told in ((tmp_path / "no" / "page.html", "does not exist"), (mesh, "is the input")):
        done = runner.invoke(app, ["disk", str(mesh), str(tmp_path / "out.obj"), "--html", str(place)])
        assert done.exit_code == 1 and told in done.output
        assert not (tmp_path / "out.obj").exists()


def installed_web(folder: Path) -> Path:
    """A copy of the sources with what npm installs from the lock file."""
    if shutil.which("npm") is None or shutil.which("node") is None:
        pytest.skip("no npm")
    web = folder / "web"
    shutil.copytree(WEB, web, ignore=shutil.ignore_patterns("node_modules"))
    environment = {**os.environ, "npm_config_cache": str(folder / "cache"), "npm_config_update_notifier": "false"}
    try:
        done = subprocess.run(["npm", "ci"], cwd=web, env=environment, capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        pytest.skip("npm has no registry at hand")
    if done.returncode and re.search(r"E(NOTFOUND|AI_AGAIN|CONN|TIMEDOUT)|network", done.stderr):
        pytest.skip("npm has no registry at hand")
    assert done.returncode == 0, done.stderr
    return web


def test_the_built_program_is_what_its_sources_make(tmp_path: Path) -> None:
    web = installed_web(tmp_path)
    subprocess.run(["node", "build.mjs", str(tmp_path / "page.js")], cwd=web, check=True, capture_output=True)
    assert (tmp_path / "page.js").read_bytes() == BUILT.read_bytes(), "run: cd web && npm ci && npm run build"
    subprocess.run(["npm", "test"], cwd=web, check=True, capture_output=True)


def test_the_lock_file_names_no_registry() -> None:
    lock = json.loads((WEB / "package-lock.json").read_text())
    assert "http" not in (WEB / "package-lock.json").read_text()
    assert all("integrity" in package for name, package in lock["packages"].items() if name)

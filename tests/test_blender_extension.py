"""The extension as a user gets it: built, installed from its zip in a fresh user folder, used in a new process."""

from __future__ import annotations

import os
import platform
import py_compile
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import blender_process
import pytest

from conformal_uv import __version__
from tools.blender_tool import BlenderTool
from tools.build_extension import build_extension
from tools.errors import ReleaseError
from tools.extension_builds import DISTRIBUTION
from tools.reproducible import write_zip

pytestmark = pytest.mark.skipif(bool(blender_process.missing_blender()), reason=blender_process.missing_blender())

BROUGHT = ("scipy", "cvxopt", "mapbox_earcut", "conformal_uv", "__editable__")
HERE = {
    ("Linux", "x86_64"): "linux-x64",
    ("Linux", "aarch64"): "linux-arm64",
    ("Windows", "AMD64"): "windows-x64",
    ("Darwin", "arm64"): "macos-arm64",
    ("Darwin", "x86_64"): "macos-x64",
}.get((platform.system(), platform.machine()))


@pytest.fixture(scope="module")
def extension(tmp_path_factory) -> Path:
    """The zip for this platform and Blender: the one that CONFORMAL_UV_EXTENSION_ZIP names, else built now."""
    given = os.environ.get("CONFORMAL_UV_EXTENSION_ZIP")
    if given:
        return Path(given).resolve()
    if HERE is None:
        pytest.skip(f"no zip for {platform.system()} on {platform.machine()}")
    python = blender_process.run_python("-c", "import sys; print('cp%d%d' % sys.version_info[:2])").stdout.strip()
    done = subprocess.run(
        [sys.executable, "-m", "tools.release", "--platform", HERE, "--python", python]
        + ["--output", str(tmp_path_factory.mktemp("extension")), "--bpy-python", blender_process.blender_python()],
        cwd=blender_process.REPOSITORY,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return Path(done.stdout.strip())


@pytest.fixture(scope="module")
def packages(tmp_path_factory) -> Path:
    """The packages of Blender's Python but for what the extension must bring, and a conformal_uv to stay out of."""
    found = blender_process.run_python("-c", "import sysconfig; print(sysconfig.get_paths()['platlib'])")
    folder = tmp_path_factory.mktemp("packages")
    for path in Path(found.stdout.strip()).iterdir():
        if not path.name.lower().startswith(BROUGHT) and path.suffix != ".pth":
            (folder / path.name).symlink_to(path)
    (folder / "conformal_uv").mkdir()
    (folder / "conformal_uv" / "__init__.py").write_text("raise RuntimeError('this is not what the extension carries')")
    return folder


def test_zip(extension, tmp_path):
    with zipfile.ZipFile(extension) as archive:
        names = archive.namelist()
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        archive.extractall(tmp_path, [name for name in names if name.endswith(".py")])
    assert extension.stat().st_size <= 65_000_000
    assert manifest["version"] == __version__
    assert manifest["license"] == ["SPDX:GPL-3.0-or-later"] and "LICENSE" in names
    assert manifest["copyright"] and set(manifest["permissions"]) == {"files"} and len(manifest["platforms"]) == 1
    assert names == sorted(names) and not any("__pycache__" in name for name in names)
    wheels = [name.rpartition("/")[2] for name in names if name.endswith(".whl")]
    assert sorted(wheels) == sorted(path.rpartition("/")[2] for path in manifest["wheels"])
    assert not any(wheel.startswith(("numpy", "conformal_uv")) for wheel in wheels)
    assert {wheel.split("-")[0] for wheel in wheels} >= {"scipy", "mapbox_earcut"}
    assert len({wheel.split("-")[2] for wheel in wheels}) == 1  # one Python's alone
    for path in tmp_path.rglob("*.py"):
        py_compile.compile(str(path), cfile=str(tmp_path / "compiled"), doraise=True)


def test_install_and_use(extension, packages, tmp_path):
    """Beside another conformal_uv, which is left alone, and without any."""
    script = str(blender_process.FOLDER / "installed_extension.py")
    for task in (("install", str(extension)), ("use", str(tmp_path)), ("use", str(tmp_path))):
        done = blender_process.run_python(
            "-S", script, str(packages), *task, BLENDER_USER_RESOURCES=str(tmp_path), PYTHONPATH=""
        )
        assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
        if task[0] == "use":
            assert "error" in done.stdout
            shutil.rmtree(packages / "conformal_uv", ignore_errors=True)
    assert not (packages / "conformal_uv").exists()


def test_the_zip_without_wheels_is_valid_and_reproducible(tmp_path):
    tool = BlenderTool(blender_process.blender_python())
    built = []
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        build = (blender_process.REPOSITORY, DISTRIBUTION, __version__, tmp_path / name, tmp_path, tool, 1_750_000_000)
        built.append(build_extension(*build))
    assert built[0].read_bytes() == built[1].read_bytes()
    with zipfile.ZipFile(built[0]) as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
    assert manifest["version"] == f"{__version__}+distribution" and "wheels" not in manifest
    tool.check_distinct([built[0]])
    (tmp_path / "again.zip").write_bytes(built[0].read_bytes())
    with pytest.raises(ReleaseError, match="duplicate"):
        tool.check_distinct([built[0], tmp_path / "again.zip"])


def test_blender_says_what_is_not_valid(tmp_path):
    write_zip(tmp_path / "a.zip", {"__init__.py": b"", "blender_manifest.toml": b'id = "a"\n'}, 1_750_000_000)
    with pytest.raises(ReleaseError, match="schema_version"):
        BlenderTool(blender_process.blender_python()).validate(tmp_path / "a.zip")


def test_a_python_that_is_not_there_is_told(tmp_path):
    with pytest.raises(ReleaseError, match="has no bpy"):
        BlenderTool(str(tmp_path / "python"))

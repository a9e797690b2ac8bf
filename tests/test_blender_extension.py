"""The extension as a user gets it: built, installed from its zip in a fresh user folder, used in a new process."""

from __future__ import annotations

import os
import platform
import py_compile
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import blender_process
import pytest

from conformal_uv import __version__

pytestmark = pytest.mark.skipif(bool(blender_process.missing_blender()), reason=blender_process.missing_blender())

BROUGHT = ("scipy", "cvxopt", "rpack", "rectangle_packer", "mapbox_earcut", "conformal_uv", "__editable__")
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
    assert {wheel.split("-")[0] for wheel in wheels} >= {"scipy", "rectangle_packer"}
    assert len({wheel.split("-")[2] for wheel in wheels}) == 1  # one Python's alone
    for path in tmp_path.rglob("*.py"):
        py_compile.compile(str(path), cfile=str(tmp_path / "compiled"), doraise=True)


def test_install_and_use(extension, packages, tmp_path):
    script = str(blender_process.FOLDER / "installed_extension.py")
    for task in (("install", str(extension)), ("use", str(tmp_path))):
        done = blender_process.run_python(
            "-S", script, str(packages), *task, BLENDER_USER_RESOURCES=str(tmp_path), PYTHONPATH=""
        )
        assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    assert "error" in done.stdout

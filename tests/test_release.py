"""What a release is made of: one version, relative imports, zips that do not overlap, reproducible archives."""

from __future__ import annotations

import hashlib
import io
import re
import shutil
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

from conformal_uv import __version__
from tools import build_extension, extension_manifest, release, reproducible
from tools.conda_recipe import write_recipe
from tools.errors import ReleaseError
from tools.extension_builds import BUILDS, DISTRIBUTION, Build
from tools.extension_files import extension_files
from tools.relative_imports import absolute_imports, with_relative_imports
from tools.versions import WRITTEN, agreed_version

ROOT = Path(__file__).resolve().parent.parent
DATE = 1_750_000_000


@pytest.fixture
def versions(tmp_path: Path) -> Path:
    """A copy of the files that tell the version."""
    for name in WRITTEN:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    return tmp_path


def test_the_version_is_the_same_everywhere() -> None:
    assert agreed_version(ROOT) == __version__


@pytest.mark.parametrize("name", WRITTEN)
def test_a_version_that_differs_is_refused_with_its_file(versions: Path, name: str) -> None:
    path = versions / name
    path.write_text(path.read_text().replace(__version__, "9.9.9", 1))
    with pytest.raises(ReleaseError, match=rf"{name} 9\.9\.9"):
        agreed_version(versions)


def test_a_file_without_a_version_is_refused(versions: Path) -> None:
    (versions / "CHANGELOG.md").write_text("# Changelog\n")
    with pytest.raises(ReleaseError, match=r"CHANGELOG\.md tells no version"):
        agreed_version(versions)


@pytest.mark.parametrize(
    ("path", "line", "expected"),
    [
        ("worker.py", "from conformal_uv import CancelledError", "from .conformal_uv import CancelledError"),
        ("a.py", "from conformal_uv.files import x", "from .conformal_uv.files import x"),
        ("ui/a.py", "from conformal_uv import x", "from ..conformal_uv import x"),
        ("a.py", "def f():\n    from conformal_uv import (\n        x,\n    )", None),
        ("a.py", "from . import x\nNAME = 'conformal_uv'  # from conformal_uv import x", "from . import x"),
    ],
)
def test_imports_of_the_core_become_relative(path: str, line: str, expected: str | None) -> None:
    found = with_relative_imports(line, path)
    assert not absolute_imports(found, path)
    assert found.startswith(expected or "def f():\n    from .conformal_uv import (\n")
    assert found.count("\n") == line.count("\n") and found.endswith(line[-8:])


@pytest.mark.parametrize(
    "line",
    [
        "import conformal_uv",
        "import numpy, conformal_uv.files as files",
        "from blender_addon import worker",
        "import_module('conformal_uv.disk')",
        "importlib.util.find_spec('conformal_uv')",
        "__import__('conformal_uv')",
        "logging.getLogger('conformal_uv')",
    ],
)
def test_what_would_find_another_copy_is_refused(line: str) -> None:
    with pytest.raises(ReleaseError, match=r"a\.py, line 2"):
        with_relative_imports(f"\n{line}\n", "a.py")


def test_the_extension_carries_addon_and_core() -> None:
    files = extension_files(ROOT)
    assert {"LICENSE", "__init__.py", "worker.py", "conformal_uv/__init__.py", "conformal_uv/py.typed"} <= set(files)
    rooms = ("cli", "console", "page", "pictures", "show")
    assert not any(name.startswith(tuple(f"conformal_uv/{room}/" for room in rooms)) for name in files)
    assert not any("__pycache__" in name or name.endswith(".pyc") for name in files)
    changed = []
    for name, data in files.items():
        source = ROOT / (name if name == "LICENSE" or name.startswith("conformal_uv/") else f"blender_addon/{name}")
        if data != source.read_bytes():
            changed.append(name)
        if name.endswith(".py"):
            compile(data, name, "exec")
            assert not absolute_imports(data.decode(), name)
    assert changed and not any(name.startswith("conformal_uv/") for name in changed)


def test_a_core_that_names_itself_is_refused(tmp_path: Path) -> None:
    for name in ("blender_addon", "conformal_uv"):
        (tmp_path / name).mkdir()
    (tmp_path / "LICENSE").write_text("")
    (tmp_path / "conformal_uv" / "disk.py").write_text("from conformal_uv.mesh import Surface\n")
    with pytest.raises(ReleaseError, match=r"conformal_uv/disk\.py, line 1"):
        extension_files(tmp_path)


def test_zips_share_no_platform_and_blender() -> None:
    assert len({(build.platform, build.blender[0]) for build in BUILDS}) == len(BUILDS)
    assert {build.blender for build in BUILDS} == {("4.2.0", "5.1.0"), ("5.1.0", "")}
    assert Build("windows-arm64", "cp311") not in BUILDS and Build("windows-arm64", "cp313") in BUILDS
    everything = [*BUILDS, DISTRIBUTION]
    assert len({build.filename("1.2.3") for build in everything}) == len(everything)
    assert {build.version("1.2.3") for build in BUILDS} == {"1.2.3"}
    assert DISTRIBUTION.version("1.2.3") == "1.2.3+distribution" and not DISTRIBUTION.requirements


def test_the_manifest_says_what_the_review_asks_for(monkeypatch: pytest.MonkeyPatch) -> None:
    build = Build("linux-x64", "cp311")
    told = tomllib.loads(extension_manifest.manifest(build, "1.2.3", ["a.whl"]))
    assert told["wheels"] == ["./wheels/a.whl"] and told["platforms"] == ["linux-x64"]
    assert (told["blender_version_min"], told["blender_version_max"]) == build.blender
    for text in (told["tagline"], *told["permissions"].values()):
        assert 0 < len(text) <= 64 and text[-1].isalnum()
    assert "website" not in told
    monkeypatch.setattr(extension_manifest, "WEBSITE", "https://example.org")
    told = tomllib.loads(extension_manifest.manifest(DISTRIBUTION, "1.2.3", []))
    assert told["website"] == "https://example.org"
    assert not {"wheels", "platforms", "blender_version_max"} & set(told)


def test_zips_of_the_same_files_are_the_same(tmp_path: Path) -> None:
    one, other = {"b.py": b"x" * 99, "a.whl": b"y" * 99}, {"a.whl": b"y" * 99, "b.py": b"x" * 99}
    for name, files in (("one", one), ("other", other)):
        reproducible.write_zip(tmp_path / name, files, DATE)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()
    with zipfile.ZipFile(tmp_path / "one") as archive:
        assert archive.namelist() == ["a.whl", "b.py"] and archive.read("b.py") == one["b.py"]
        assert archive.getinfo("a.whl").compress_type == zipfile.ZIP_STORED
    reproducible.rewritten_wheel(tmp_path / "one", DATE)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()


def test_sdists_of_the_same_files_are_the_same(tmp_path: Path) -> None:
    for k, names in enumerate((["p/a", "p/b"], ["p/b", "p/a"])):
        with tarfile.open(tmp_path / f"{k}.tar.gz", "w:gz") as archive:
            for name in names:
                entry = tarfile.TarInfo(name)
                entry.size, entry.mtime, entry.uid, entry.uname = 3, DATE + k, 1000 + k, f"user{k}"
                archive.addfile(entry, io.BytesIO(name.encode()))
        reproducible.rewritten_sdist(tmp_path / f"{k}.tar.gz", DATE)
    assert (tmp_path / "0.tar.gz").read_bytes() == (tmp_path / "1.tar.gz").read_bytes()
    with tarfile.open(tmp_path / "0.tar.gz") as archive:
        assert [(member.name, member.mtime, member.uid) for member in archive] == [("p/a", DATE, 0), ("p/b", DATE, 0)]


def test_the_date_is_given_or_the_commits(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", str(DATE))
    assert reproducible.source_date(ROOT) == DATE
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    assert reproducible.source_date(ROOT) == reproducible.FIRST  # a zip knows no earlier time
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    assert reproducible.source_date(tmp_path) == reproducible.FIRST


class AnyZip:
    """A tool that takes everything for valid, or nothing."""

    def __init__(self, valid: bool = True) -> None:
        self.valid = valid

    def validate(self, path: Path) -> None:
        if not self.valid:
            raise ReleaseError("not valid")

    def check_distinct(self, paths) -> None:
        assert not list(paths)  # a zip that is not self-contained is not listed with the others


@pytest.mark.parametrize("valid", [True, False])
def test_only_what_is_valid_is_handed_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, valid: bool) -> None:
    monkeypatch.setattr(release, "BlenderTool", lambda python: AnyZip(valid))
    code = release.main(["--platform", "distribution", "--output", str(tmp_path), "--wheels", str(tmp_path / "wheels")])
    found = [path.name for path in tmp_path.iterdir() if path.name != "wheels"]
    assert (code, found) == ((0, [DISTRIBUTION.filename(__version__)]) if valid else (1, []))


def test_a_zip_that_is_too_large_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build_extension, "LARGEST", 1000)
    with pytest.raises(ReleaseError, match="more than 1000"):
        build_extension.build_extension(ROOT, DISTRIBUTION, "1.2.3", tmp_path, tmp_path, AnyZip(), DATE)


def test_a_zip_that_there_is_not_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        release.main(["--platform", "windows-arm64", "--python", "cp311"])
    assert stop.value.code == 2 and "no such zip" in capsys.readouterr().err


def test_checksums_are_those_that_sha256sum_reads(tmp_path: Path) -> None:
    for name in ("b", "a"):
        (tmp_path / name).write_text(name)
    text = release.write_checksums([tmp_path / "b", tmp_path / "a"], tmp_path / "SHA256SUMS").read_text()
    assert text == (
        "ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb  a\n"
        "3e23e8160039594a33894f6564e1b1348bbd7a0088d42c4acb73eeaed59c009d  b\n"
    )


def test_the_conda_recipe_asks_for_what_pip_asks_for(tmp_path: Path) -> None:
    sdist = tmp_path / "conformal_uv-1.2.3.tar.gz"
    sdist.write_bytes(b"source")
    text = write_recipe(ROOT, "1.2.3", sdist, tmp_path / "meta.yaml").read_text()
    assert 'set version = "1.2.3"' in text and f"url: {sdist.name}" in text
    assert hashlib.sha256(b"source").hexdigest() in text
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    run = text[text.index("  run:") : text.index("test:")].split("    - ")[1:]
    names = {line.split()[0].replace("_", "-") for line in run}
    assert names == {"python", *(re.match(r"[a-z-]+", one)[0] for one in project["dependencies"])}
    assert all(re.fullmatch(r"\S+ [<>=0-9.,]+\s*", line) for line in run)
    assert all(f"{name} = {place}" in text for name, place in project["scripts"].items())


def test_a_requirement_that_is_not_understood_is_told(tmp_path: Path) -> None:
    (tmp_path / "pyproject.toml").write_text(
        '[build-system]\nrequires = ["setuptools"]\n[project]\nrequires-python = ">=3.11"\ndescription = ""\n'
        'license = ""\nscripts = {}\ndependencies = ["a @ file"]\n'
    )
    (tmp_path / "a.tar.gz").write_bytes(b"")
    with pytest.raises(ReleaseError, match="'a @ file', which is not understood"):
        write_recipe(tmp_path, "1", tmp_path / "a.tar.gz", tmp_path / "meta.yaml")

"""Every code block of README and docs runs; links lead somewhere; pictures say what is on them."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from docs_blocks import REPOSITORY, Block, blocks, pages
from meshes_closed import icosphere

import conformal_uv as cuv
from conformal_uv.files import MeshFile, write_mesh
from conformal_uv.samples import mask

NAMES = [str(page.relative_to(REPOSITORY)) for page in pages()]
# Blocks of Blender and of MPI run in processes of their own, by tests/blender and tests/test_distributed.py, and here
# there is no cluster that Slurm manages: they are only compiled.
ELSEWHERE = re.compile(r"\bbpy\b|\bblender_addon\b|\bdistributed_disk_map\b|\bdask_jobqueue\b")
# What installs, builds, tests or measures for minutes; CI and other tests run these.
NOT_HERE = re.compile(r"pip install|apt-get|mpiexec|conda |pytest|python|pre-commit|blender|coverage|sha256sum")


def has(name: str, language: str) -> bool:
    return any(block.language == language for block in blocks(REPOSITORY / name))


def given(folder: Path, name: str) -> dict:
    """What pages that begin in the middle take for granted: meshes, and files in the folder."""
    V, F = mask(1500)
    closed_V, closed_F = icosphere(2)
    loop = cuv.DiskMapper(V, F).boundary  # numbered first, so that pages can name boundary vertices
    order = np.concatenate((loop, np.setdiff1d(np.arange(len(V)), loop)))
    V, F = V[order], np.argsort(order)[F]
    for file in ("scan.obj", "scan.ply"):
        mesh = cuv.PolygonMesh(V, F.reshape(-1), np.arange(0, F.size + 1, 3))
        write_mesh(folder / file, MeshFile(folder / file, mesh), corner_uv=V[mesh.corners, :2])
    if name == "docs/pymeshlab.md":
        Image = pytest.importorskip("PIL.Image")  # noqa: N806
        Image.new("RGB", (16, 16)).save(folder / "checker.png")
    turning = np.full(len(loop), 2 * np.pi / len(loop))
    if name == "docs/sphere.md":
        V, F = closed_V, closed_F
    edges = np.sort(F[:1, :2], axis=1)
    return {
        "V": V, "F": F, "polygons": F, "edges": edges, "closed_V": closed_V, "closed_F": closed_F,
        "turning": turning, "u": np.zeros(len(loop)),
    }  # fmt: skip


def shell(folder: Path) -> dict[str, str]:
    """An environment whose conformal-uv is that of the repository."""
    programs = folder / "bin"
    programs.mkdir()
    command = programs / "conformal-uv"
    command.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m conformal_uv "$@"\n')
    command.chmod(0o755)
    paths = os.pathsep.join([str(REPOSITORY), os.environ.get("PYTHONPATH", "")])
    return {**os.environ, "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": paths}


def run_shell(block: Block, folder: Path, environment: dict[str, str]) -> None:
    done = subprocess.run(
        ["bash", "-euc", block.code], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"line {block.line}: {done.stdout}{done.stderr}"


def begins_anew(name: str) -> bool:
    """Pages that are whole scripts: nothing is given to them, and their commands run as well."""
    return name.startswith("docs/tutorials/") or name in {"docs/index.md", "docs/howto.md"}


@pytest.mark.filterwarnings("ignore")  # of libraries that pages use
@pytest.mark.parametrize("name", [name for name in NAMES if begins_anew(name) or has(name, "python")])
def test_blocks_run(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    known = {"__name__": "page"} if begins_anew(name) else {"__name__": "page", **given(tmp_path, name)}
    environment = shell(tmp_path)
    for block in blocks(REPOSITORY / name):
        if block.language == "python":
            for module in re.findall(r"^(?:import|from) (pymeshlab|nibabel|PIL|bpy)\b", block.code, re.MULTILINE):
                if module != "bpy":
                    pytest.importorskip(module)
            code = compile("\n" * (block.line - 1) + block.code, str(REPOSITORY / name), "exec")
            if not ELSEWHERE.search(block.code):
                exec(code, known)
        elif block.language == "sh" and begins_anew(name):
            if shutil.which("bash") is None:
                pytest.skip("no bash")
            run_shell(block, tmp_path, environment)


def commands(name: str) -> list[list[str]]:
    """Calls of conformal-uv in shell blocks, up to a pipe or a redirection."""
    lines = "\n".join(block.code for block in blocks(REPOSITORY / name) if block.language == "sh")
    found = re.findall(r"^\s*(conformal-uv [^\n]*)", lines, re.MULTILINE)
    return [shlex.split(re.split(r"[|<>;&]", line.split(" # ")[0].split("  #")[0])[0]) for line in found]


@pytest.mark.parametrize("name", [name for name in NAMES if not begins_anew(name) and has(name, "sh")])
def test_commands_of_pages_are_taken(name: str) -> None:
    """Names of commands and options, by the command line's own parser; nothing is run."""
    typer = pytest.importorskip("typer")
    from conformal_uv.cli.app import app

    group = typer.main.get_command(app)
    for block in blocks(REPOSITORY / name):
        if block.language == "sh":
            lines = re.sub(r"\n[ \t]+", " ", block.code).splitlines()
            for line in filter(None, (line.split("#")[0].strip() for line in lines)):
                assert line.startswith("conformal-uv") or NOT_HERE.search(line), f"{line!r} is run by no test"
    for words in commands(name):
        if words[1].startswith("--"):
            assert words[1] in {"--install-completion", "--help", "--version"}
            continue
        command = group.commands[words[1]]  # type: ignore[attr-defined]
        taken = {option for parameter in command.params for option in parameter.opts}
        unknown = {word.split("=")[0] for word in words[2:] if word.startswith("--")} - taken
        assert not unknown, f"{' '.join(words)}: no option {unknown}"


LINK = re.compile(r"(?<!`)(!?)\[([^\]]*)\]\(([^)\s]+)\)")


@pytest.mark.parametrize("name", [*NAMES, "CHANGELOG.md"])
def test_links_lead_to_files_and_pictures_have_texts(name: str) -> None:
    page = REPOSITORY / name
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    for picture, words, target in LINK.findall(text):
        if picture:
            assert len(words) > 10, f"{target} has no text for those who can not see it"
        if re.match(r"\w+:", target):
            continue
        path = target.split("#")[0]
        assert not path or (page.parent / path).exists(), f"{target} is missing"


def test_every_public_name_is_on_the_api_page() -> None:
    shown = re.findall(r"^::: ([\w.]+)$", (REPOSITORY / "docs" / "api.md").read_text(encoding="utf-8"), re.MULTILINE)
    names = [full.rpartition(".")[2] for full in shown]
    assert sorted(names) == sorted(set(cuv.__all__) - {"__version__"})
    for full, name in zip(shown, names, strict=True):
        home = getattr(getattr(cuv, name), "__module__", "")
        assert full == f"{home}.{name}" or not home.startswith("conformal_uv")


GALLERY = REPOSITORY / "docs" / "gallery"
SCRIPTS = {path.stem for path in (REPOSITORY / "examples" / "gallery").glob("*.py")} - {"scene", "surfaces"}


def test_every_picture_of_the_gallery_has_a_script_and_is_light() -> None:
    pictures = {path.stem: path.stat().st_size for path in GALLERY.glob("*.webp")}
    assert set(pictures) == SCRIPTS and len(pictures) >= 16
    assert max(pictures.values()) < 150_000
    text = (GALLERY / "index.md").read_text(encoding="utf-8")
    assert all(
        f"({name}.webp)" in text and f'--8<-- "examples/gallery/{name}.py"' in text for name in SCRIPTS - {"hero"}
    )


@pytest.mark.parametrize("name", sorted(SCRIPTS))
def test_gallery_script_draws(name: str, tmp_path: Path) -> None:
    """Where the extra gallery is installed; CONFORMAL_UV_GALLERY=1 asks for it, for it takes minutes."""
    if not os.environ.get("CONFORMAL_UV_GALLERY"):
        pytest.skip("set CONFORMAL_UV_GALLERY=1 to draw the gallery")
    script, target = REPOSITORY / "examples" / "gallery" / f"{name}.py", tmp_path / "picture.webp"
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY)}
    subprocess.run([sys.executable, str(script), str(target)], env=environment, check=True)
    assert target.read_bytes()[8:12] == b"WEBP" and target.stat().st_size < 150_000

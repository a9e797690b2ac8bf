"""The extension inside Blender's own process: these files are collected only there (see tests/test_blender.py)."""

from __future__ import annotations

import importlib
import os
import sys
from pathlib import Path

import pytest

INSIDE = "CONFORMAL_UV_INSIDE_BLENDER"
REPOSITORY = Path(__file__).resolve().parents[2]

MODULE = os.environ.get("CONFORMAL_UV_BLENDER_MODULE", "blender_addon")

if not os.environ.get(INSIDE):
    collect_ignore_glob = ["*.py"]
elif MODULE == "blender_addon":
    sys.path.insert(0, str(REPOSITORY))
else:
    importlib.import_module("bpy")
    if importlib.import_module("addon_utils").enable(MODULE) is None:
        raise RuntimeError(f"{MODULE} can not be enabled")
    importlib.import_module("installed_names").InstalledNames(MODULE).install()


@pytest.fixture(scope="session")
def addon():
    """The extension, registered: the repository's, or the installed one that CONFORMAL_UV_BLENDER_MODULE names."""
    module = importlib.import_module(MODULE)
    if MODULE != "blender_addon":
        yield module
        return
    module.register()
    yield module
    module.unregister()


@pytest.fixture(autouse=True)
def empty_file(addon):
    """Every test begins in a file without objects, with default settings."""
    import bpy

    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    yield
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


@pytest.fixture
def factorizations(addon, monkeypatch):
    """A list that gets an entry for every factorization."""
    import conformal_uv.operators.dirichlet as dirichlet

    counted = []
    factorize = dirichlet.linear_solver

    def counting(matrix, *arguments, **keywords):
        counted.append(matrix.n)
        return factorize(matrix, *arguments, **keywords)

    monkeypatch.setattr(dirichlet, "linear_solver", counting)
    return counted

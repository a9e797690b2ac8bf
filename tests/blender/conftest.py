"""The extension inside Blender's own process: these files are collected only there (see tests/test_blender.py)."""

from __future__ import annotations

import importlib
import os
import sys
from pathlib import Path

import pytest

INSIDE = "CONFORMAL_UV_INSIDE_BLENDER"
REPOSITORY = Path(__file__).resolve().parents[2]

if not os.environ.get(INSIDE):
    collect_ignore_glob = ["*.py"]


@pytest.fixture(scope="session")
def addon():
    """The extension, registered: the repository's, or the one that CONFORMAL_UV_BLENDER_MODULE names."""
    name = os.environ.get("CONFORMAL_UV_BLENDER_MODULE", "blender_addon")
    if name == "blender_addon":
        sys.path.insert(0, str(REPOSITORY))
        module = importlib.import_module(name)
        module.register()
        yield module
        module.unregister()
    else:
        yield importlib.import_module(name)


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
    factorize = dirichlet.factorize

    def counting(matrix, *arguments, **keywords):
        counted.append(matrix.n)
        return factorize(matrix, *arguments, **keywords)

    monkeypatch.setattr(dirichlet, "factorize", counting)
    return counted

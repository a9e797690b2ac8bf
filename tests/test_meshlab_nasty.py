"""Every nasty mesh through the filter, in a process of its own: mapped or refused, alive, the MeshSet as it was.

Run as a script, this file tells about each mesh in a line of JSON.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

import nasty_meshes
from fuzz_meshes import random_mesh

SEEDS = range(200)

# What unwrap mends or splits where disk_map refuses; all others of its refusals hold for unwrap too.
MAPPED = {*nasty_meshes.EMBEDDED, "soup", "unreferenced vertex", "annulus", "two components"}
OPTIONS = {"closed": "cut", "nonmanifold": "cut", "orientation": "mend"}


def cases() -> dict[str, tuple[Any, dict[str, str]]]:
    """Names to (mesh, options): the nasty meshes strictly and leniently, and random ones leniently."""
    nasty = dict(nasty_meshes.EMBEDDED) | {name: mesh for name, (_, mesh) in nasty_meshes.REFUSED.items()}
    told = {name: (mesh, {}) for name, mesh in nasty.items()}
    told |= {f"{name}, mended": (mesh, OPTIONS) for name, mesh in nasty.items()}
    return told | {f"random {seed}": (random_mesh(seed), OPTIONS) for seed in SEEDS}


def outcome(mesh: Any, options: dict[str, str]) -> dict[str, Any]:
    """What the filter did to a MeshSet with this mesh."""
    import numpy as np
    from meshlab_sets import TEXCOORDS, changed, contents, mesh_set

    from meshlab_filter import compute_texcoord_parametrization_conformal_disk

    ms = mesh_set(*mesh)
    before = contents(ms)
    try:
        numbers = compute_texcoord_parametrization_conformal_disk(ms, quality="quasi-conformal", **options)
    except pymeshlab.PyMeshLabException as error:
        return {"refused": type(error.__cause__).__name__, "changed": sorted(changed(before, contents(ms)))}
    uv = ms.current_mesh().wedge_tex_coord_matrix()
    rest = changed(before, contents(ms)) - {*TEXCOORDS, "face_scalars"}
    finite = np.isfinite(uv).all() and np.isfinite(ms.current_mesh().face_scalar_array()).all()
    inside = bool((uv >= 0).all() and (uv <= 1).all())
    return {"numbers": numbers, "changed": sorted(rest), "finite": bool(finite), "inside": inside}


def main() -> None:
    """Tell the outcomes, line by line, so that what came before a crash is known."""
    for name, case in cases().items():
        sys.stdout.write(json.dumps({"name": name, **outcome(*case)}) + "\n")
        sys.stdout.flush()


@pytest.fixture(scope="module")
def outcomes() -> dict[str, dict[str, Any]]:
    command = [sys.executable, "-W", "ignore", str(Path(__file__))]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    told = {line["name"]: line for line in lines}
    if done.returncode:
        last = lines[-1]["name"] if lines else "nothing"
        pytest.fail(f"the process ended with {done.returncode} after {last}: {done.stderr[-2000:]}")
    return told


@pytest.mark.parametrize("name", [name for name in cases() if not name.startswith("random")])
def test_nasty_mesh_is_mapped_or_refused_and_the_mesh_set_intact(name: str, outcomes):
    told = outcomes[name]
    assert told["changed"] == []
    kind = name.removesuffix(", mended")
    if kind in MAPPED:
        assert "numbers" in told, told
    elif not name.endswith("mended"):
        assert told["refused"] == nasty_meshes.REFUSED[name][0]
    if "numbers" in told:
        numbers = told["numbers"]
        assert told["finite"] and told["inside"]
        assert numbers["faces"] - numbers["mapped_faces"] == (2 if name == "duplicate face, mended" else 0)
        if not kind.startswith(("ribbon", "serpentine", "x stretched")):  # there an embedding costs too many angles
            assert numbers["flipped_polygons"] == 0
    else:
        assert told["refused"].endswith("Error")


def test_all_nasty_meshes_but_one_can_be_mended(outcomes):
    refused = {name: told["refused"] for name, told in outcomes.items() if "refused" in told and "mended" in name}
    assert refused == {"NaN, mended": "NonFiniteError"}


def test_random_meshes_are_mapped_or_refused_and_the_mesh_set_intact(outcomes):
    told = [outcomes[f"random {seed}"] for seed in SEEDS]
    assert [line["name"] for line in told if line["changed"]] == []
    mapped = [line for line in told if "numbers" in line]
    assert [line["name"] for line in mapped if not (line["finite"] and line["inside"])] == []
    assert len(mapped) > len(SEEDS) / 4 and len(mapped) < len(SEEDS)  # both ways were tried
    assert all(line["refused"].endswith("Error") for line in told if "refused" in line)


if __name__ == "__main__":
    main()

"""The benchmark of speed on small meshes: its rows, tables and ratios, and what it says of those who fail."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from meshes_closed import icosphere

import conformal_uv as cuv
from conformal_uv.samples import flat_disk, terrain

REPOSITORY = Path(__file__).resolve().parent.parent


def module(name: str) -> ModuleType:
    """A module of the benchmark, which is no installed package."""
    return importlib.import_module(f"benchmarks.speed.{name}")


@pytest.fixture(autouse=True)
def from_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(REPOSITORY))


def run(*arguments: object, check: int = 0) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "benchmarks.speed", *map(str, arguments)]
    done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, timeout=300)
    assert done.returncode == check, done.stderr
    return done


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ours and the limit on a thousand vertices, in a process each."""
    folder = tmp_path_factory.mktemp("results")
    names = ["linear-superlu", "newton-superlu", "limit-superlu", "limit-superlu-ordered"]
    if importlib.util.find_spec("cvxopt"):
        names += ["limit-cholmod", "again-linear"]
    options = ("--meshes", "terrain", "--sizes", 1000, "--repeats", 1, "--calls", 2)
    done = run(*options, "--contestants", *names, "--out", folder)
    assert set(names) == {line.split()[2] for line in done.stdout.splitlines() if line.startswith("terrain  ")}
    return folder


def rows(folder: Path) -> dict[str, dict]:
    return {row["contestant"]: row for row in map(json.loads, (folder / "rows.jsonl").read_text().splitlines())}


def test_rows_have_times_stages_and_memory(results: Path):
    for row in rows(results).values():
        assert row["status"] == "ok" and row["note"] == ""
        assert row["n"] == 1024 and len(row["calls"]) == 2
        first = row["calls"][0]
        assert 0.0 < sum(first["stages"].values()) <= first["seconds"]
        assert row["peak"] >= row["before"]
    found = rows(results)
    assert {"checks", "assembly", "factorization", "linear", "newton"} <= set(
        found["newton-superlu"]["calls"][0]["stages"]
    )
    assert {"build", "factorization", "solves"} == set(found["limit-superlu"]["calls"][0]["stages"])


def test_the_limit_solves_its_system(results: Path):
    limits = [row for name, row in rows(results).items() if name.startswith("limit")]
    assert len(limits) >= 2
    assert all(row["later"]["residual"]["value"] < 1e-12 for row in limits)


def test_quality_is_that_of_the_map(results: Path):
    linear, newton = (rows(results)[name]["quality"] for name in ("linear-superlu", "newton-superlu"))
    assert newton["energy"] < linear["energy"] < 0.01
    for told in (linear, newton):
        assert told["flips"] == 0 and told["off_circle"] < 1e-12 and 0.0 < told["angle_mean"] < 5.0


def test_table_and_plots_are_saved(results: Path):
    text = (results / "tables.md").read_text()
    for title in ("What must hold", "Seconds", "Peak memory", "Warm", "Quality", "Stages"):
        assert f"# {title}\n" in text
    assert "| linear-superlu | " in text and "1,024" in text
    assert (results / "terrain-time.png").stat().st_size > 10_000
    assert (results / "terrain-memory.png").exists()


def test_resume_runs_nothing_again_and_a_second_start_refuses(results: Path):
    before = (results / "rows.jsonl").read_text()
    options = ("--meshes", "terrain", "--sizes", 1000, "--repeats", 1, "--out", results)
    run(*options, "--contestants", "limit-superlu", "--resume")
    assert (results / "rows.jsonl").read_text() == before
    assert "--resume" in run(*options, check=2).stderr


def test_those_who_fail_say_why_and_stop_nobody(tmp_path: Path):
    V, F = icosphere(2)
    F = F[~np.isin(F, [0, F[-1, 0]]).any(axis=1)]  # without two stars: an annulus, no disk
    write_obj(tmp_path / "ring.obj", V, F)
    names = ("linear-superlu", "limit-superlu", "blender-conformal")
    options = ("--scans", tmp_path / "ring.obj", "--sizes", 200, "--blender-python", tmp_path / "no-python")
    run("--meshes", "ring", *options, "--contestants", *names, "--repeats", 1, "--out", tmp_path / "out")
    found = rows(tmp_path / "out")
    assert [found[name]["status"] for name in names] == ["failed"] * 3
    assert "TopologyError: " in found["linear-superlu"]["note"]
    assert "boundary" in found["limit-superlu"]["note"]
    assert "no-python" in found["blender-conformal"]["note"]
    assert "TopologyError" in (tmp_path / "out" / "tables.md").read_text()


def write_obj(path: Path, V: np.ndarray, F: np.ndarray) -> None:
    module("files").write_obj(path, V, F)


def test_a_closed_scan_is_a_sphere_and_opened_a_disk(tmp_path: Path):
    V, F = icosphere(2)
    write_obj(tmp_path / "ball.obj", V, F)
    closed = {f.name: f for f in module("families").scans(tmp_path / "ball.obj", 700)}
    assert {name: (f.kind, f.sizes) for name, f in closed.items()} == {
        "ball-open": ("disk", (161, 636)),
        "ball": ("closed", (162, 642)),
    }
    for family in closed.values():
        found, faces = module("meshes").made(family.name, family.sizes[1], family.file)
        assert len(found) == family.sizes[1] and euler(faces) == (2 if family.kind == "closed" else 1)


def test_time_limit_ends_a_process_and_skips_larger_meshes(tmp_path: Path):
    options = ("--sizes", 1000, 2000, "--time-limit", 0.05, "--contestants", "linear-superlu", "--repeats", 2)
    run("--meshes", "terrain", *options, "--out", tmp_path)
    told = [json.loads(line) for line in (tmp_path / "rows.jsonl").read_text().splitlines()]
    assert [(row["status"], row["note"]) for row in told] == [
        ("over", "over 0.05 s"),
        ("skipped", "over 0.05 s at 1024 vertices"),
    ]


def test_peers_run_or_are_not_installed(tmp_path: Path):
    peers = {"libigl-lscm": "igl", "meshlab-lscm": "pymeshlab"}
    run("--meshes", "terrain", "--sizes", 400, "--repeats", 1, "--contestants", *peers, "--out", tmp_path)
    for name, package in peers.items():
        row = rows(tmp_path)[name]
        if importlib.util.find_spec(package) is not None:
            assert row["status"] == "ok" and row["quality"]["flips"] == 0 and row["quality"]["angle_mean"] < 5.0
        else:
            assert row["status"] == "not installed" and row["note"].startswith("not installed (")


def test_atlases_fans_and_files(tmp_path: Path):
    names = ["atlas-linear", "one-disk", "linear-superlu", "command", "read-obj", "read-ply", "meshio-read-ply"]
    meshes = ("islands-4", "triangles", "fan", "files")
    options = ("--sizes", 25, "--repeats", 1, "--calls", 1, "--out", tmp_path)
    run("--meshes", *meshes, "--contestants", *names, *options)
    found = [json.loads(line) for line in (tmp_path / "rows.jsonl").read_text().splitlines()]
    assert {(row["mesh"], row["contestant"]): row["n"] for row in found} == {
        ("islands-4", "atlas-linear"): 100,
        ("islands-4", "one-disk"): 100,
        ("triangles", "atlas-linear"): 75,
        ("fan", "one-disk"): 25,
        **{("files", name): 25 for name in names[3:]},
    }
    assert all(row["status"] == "ok" and row["note"] == "" for row in found)
    command = next(row for row in found if row["contestant"] == "command")
    assert {"read", "write", "factorization"} <= set(command["calls"][0]["stages"])
    assert "| islands" not in (tmp_path / "tables.md").read_text() and not list(tmp_path.glob("*.png"))


def row_of(contestant: str, size: int, seconds: float, mesh: str = "terrain", repeat: int = 0, **told: object):
    """A row as a process would have told it."""
    calls = [{"seconds": seconds, "cpu": seconds, "system": 0.0, "stages": told.pop("stages", {})}]
    given = {"status": "ok", "calls": calls, "peak": 10**9, **told}
    return module("rows").Row(mesh, size, size, 2 * size, contestant, repeat, **given)


def test_power_of_growth():
    sizes = np.array([262_144, 1_000_000, 2_300_000, 4_000_000])
    assert module("ratios").power(sizes, 3e-6 * sizes**1.27) == pytest.approx(1.27, abs=1e-12)
    measured = [row_of("linear-cholmod", int(n), 3e-6 * float(n) ** 1.4) for n in sizes]
    check = next(c for c in module("ratios").checks(measured) if c.claim.startswith("linear: power"))
    assert check.measured == pytest.approx(1.4) and check.verdict == "miss"
    without = next(c for c in module("ratios").checks(measured[:-1]) if c.claim.startswith("linear: power"))
    assert without.measured is None and without.verdict == "not measured"


def checked(measured: list) -> dict:
    """What must hold, by its claim."""
    found = module("ratios").checks(measured)
    claims = {check.claim: check for check in found}
    assert len(claims) == len(found)
    return claims


def test_ratios_of_medians_and_bounds():
    measured = [row_of("linear-cholmod", 1_000_000, s, repeat=k) for k, s in enumerate((5.0, 6.0, 90.0))]
    measured += [row_of("limit-cholmod", 1_000_000, 9.0, peak=5 * 10**8)]
    measured += [row_of("limit-cholmod-ordered", 1_000_000, s, repeat=k) for k, s in enumerate((4.0, 5.0, 50.0))]
    measured += [row_of("libigl-harmonic", 1_000_000, 15.0), row_of("filter", 1_000_000, 20.0)]
    measured += [row_of("meshlab-harmonic", 1_000_000, 0.0, status="over", note="over 300 s", calls=[])]
    found = checked(measured)
    time = found["linear-cholmod / limit, terrain 1M, time"]
    assert time.measured == pytest.approx(1.2) and time.verdict == "pass"  # of the cheaper limit
    assert time.span == pytest.approx((1.2, 1.8)) and time.goal == 1.3
    memory = found["linear-cholmod / limit, terrain 1M, memory"]
    assert memory.measured == pytest.approx(2.0) and memory.verdict == "miss"
    peer = found["libigl-harmonic / linear-cholmod, terrain 1M"]
    assert peer.measured == pytest.approx(2.5) and peer.verdict == "miss"
    slow = found["meshlab-harmonic / filter, terrain 1M"]
    assert slow.measured == pytest.approx(15.0) and slow.bound and slow.verdict == "pass"
    assert found["linear-cholmod / limit, irregular 1M, time"].verdict == "not measured"
    assert not any("david" in claim for claim in found)
    scan = [row_of(name, 170_000, 3.0, mesh="david-open") for name in ("linear-cholmod", "limit-cholmod")]
    assert checked(scan)["linear-cholmod / limit, david-open 170k, time"].measured == pytest.approx(1.0)


def test_ratios_of_atlases_files_and_blender():
    unwraps = {"blender-ours-auto": 3.0, "blender-angle": 5.0, "blender-conformal": 2.0}
    measured = [row_of(n, 10_000, 9.0, mesh="islands-4", stages={"unwrap": s}) for n, s in unwraps.items()]
    measured += [row_of("atlas-linear", size, size / 2e3, mesh="triangles") for size in (10_000, 100_000)]
    stages = {"read": 1.0, "checks": 0.5, "linear": 1.5, "distortion": 7.0, "write": 3.0, "numbers": 7.0}
    measured += [row_of("command", 1_000_000, 20.0, mesh="files", stages=stages)]
    measured += [row_of(f"{p}-read-obj", 1_000_000, s, mesh="files") for p, s in (("libigl", 2.0), ("meshio", 8.0))]
    measured += [row_of("read-obj", 1_000_000, 1.0, mesh="files"), row_of("read-ply", 1_000_000, 0.2, mesh="files")]
    found = checked(measured)
    for claim, value in (
        ("10k islands-4, in Blender, default / the faster built-in", 1.5),
        ("triangles, linear, 100k / ten times 10k", 1.0),
        ("command, reading + writing / the map, 1M OBJ", 2.0),
        ("reading an OBJ / the fastest peer, 1M", 0.5),
        ("reading a binary PLY, 1M", 0.2),
    ):
        assert found[claim].measured == pytest.approx(value), claim


def test_quality_of_known_maps():
    quality = module("quality").quality
    V, F = flat_disk(500)
    F = F.astype(np.int64)
    turned = V[:, :2] @ np.array([[0.6, -0.8], [0.8, 0.6]])
    same = quality(V, F, turned * [-1.0, 1.0])  # mirrored: measured as if it were not
    assert same["flips"] == 0 and abs(same["energy"]) < 1e-14 and same["off_circle"] < 1e-14
    assert same["angle_mean"] < 1e-10
    # A stretch by k: |f_zbar|^2 over the Jacobian, 2 (k - 1)^2 / (4 k).
    assert quality(V, F, turned * [1.0, 3.0])["energy"] == pytest.approx(2.0 * 4.0 / 12.0, rel=1e-12)
    one = turned.copy()
    one[F[100, 0]] += 5.0 * (one[F[100, 1]] + one[F[100, 2]] - 2.0 * one[F[100, 0]])
    assert quality(V, F, one)["flips"] > 0
    assert quality(V, F, np.full_like(turned, np.nan))["flips"] == len(F)


def test_subdivision_keeps_the_surface():
    meshes = module("meshes")
    V, F = terrain(100)
    finer, faces = meshes.subdivided(V, F.astype(np.int64))
    assert len(faces) == 4 * len(F)

    def area(V, F):
        return 0.5 * np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1).sum()

    assert area(finer, faces) == pytest.approx(area(V, F), rel=1e-13)
    assert euler(faces) == 1  # a disk stays a disk


def euler(F: np.ndarray) -> int:
    """Vertices less edges plus faces."""
    sides = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    return len(np.unique(F)) - len(np.unique(sides, axis=0)) + len(F)


def test_the_irregular_terrain_is_a_disk_with_negative_weights():
    V, F = module("meshes").made("irregular", 4000)
    weights = cuv.cotangent_laplacian(V, F).tocoo()
    edges = weights.row < weights.col
    assert euler(F) == 1 and len(np.unique(F)) == len(V) == 4000
    assert (weights.data[edges] > 0).mean() == pytest.approx(0.17, abs=0.01)


@pytest.mark.parametrize(
    ("family", "count", "corners"), [("islands-4", 4, 4), ("islands-25", 25, 4), ("triangles", 3, 3)]
)
def test_islands_are_apart_and_no_two_alike(family: str, count: int, corners: int):
    V, F = module("meshes").made(family, 30)
    assert len(V) == 30 * count and F.shape[1] == corners
    assert len(cuv.unwrap(V, F, method="linear").charts) == 30
    shapes = V.reshape(30, count, 3) - V.reshape(30, count, 3)[:, :1]
    assert len(np.unique(shapes.reshape(30, -1).round(9), axis=0)) == 30

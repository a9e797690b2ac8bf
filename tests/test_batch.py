"""Batches on a real scheduler with two worker processes: the maps of one process, whatever happens meanwhile."""

from __future__ import annotations

import json
import os
import signal
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from meshes_closed import icosphere

import conformal_uv as cuv
from benchmarks.batch.meshes import BROKEN, write_broken, write_cohort, write_triangles
from conformal_uv.batches import run, worked
from conformal_uv.batches.plan import Plan
from conformal_uv.batches.row import BatchRow, Outcome
from conformal_uv.batches.task import Task
from conformal_uv.samples import mask, terrain

distributed = pytest.importorskip("distributed")

COUNT = 30


@pytest.fixture(scope="module")
def cohort(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Thirty meshes, ten of them broken, each in another way."""
    folder = tmp_path_factory.mktemp("cohort")
    write_cohort(folder, COUNT, least=300, most=900, broken=10 / COUNT)
    return folder


@pytest.fixture(scope="module")
def serial(cohort: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, BatchRow]]:
    """The maps one after the other in this process, and their rows by the name of the mesh."""
    out = tmp_path_factory.mktemp("serial")
    return out, {Path(row.input).name: row for row in cuv.batch(cohort, out=out, workers=0)}


@pytest.fixture(scope="module")
def client() -> Iterator[distributed.Client]:
    from conformal_uv.batches.cluster import connected

    with connected(None, 2) as fleet:
        yield fleet.client


def plain(row: BatchRow, out: Path) -> BatchRow:
    """The row without what a clock, a process or the folder tells."""
    return replace(row, seconds=None, peak_memory=None, output=os.path.relpath(row.output, out))


def assert_same(rows: list[BatchRow], out: Path, serial: tuple[Path, dict[str, BatchRow]]) -> None:
    """Each row once, with the numbers and the bytes of the serial one."""
    there, expected = serial
    assert sorted(Path(row.input).name for row in rows) == sorted(expected)
    for row in rows:
        other = expected[Path(row.input).name]
        assert plain(row, out) == plain(other, there)
        if row.ok:
            assert Path(row.output).read_bytes() == Path(other.output).read_bytes()
    assert not list(out.rglob("*.tmp"))


def test_two_processes_make_the_maps_of_one_bit_for_bit(cohort, serial, tmp_path) -> None:
    rows = list(cuv.batch([cohort], out=tmp_path, workers=2))
    assert_same(rows, tmp_path, serial)
    assert not any(row.kept for row in rows)
    lines = [json.loads(line) for line in (tmp_path / "rows.jsonl").read_text().splitlines()]
    assert lines == [row.stored() for row in rows]  # a row as it comes
    assert sum(row.ok for row in rows) == COUNT - 10


def test_every_broken_mesh_is_told_with_its_type(tmp_path) -> None:
    V, F = terrain(400)
    for kind in BROKEN:
        write_broken(tmp_path / "..", kind, f"{tmp_path.name}/{kind}", V, F)
    rows = {Path(row.input).stem: row for row in cuv.batch(tmp_path, out=tmp_path / "maps", workers=0)}
    assert {kind: rows[kind].error for kind in BROKEN} == {kind: error for kind, (error, _) in BROKEN.items()}
    assert {row.status for row in rows.values()} == {Outcome.REFUSED}
    assert all(row.message and row.input_hash for row in rows.values())
    assert sorted(path.name for path in (tmp_path / "maps").iterdir()) == sorted(
        {"rows.csv", "rows.jsonl"} | {path.name for path in (tmp_path / "maps").glob("*.parquet")}
    )


def test_a_worker_killed_in_the_middle_loses_nothing_and_doubles_nothing(cohort, serial, client, tmp_path) -> None:
    rows = []
    for row in cuv.batch(cohort, out=tmp_path, scheduler=client):
        rows.append(row)
        if len(rows) == 8:
            os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)
    assert_same(rows, tmp_path, serial)
    assert len((tmp_path / "rows.jsonl").read_text().splitlines()) == COUNT


def test_interrupted_and_begun_again_only_the_rest_is_done(cohort, serial, client, tmp_path) -> None:
    began = cuv.batch(cohort, out=tmp_path, scheduler=client)
    first = [next(began) for _ in range(7)]
    began.close()
    with open(tmp_path / "rows.jsonl", "a") as lines:
        lines.write('{"input": "cut o')  # as a process leaves it that is killed
    made = {row.output: os.stat(row.output).st_mtime_ns for row in first if row.ok}
    rows = list(cuv.batch(cohort, out=tmp_path, scheduler=client))
    assert {row.input for row in rows if row.kept} == {row.input for row in first}
    assert {output: os.stat(output).st_mtime_ns for output in made} == made
    assert_same(rows, tmp_path, serial)
    assert all(row.kept for row in cuv.batch(cohort, out=tmp_path, scheduler=client))


def test_what_has_changed_is_done_again(tmp_path) -> None:
    for name in "abcd":
        write_triangles(tmp_path / f"{name}.ply", *mask(300, seed=ord(name)))
    out = tmp_path / "maps"

    def kept(**options: object) -> dict[str, bool]:
        rows = cuv.batch(tmp_path / "*.ply", out=out, workers=0, **options)
        return {Path(row.input).stem: row.kept for row in rows}

    assert kept() == dict.fromkeys("abcd", False)
    write_triangles(tmp_path / "a.ply", *mask(310))
    (out / "b.ply").unlink()
    (out / "c.ply").write_bytes(b"something else")
    assert kept() == {"a": False, "b": False, "c": False, "d": True}
    assert kept(method="linear") == dict.fromkeys("abcd", False)
    assert kept(method="linear") == dict.fromkeys("abcd", True)


def test_seams_are_a_part_of_what_may_change(tmp_path) -> None:
    write_triangles(tmp_path / "a.ply", *icosphere(1))
    (tmp_path / "seams.txt").write_text("0 12\n")
    options = {"out": tmp_path / "maps", "workers": 0, "closed": "cut", "seams": str(tmp_path / "seams.txt")}
    assert [row.kept for row in cuv.batch(tmp_path / "a.ply", **options)] == [False]
    assert [row.kept for row in cuv.batch(tmp_path / "a.ply", **options)] == [True]
    (tmp_path / "seams.txt").write_text("0 13\n")
    assert [row.kept for row in cuv.batch(tmp_path / "a.ply", **options)] == [False]


def test_another_version_does_it_again_and_failures_are_tried_again(tmp_path, monkeypatch) -> None:
    write_triangles(tmp_path / "a.ply", *mask(300))
    options = {"out": tmp_path / "maps", "workers": 0}
    with monkeypatch.context() as patched:
        patched.setattr(worked, "write_mesh", lambda *_, **__: (_ for _ in ()).throw(OSError("the disk is full")))
        (row,) = cuv.batch(tmp_path / "a.ply", **options)
    assert (row.status, row.error, row.message) == ("failed", "OSError", "the disk is full")
    (row,) = cuv.batch(tmp_path / "a.ply", **options)
    assert row.ok and not row.kept
    monkeypatch.setattr(worked, "__version__", "99")
    (row,) = cuv.batch(tmp_path / "a.ply", **options)
    assert row.ok and not row.kept and row.version == "99"


def test_a_mesh_that_workers_die_of_is_set_aside_after_three(client, tmp_path) -> None:
    from batch_workers import Deadly

    for number in range(6):
        write_triangles(tmp_path / f"m{number}.ply", *mask(400 + number))
    write_triangles(tmp_path / "deadly.ply", *mask(420))
    client.register_plugin(Deadly(), name="deadly")
    try:
        rows = {Path(row.input).stem: row for row in cuv.batch(tmp_path, out=tmp_path / "maps", scheduler=client)}
    finally:
        client.unregister_worker_plugin("deadly")
    assert len(rows) == 7 and all(row.ok for name, row in rows.items() if name != "deadly")
    assert (rows["deadly"].status, rows["deadly"].error) == (Outcome.KILLED, "KilledWorker")
    assert "3 workers died" in rows["deadly"].message
    assert (tmp_path / "deadly.ply.deaths").read_text().splitlines() == ["died"] * 3
    (row,) = cuv.batch(tmp_path / "deadly.ply", out=tmp_path / "maps", scheduler=client)
    assert row.ok and not row.kept  # is tried again, and workers live


@pytest.mark.parametrize(
    ("kind", "options"),
    [
        ("free", {"refine": True}),
        ("rectangle", {"corner_choice": "area"}),
        ("sphere", {"uv": "octahedral", "method": "schwarz", "format": "npz"}),
    ],
)
def test_the_other_maps_at_the_address_of_a_scheduler(kind, options, client, tmp_path) -> None:
    for number in (1, 2):
        V, F = icosphere(number + 1) if kind == "sphere" else mask(300 * number)
        write_triangles(tmp_path / f"m{number}.ply", V * [1.0, 1.5, 2.0], F)
    address = client.scheduler.address
    rows = list(cuv.batch(tmp_path, out=tmp_path / "maps", map=kind, scheduler=address, **options))
    there = {
        row.input: row for row in cuv.batch(tmp_path / "*.ply", out=tmp_path / "one", map=kind, workers=0, **options)
    }
    assert len(rows) == 2 and all(row.ok for row in rows)
    for row in rows:
        other = there[row.input]
        assert plain(row, tmp_path / "maps") == plain(other, tmp_path / "one")
        assert Path(row.output).read_bytes() == Path(other.output).read_bytes()
    (row,) = {row for row in rows if "m1" in row.input}
    V, F = icosphere(2) if kind == "sphere" else mask(300)
    V = V * [1.0, 1.5, 2.0]
    if kind == "sphere":
        assert row.conformal_energy == cuv.sphere_map(V, F, method="schwarz").conformal_energy
        assert row.signed_volume > 4.0 and row.output.endswith(".npz")
    elif kind == "rectangle":
        result = cuv.rectangle_map(V, F, corner_choice="area")
        assert (row.modulus, row.modulus_low, row.modulus_high) == (result.modulus, *result.modulus_bounds)
    else:
        assert row.conformal_energy == cuv.free_map(V, F, refine=True).conformal_energy and row.crossings == 0


def test_numbers_are_those_of_the_report(tmp_path) -> None:
    V, F = mask(500)
    write_triangles(tmp_path / "a.npz", V, F)
    (row,) = cuv.batch(tmp_path / "a.npz", out=tmp_path / "maps", workers=0, method="linear")
    numbers = cuv.unwrap_numbers(cuv.unwrap(V, F, method="linear"))
    assert (row.vertices, row.triangles, row.method) == (500, len(F), "linear")
    assert row.conformal_energy == numbers.conformal_energy and row.coverage == numbers.coverage
    for name in ("angle_mean", "angle_rms", "angle_max", "quasi_conformal_max", "area_ratio"):
        assert getattr(row, name) == getattr(numbers.distortion, name)


def test_some_charts_of_a_mesh(tmp_path) -> None:
    """An octahedron beside a triangle: only the triangle has a boundary."""
    V, F = icosphere(0)
    count = len(V)
    write_triangles(
        tmp_path / "a.ply", [*V.tolist(), [3, 0, 0], [4, 0, 0], [3, 1, 0]], [*F.tolist(), [count, count + 1, count + 2]]
    )
    rows = [next(cuv.batch(tmp_path / "a.ply", out=tmp_path / "maps", workers=0)) for _ in range(2)]
    assert [(row.status, row.error, row.charts, row.mapped_charts) for row in rows] == [
        ("partial", "TopologyError", 2, 1)
    ] * 2
    assert 'pass closed="cut"' in rows[0].message and [row.kept for row in rows] == [False, True]


def test_warnings_of_the_library_stand_in_the_row(tmp_path) -> None:
    write_triangles(tmp_path / "a.ply", *mask(300))
    (row,) = cuv.batch(tmp_path / "a.ply", out=tmp_path / "maps", workers=0, method="newton", max_iterations=1)
    assert row.converged_charts == 0 and "newton" in row.warnings


def flown(memory: int = 0, alone: bool = False) -> Any:
    from conformal_uv.batches.flight import _Flown

    return _Flown([Task("a", "b", Plan.of("disk", {}), 10, memory)], alone)


def flight_of(client: Any, memory: int | None = None, threads: int = 1) -> Any:
    from conformal_uv.batches.flight import _Flight

    return _Flight(SimpleNamespace(memory=memory, threads=threads, client=client))


def test_as_many_in_work_as_there_is_memory_for(client) -> None:
    flight = flight_of(client, 100, 2)
    assert flight.admits(flown(1000))  # alone, for it may be taken for larger than it is
    flight._flown, flight._memory = {1: flown(60)}, 60
    assert flight.admits(flown(40)) and not flight.admits(flown(41))
    flight._flown = dict.fromkeys(range(4), flown(1))
    assert not flight.admits(flown(1))  # two for each thread
    unlimited = flight_of(client)
    unlimited._flown, unlimited._memory = {1: flown(60)}, 60
    assert unlimited.admits(flown(10**12))


def landed(client: Any, task: Any, status: str, error: BaseException) -> Any:
    """What is made of a future that ended so."""

    def result() -> None:
        raise error

    flight, future = flight_of(client), type("Future", (), {"status": status, "result": staticmethod(result)})()
    flight._flown, flight._completed = {future: task}, iter([future])
    return flight.landed()


def test_who_dies_with_others_is_tried_alone_and_then_set_aside(client) -> None:
    from distributed.scheduler import KilledWorker

    error = KilledWorker("a", None, 3)  # of a scheduler as it is by default
    rows, (again,) = landed(client, flown(), "error", error)
    assert not rows and (again.alone, again.deaths) == (True, 4)
    (row,), _ = landed(client, again, "error", error)
    assert row.status == Outcome.KILLED and "8 workers died" in row.message


def test_what_else_may_come_of_a_task(client) -> None:
    from distributed.scheduler import KilledWorker

    for status, error in (("cancelled", RuntimeError()), ("lost", RuntimeError()), ("finished", OSError("closed"))):
        with pytest.raises(ConnectionError, match="has gone away"):
            landed(client, flown(), status, error)
    wrapped = RuntimeError("deserialization")
    wrapped.__cause__ = ImportError("No module named 'conformal_uv'")
    for error in (wrapped, wrapped.__cause__):
        with pytest.raises(cuv.MissingDependencyError, match="install it there"):
            landed(client, flown(), "error", error)
    (row,), again = landed(client, flown(), "error", ValueError("?"))
    assert (row.status, row.error, row.message) == (Outcome.FAILED, "ValueError", "?") and not again
    two = flown()
    two.tasks *= 2
    rows, again = landed(client, two, "error", ValueError("?"))
    assert not rows and [(len(one.tasks), one.alone, one.deaths) for one in again] == [(1, False, 0)] * 2
    rows, again = landed(client, two, "error", KilledWorker("a", None, 0))
    assert not rows and [(len(one.tasks), one.alone, one.deaths) for one in again] == [(1, True, 1)] * 2


def test_small_meshes_are_handed_over_together() -> None:
    from conformal_uv.batches.bundles import MOST, VERTICES, bundles

    def of(sizes: list[int], threads: int) -> list[list[int]]:
        plan = Plan.of("disk", {})
        tasks = [Task(str(size), "", plan, size, 100 * size) for size in sizes]
        return [[task.vertices for task in bundle] for bundle in bundles(tasks, threads)]

    assert of([5, 90_000, 7], 1) == [[90_000], [7], [5]]  # as many as there are: each thread has work
    assert of([], 2) == []
    many = of([1000] * 6000 + [VERTICES + 1], 2)
    assert sum(many, []) == [VERTICES + 1] + [1000] * 6000 and len(many[0]) == 1
    assert max(sum(bundle) for bundle in many[1:]) == MOST * 1000
    assert max(sum(bundle) for bundle in of([5000] * 1000, 2)) == VERTICES
    assert {len(bundle) for bundle in of([0] * 6400, 2)} == {MOST}
    assert len(of([1000] * 160, 2)) == 16


def test_workers_that_are_large_enough(client) -> None:
    from conformal_uv.batches.cluster import PART, Fleet

    client.wait_for_workers(2)  # one may just be beginning again
    fleet = Fleet(client)
    fleet.look()
    assert fleet.threads == 2 and fleet.memory is not None and fleet.memory > 1 << 28
    info = {"a": {"nthreads": 1, "memory_limit": 100}, "b": {"nthreads": 3, "memory_limit": 1000}}
    fleet = Fleet(SimpleNamespace(scheduler_info=lambda n_workers: {"workers": info}))
    fleet.look()
    assert (fleet.threads, fleet.memory) == (4, int(PART * 1100))
    assert fleet.large_enough(50) is None and fleet.large_enough(500) == ["b"] and fleet.large_enough(5000) is None
    info["a"]["memory_limit"] = 0  # no limit
    fleet = Fleet(SimpleNamespace(scheduler_info=lambda n_workers: {"workers": info}))
    fleet.look()
    assert fleet.memory is None and fleet.large_enough(5000) == ["a"]


def test_the_largest_first(client, tmp_path) -> None:
    for number, n in enumerate((300, 9000, 310, 320, 330, 340)):
        write_triangles(tmp_path / f"m{number}.ply", *terrain(n))
    rows = list(cuv.batch(tmp_path, out=tmp_path / "maps", workers=0))
    assert rows[0].input.endswith("m1.ply")
    assert [row.vertices for row in rows] == sorted((row.vertices for row in rows), reverse=True)


def test_a_scheduler_that_is_none(tmp_path) -> None:
    with pytest.raises(cuv.OptionError, match="pass an address"):
        next(run.run_batch([], tmp_path, scheduler=7))
    with pytest.raises(cuv.OptionError, match="leave out workers"):
        run.run_batch([], tmp_path, scheduler="tcp://127.0.0.1:1", workers=2)
    with pytest.raises(cuv.OptionError, match="workers is -1"):
        run.run_batch([], tmp_path, workers=-1)


def test_without_dask_the_extra_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    write_triangles(tmp_path / "a.ply", *mask(300))
    monkeypatch.setattr(run.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(cuv.MissingDependencyError, match=r'pip install "conformal-uv\[cluster\]"'):
        cuv.batch(tmp_path, out=tmp_path / "maps")
    (row,) = cuv.batch(tmp_path, out=tmp_path / "maps", workers=0)
    assert row.ok


def test_tables_have_all_rows_in_the_order_of_the_inputs(serial, cohort) -> None:
    import csv

    out, expected = serial
    table = list(csv.DictReader((out / "rows.csv").read_text().splitlines()))
    assert [row["input"] for row in table] == sorted(row.input for row in expected.values())
    assert Counter(row["status"] for row in table) == {"done": COUNT - 10, "refused": 10}
    for row in table:
        mean = expected[Path(row["input"]).name].angle_mean
        assert (row["angle_mean"] or None) == (None if mean is None else repr(mean))


def test_parquet_has_the_rows_too(serial) -> None:
    try:
        from pyarrow import parquet
    except ImportError:
        pytest.skip("no pyarrow that goes with this numpy")
    out, expected = serial
    rows = parquet.read_table(out / "rows.parquet").to_pylist()
    assert {Path(row["input"]).name: row for row in rows} == {name: row.stored() for name, row in expected.items()}


def test_one_run_at_a_time_in_a_folder(tmp_path) -> None:
    pytest.importorskip("fcntl")
    for name in "ab":
        write_triangles(tmp_path / f"{name}.ply", *mask(300))
    first = cuv.batch(tmp_path / "*.ply", out=tmp_path / "maps", workers=0)
    next(first)
    with pytest.raises(cuv.FileFormatError, match="another run is writing it"):
        next(cuv.batch(tmp_path / "*.ply", out=tmp_path / "maps", workers=0))
    first.close()
    assert [row.kept for row in cuv.batch(tmp_path / "*.ply", out=tmp_path / "maps", workers=0)] == [True, False]


def test_leftovers_of_the_dead_are_cleared(tmp_path) -> None:
    write_triangles(tmp_path / "a.ply", *mask(300))
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / f".{'0a' * 8}.tmp").write_bytes(b"half")
    (tmp_path / "maps" / "mine.tmp").write_bytes(b"whole")
    list(cuv.batch(tmp_path / "a.ply", out=tmp_path / "maps", workers=0))
    assert [path.name for path in (tmp_path / "maps").glob("*.tmp")] == ["mine.tmp"]
    assert not list((tmp_path / "maps").glob(".*.tmp"))

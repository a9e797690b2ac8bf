"""What must hold of the rows and maps of two runs over the same meshes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

__all__ = ["differences", "told_types"]

OF_A_RUN = {"seconds", "peak_memory", "output"}


def rows_of(out: Path) -> list[dict[str, Any]]:
    """The lines of a run."""
    return [json.loads(line) for line in (out / "rows.jsonl").read_text().splitlines()]


def told_types(out: Path, expected: dict[str, str]) -> list[str]:
    """Broken meshes that are not told of with their type, and whole ones that are told of."""
    told = {Path(row["input"]).name: row["error"] for row in rows_of(out) if row["error"] is not None}
    return [
        f"{name}: {told.get(name)} instead of {expected.get(name)}"
        for name in sorted(told.keys() | expected.keys())
        if told.get(name) != expected.get(name)
    ]


def differences(one: Path, other: Path, count: int) -> list[str]:
    """Rows that are lost, doubled or otherwise, and maps that have other bytes."""
    there, here = ({Path(row["input"]).name: row for row in rows_of(out)} for out in (one, other))
    wrong = [f"{other.name}: {len(rows_of(other))} lines for {count} meshes"] * (len(rows_of(other)) != count)
    wrong += [f"{other.name}: {name} has a row in one run only" for name in sorted(there.keys() ^ here.keys())]
    for name in sorted(there.keys() & here.keys()):
        first, second = there[name], here[name]
        fields = [field for field in first if field not in OF_A_RUN and first[field] != second[field]]
        wrong += [f"{other.name}: {name} differs in {field}" for field in fields]
        written = first["output_hash"] is not None
        if written and Path(first["output"]).read_bytes() != Path(second["output"]).read_bytes():
            wrong.append(f"{other.name}: {name} is mapped to other bytes")
    return wrong

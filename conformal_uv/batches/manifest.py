"""Lists of meshes: CSV with a header, or JSON; with a place and options for each, where they are given."""

from __future__ import annotations

import csv
import io
import json
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import FileFormatError

__all__ = ["MANIFESTS", "Entry", "read_manifest"]

MANIFESTS = (".csv", ".json")
WHOLE_NUMBERS = re.compile(r"-?\d+(\s*[,; ]\s*-?\d+)+")


@dataclass(frozen=True)
class Entry:
    """A mesh: the absolute path of its file, where its map goes below the folder of maps, and options of its own."""

    input: str
    output: str | None = None
    options: Mapping[str, Any] = field(default_factory=dict)


def read_manifest(path: Path) -> list[Entry]:
    """The meshes of a manifest; paths are relative to its folder.

    A CSV file has a header with the column ``input`` and may have ``output``, ``map`` and options (``center``,
    ``pins`` as ``0,31,62``); what is left empty is not given. A JSON file is a list of paths, or of objects with these
    names.

    Raises
    ------
    FileFormatError
        There is no such file, or it is no such list.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
        rows = _json_rows(text) if path.suffix.lower() == ".json" else _csv_rows(text)
    except (OSError, ValueError, csv.Error) as error:
        raise FileFormatError(f"{path}: not a list of meshes ({error}).") from error
    entries = []
    for number, row in enumerate(rows, 1):
        given = {name: value for name, value in row.items() if value is not None}
        source = given.pop("input", None)
        output = given.pop("output", None)
        if not isinstance(source, str) or not isinstance(output, str | None):
            raise FileFormatError(f'{path}: mesh {number} has no "input"; name its file.')
        entries.append(Entry(os.path.abspath(path.parent / source), output, given))
    return entries


def _json_rows(text: str) -> list[dict[str, Any]]:
    found = json.loads(text)
    if not isinstance(found, list) or not all(isinstance(one, str | dict) for one in found):
        raise ValueError("a list of paths or objects is expected")
    return [{"input": one} if isinstance(one, str) else one for one in found]


def _csv_rows(text: str) -> list[dict[str, Any]]:
    reader = csv.DictReader(io.StringIO(text), strict=True)
    rows = []
    for row in reader:
        if None in row or None in row.values():
            raise ValueError(f"line {reader.line_num} has not as many columns as the header")
        rows.append({name: value if name in ("input", "output") else _value(value) for name, value in row.items()})
    return [{name: value for name, value in row.items() if value != ""} for row in rows]


def _value(text: str) -> Any:
    """A number, True or False, a list of whole numbers, or a name."""
    text = text.strip()
    if WHOLE_NUMBERS.fullmatch(text):
        return [int(part) for part in re.split(r"\s*[,; ]\s*", text)]
    if text in ("true", "True", "false", "False"):
        return text in ("true", "True")
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text

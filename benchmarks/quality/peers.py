"""What other programs reach, from the data folder's table."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

__all__ = ["Peer", "read_peers"]


@dataclass(frozen=True)
class Peer:
    """A program's mean angle error in degrees and folded faces on a mesh."""

    mesh: str
    program: str
    mean: float
    folds: int


def read_peers(folder: Path | None) -> list[Peer]:
    """The maps to disk and sphere in peers.tsv; none where that is missing."""
    path = folder / "peers.tsv" if folder is not None else None
    if path is None or not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return [
            Peer(line["mesh"], line["program"], float(line["mean_angle_error_degrees"]), int(line["folded_faces"] or 0))
            for line in csv.DictReader(file, delimiter="\t")
            if line["shape"] in ("disk", "sphere")
        ]

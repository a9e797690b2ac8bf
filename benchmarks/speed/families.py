"""Families of meshes: what is run on which sizes, and which contestants take it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

__all__ = ["FAMILIES", "TERRAINS", "Family", "chosen", "scans"]

K, M = 1_000, 1_000_000


@dataclass(frozen=True)
class Family:
    """Meshes of one sort.

    Attributes
    ----------
    name : str
    kind : {"disk", "closed", "atlas", "triangles", "fan", "files"}
        Contestants name the kinds that they take.
    sizes : tuple of int
        Vertices; islands of an atlas.
    file : Path, optional
        What a scan is subdivided from.
    """

    name: str
    kind: str
    sizes: tuple[int, ...]
    file: Path | None = None

    @property
    def tiny(self) -> tuple[str, int]:
        """Family and size of the mesh to warm up on."""
        name = self.name if self.file is None else {"disk": "terrain", "closed": "ellipsoid"}[self.kind]
        return name, 25 if self.kind in ("atlas", "triangles") else 400


TERRAINS = ("terrain", "irregular")
FAMILIES = {
    family.name: family
    for family in (
        Family("terrain", "disk", (K, 10 * K, 100 * K, 200 * K, 262_144, 490 * K, M, 2_300 * K, 4 * M)),
        Family("irregular", "disk", (10 * K, 262_144, 490 * K, M)),
        Family("round", "disk", (200 * K,)),
        Family("islands-4", "atlas", (10 * K,)),
        Family("islands-25", "atlas", (10 * K,)),
        Family("triangles", "triangles", (10 * K, 100 * K)),
        Family("fan", "fan", (100 * K,)),
        Family("files", "files", (M,)),
        Family("ellipsoid", "closed", (K, 10 * K, 100 * K)),
    )
}


def chosen(names: list[str], sizes: list[int], files: list[Path]) -> list[Family]:
    """Families by name, all where none is named; `sizes` instead of their own, the largest of them for scans.

    Raises
    ------
    KeyError
        A name that there is not.
    """
    largest = max(sizes, default=1_200 * K)
    there = [Family(f.name, f.kind, tuple(sizes) or f.sizes) for f in FAMILIES.values()]
    there += [family for file in files for family in scans(file, largest)]
    unknown = set(names) - {family.name for family in there}
    if unknown:
        found = ", ".join(family.name for family in there)
        raise KeyError(f"{', '.join(sorted(unknown))}: choose of {found}, or give its file with --scans")
    return [family for family in there if not names or family.name in names]


def scans(file: Path, largest: int) -> list[Family]:
    """A scan with its subdivisions; a closed one as it is, and opened at a vertex for those that map disks."""
    from .meshes import from_file, is_closed, opened, subdivision_sizes

    faces = from_file(file)[1]
    if not is_closed(faces):
        return [Family(file.stem, "disk", subdivision_sizes(faces, largest), file.resolve())]
    return [
        Family(f"{file.stem}-open", "disk", subdivision_sizes(opened(faces), largest), file.resolve()),
        Family(file.stem, "closed", subdivision_sizes(faces, min(largest, 200 * K)), file.resolve()),
    ]

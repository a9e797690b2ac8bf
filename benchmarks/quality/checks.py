"""What must hold of the rows; every check tells all that break it, the worst first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from .rows import ChangeRow, MapRow

__all__ = ["CHECKS", "Violation", "by_mesh", "violations"]

BETTER = "auto has no more angle error than the better of linear and newton, and 0.02 degrees"
ENDED = "newton converges"
CIRCLE = "what belongs on the circle or the sphere lies there to 1e-12"
EMBEDDED = 'no face is folded under repair="always"'
CHEAP = "no face is folded under auto where the map without folds costs at most 0.5 degrees"
FIGURES = "known meshes keep their figures"
SAME = "similar and renumbered meshes are mapped by the same method, to 1e-6 degrees"
MAPPED = "every method maps every mesh"
CHECKS = (BETTER, EMBEDDED, CHEAP, ENDED, CIRCLE, FIGURES, SAME, MAPPED)

# Mesh, method, most degrees of mean angle error, most folded faces.
KNOWN = (
    ("meshes/cut_hammer", "auto", 1.70, 6),
    ("meshes/cut_hammer", "always", 4.2, 0),
    ("meshes/gen_stretched200", "auto", 45.0, 0),
    ("meshes/gen_stretched200", "always", 45.0, 0),
    ("meshes/gen_strip", "auto", 68.62, 0),
    ("meshes/ods_hammer", "auto", 1.42, 4),
    ("meshes/ods_human_man", "auto", 5.96, 0),
    ("scans/human_face", "auto", 1.209, 0),
    ("scans/david", "auto", 0.874, 0),
    ("nilearn fsaverage5 pial left", "auto", 2.063, 0),
    ("ellipsoid 1:1.5:2.5, level 4", "auto", 0.702, 0),
)


@dataclass(frozen=True)
class Violation:
    """What breaks a check, by how much, and the figures."""

    check: str
    mesh: str
    amount: float
    told: str


def violations(maps: list[MapRow], changes: list[ChangeRow]) -> list[Violation]:
    """Of all checks, in their order."""
    found = [v for rows in by_mesh(maps).values() for v in _of_mesh(rows)]
    changed: dict[str, list[ChangeRow]] = {}
    for row in changes:
        changed.setdefault(row.mesh, []).append(row)
    found += [v for rows in changed.values() for v in _of_changes(rows)]
    return sorted(found, key=lambda v: (CHECKS.index(v.check), -v.amount, v.mesh))


def by_mesh(maps: list[MapRow]) -> dict[str, dict[str, MapRow]]:
    """Rows of each mesh by their method."""
    found: dict[str, dict[str, MapRow]] = {}
    for row in maps:
        found.setdefault(row.mesh, {})[row.method] = row
    return found


def _of_mesh(all_rows: dict[str, MapRow]) -> Iterator[Violation]:
    for row in all_rows.values():
        if row.error:
            yield Violation(MAPPED, row.mesh, 1.0, f"{row.method}: {row.error}")
    rows = {method: row for method, row in all_rows.items() if not row.error}
    for row in rows.values():
        if row.off > 1e-12:
            yield Violation(CIRCLE, row.mesh, row.off, f"{row.method} {row.off:.1e}")
    auto, always, newton = (rows.get(method) for method in ("auto", "always", "newton"))
    others = [rows[method] for method in ("linear", "newton") if method in rows]
    if auto and others:
        best = min(others, key=lambda row: row.mean)
        if not auto.mean <= best.mean + 0.02:
            told = (
                f"auto ({auto.chosen}) {auto.mean:.3f}, {auto.folds} folds; {best.method} {best.mean:.3f}, {best.folds}"
            )
            yield Violation(BETTER, auto.mesh, auto.mean - best.mean, told)
    if newton and newton.status in ("max-iterations", "stalled"):
        yield Violation(ENDED, newton.mesh, newton.mean, f"{newton.status}, {newton.mean:.3f} degrees")
    if always and always.folds:
        yield Violation(EMBEDDED, always.mesh, always.folds, f"{always.folds} folds, {always.mean:.3f} degrees")
    if auto and always and auto.folds and not always.folds and always.mean <= auto.mean + 0.5:
        told = f"{auto.folds} folds at {auto.mean:.3f} degrees, none at {always.mean:.3f}"
        yield Violation(CHEAP, auto.mesh, auto.folds, told)
    for mesh, method, mean, folds in KNOWN:
        row = rows.get(method)
        if row and row.mesh == mesh and (row.mean > mean or row.folds > folds):
            told = f"{method} {row.mean:.4f} with {row.folds} folds; at most {mean} with {folds}"
            yield Violation(FIGURES, mesh, max(row.mean - mean, 0.0), told)


def _of_changes(rows: list[ChangeRow]) -> Iterator[Violation]:
    """One for a mesh: its worst change, another method before another figure."""
    bad = [row for row in rows if not (row.before == row.after and row.difference <= 1e-6)]
    if bad:
        worst = max(bad, key=lambda row: (row.before != row.after, row.difference))
        told = f"{len(bad)} of {len(rows)} changes, the worst {worst.change}: {worst.before}, {worst.after}"
        yield Violation(SAME, worst.mesh, worst.difference, f"{told}; {worst.difference:.1e} degrees")

"""docs/quality.md: the tables, where others are better, and what does not hold."""

from __future__ import annotations

from .checks import CHECKS, SAME, Violation, by_mesh, violations
from .measure import METHODS
from .peers import Peer
from .rows import ChangeRow, MapRow

__all__ = ["markdown"]

LARGE = 10_000
INTRODUCTION = """\
# Quality: every mesh, every method

How well angles are kept, whether faces fold, and what the default costs, on scans, on surfaces by formula, on shapes
made to break flatteners, and on disks cut out of closed surfaces. Made, from the repository's root, by

```sh
python -m benchmarks.quality --data FOLDER --out docs/quality.md
```

FOLDER holds OBJ files and, if there are any, other programs' figures in `peers.tsv`; without it the generated meshes
and the brain surfaces inside nilearn's wheel are mapped alone. `CONFORMAL_UV_DATA` names it as well.

- **mean / rms / largest**: of |angle in the map - angle on the surface| over all corners of all faces, in degrees. With
  few faces, or around a vertex whose angles do not sum to 360 degrees (a corner of the boundary: 180), it is not 0 for
  any map; it tells methods apart, not meshes.
- **folds**, behind the numbers where there are any: faces whose area in the map is not positive, by the exact sign for
  the coordinates as they are stored in double precision.
- **auto** is the default; **always** is the default with `repair="always"`. The column *auto is* has the method that it
  chose and why that stopped.
- **exact**: the boundary is on the unit circle (a closed surface's vertices on the unit sphere) to 1e-12.
- **time**: newton and auto over linear, of meshes from 10,000 vertices on, by the processor's time in the best of up
  to three runs of one process. Ratios of small meshes are those of fixed costs and are left out.
- In *italics*: the method stopped before its tolerance.
- Other programs' figures were measured for this project by the same measure; they are not published ones.
"""


def markdown(maps: list[MapRow], changes: list[ChangeRow], peers: list[Peer]) -> str:
    """Everything as one text."""
    meshes = by_mesh(maps)
    broken = violations(maps, changes)
    lines = [INTRODUCTION, "## What must hold", "", *_checks(broken, len(meshes), changes), ""]
    lines += ["## Where the default leaves faces folded", "", *_folded(meshes), ""]
    lines += ["## Where other programs are better", "", *_worse(meshes, peers), ""]
    for shape, title in (("disk", "Disks"), ("sphere", "Spheres")):
        here = {name: rows for name, rows in meshes.items() if next(iter(rows.values())).shape == shape}
        if here:
            lines += [f"## {title}", "", *_table(here, list(METHODS[shape]), peers), ""]
    return "\n".join(lines).rstrip() + "\n"


def _checks(broken: list[Violation], count: int, changes: list[ChangeRow]) -> list[str]:
    lines = [f"Of {count} meshes:", ""]
    for check in CHECKS:
        here = [v for v in broken if v.check == check]
        if check == SAME and not changes:
            lines.append(f"- {check}: not measured.")
            continue
        told = f"{len(here)} exception{'s' * (len(here) > 1)}:" if here else "holds."
        lines.append(f"- {check}: {told}")
        lines += [f"  - {v.mesh}: {v.told}" for v in here]
    return lines


def _folded(meshes: dict[str, dict[str, MapRow]]) -> list[str]:
    """Folds of the default, and what it costs to have none."""
    lines = []
    for name, rows in meshes.items():
        auto, always = rows.get("auto"), rows.get("always")
        if auto and always and auto.folds:
            ours, other = (_numbers(f"{row.mean:.3f} degrees", row.folds) for row in (auto, always))
            lines.append(f'- {name}: {ours}; with `repair="always"` {other}.')
    return lines or ["Nowhere."]


def _worse(meshes: dict[str, dict[str, MapRow]], peers: list[Peer]) -> list[str]:
    """Peers with less angle error, or fewer folds, than the default."""
    both = [(peer, meshes[peer.mesh]["auto"]) for peer in peers if "auto" in meshes.get(peer.mesh, {})]
    if not both:
        return ["No figures of other programs at hand."]
    lines = []
    for peer, auto in both:
        if auto.error or peer.mean < auto.mean - 0.005 or peer.folds < auto.folds:
            ours = auto.error or _numbers(f"{auto.mean:.3f}", auto.folds)
            lines.append(f"- {peer.mesh}: {peer.program} {_numbers(f'{peer.mean:g}', peer.folds)}, auto {ours}.")
    are = f"{len(lines)} {'is' if len(lines) == 1 else 'are'}"
    told = f"Of {len(both)} figures of other programs on these meshes {are} better in angles or in folds"
    return [f"{told}{':' if lines else '.'}", "", *lines]


def _table(meshes: dict[str, dict[str, MapRow]], methods: list[str], peers: list[Peer]) -> list[str]:
    head = ["mesh", "vertices", *methods, "auto is", "exact", "time", "others"]
    lines = [f"| {' | '.join(head)} |", "|---|---:|" + "---|" * (len(head) - 2)]
    for name, rows in meshes.items():
        auto = rows.get("auto")
        chosen = f"{auto.chosen}, {auto.status}" if auto and not auto.error else ""
        exact = "yes" if all(row.off <= 1e-12 for row in rows.values()) else "no"
        others = "; ".join(f"{p.program} {_numbers(f'{p.mean:g}', p.folds)}" for p in peers if p.mesh == name)
        fields = [name, f"{next(iter(rows.values())).vertices:,}", *(_cell(rows.get(method)) for method in methods)]
        lines.append(f"| {' | '.join([*fields, chosen, exact, _times(rows), others])} |")
    return lines


def _cell(row: MapRow | None) -> str:
    if row is None:
        return ""
    if row.error:
        return row.error
    text = _numbers(f"{row.mean:.3f} / {row.rms:.2f} / {row.largest:.0f}", row.folds)
    return f"*{text}*" if row.status in ("max-iterations", "stalled") else text


def _numbers(text: str, folds: int) -> str:
    return f"{text} ({folds:,} fold{'s' * (folds > 1)})" if folds else text


def _times(rows: dict[str, MapRow]) -> str:
    linear = rows.get("linear")
    if linear is None or linear.error or linear.vertices < LARGE:
        return ""
    ratios = [(name, rows[name].seconds / linear.seconds) for name in ("newton", "auto") if name in rows]
    return ", ".join(f"{name} {ratio:.1f}" for name, ratio in ratios if ratio == ratio)

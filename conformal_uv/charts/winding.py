"""Turning polygons so that all of a chart are wound one way, and cutting charts that have only one side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from ..errors import ConformalUVError, OrientationError, Remedy, listed
from ..mesh.polygon_sides import PolygonSides
from ..mesh.polygons import PolygonMesh
from ..options import Orientation
from .faults import Faults
from .selected_part import SelectedPart

__all__ = ["note_orientation", "turned", "untwisted"]

Ints = NDArray[np.int64]
Signs = NDArray[np.int8]

MEND = Remedy("orientation", Orientation.MEND)


def note_orientation(faults: Faults, sign: Signs, chart: Ints, name: Ints) -> None:
    """Charts with polygons wound against the rest, or with one side only."""

    def against(own: Ints) -> ConformalUVError:
        return OrientationError(
            f"{len(own)} faces are wound against their neighbours: faces {listed(own)}.",
            own,
            ("flip their normals", MEND),
        )

    def one_sided(own: Ints) -> ConformalUVError:
        return OrientationError(
            f"The surface has only one side, like a Moebius band ({len(own)} faces: {listed(own)}).",
            own,
            ("mark a seam across the band", MEND),
        )

    for value, tell in ((0, one_sided), (-1, against)):
        bad = np.flatnonzero(sign == value)
        faults.note(name[bad], chart[bad], tell)


def untwisted(part: SelectedPart, sign: Signs, chart: Ints) -> tuple[SelectedPart, Signs]:
    """Cut one-sided charts: signs spread from a first polygon breadth first, sides that still disagree are cut.

    The tree along which the signs spread stays uncut, so that a chart stays in one piece.

    Returns
    -------
    The mesh with those sides cut, and signs without 0.
    """
    p = len(sign)
    one, other = part.joined
    twisted = sign[part.sides.polygon[one]] == 0
    one, other = one[twisted], other[twisted]
    f, g = part.sides.polygon[one], part.sides.polygon[other]
    crossed = part.mesh.corners[one] == part.mesh.corners[other]
    rows, columns = np.concatenate((f, g)), np.concatenate((g, f))
    graph = csr_array((np.ones(len(rows), dtype=np.int8), (rows, columns)), shape=(p, p))
    parent = np.arange(p)
    for first in np.unique(chart[sign == 0], return_index=True)[1]:
        _, before = breadth_first_order(graph, np.flatnonzero(sign == 0)[first], directed=False)
        parent = np.where(before >= 0, before, parent)
    # Parity of the crossings between each polygon and the root of its tree, by pointer doubling.
    crossing = _crosses(f, g, crossed, np.arange(p), parent, p)
    while (parent[parent] != parent).any():
        crossing ^= crossing[parent]
        parent = parent[parent]
    filled = np.where(sign == 0, np.where(crossing, -1, 1), sign).astype(np.int8)
    wrong = crossed != (filled[f] != filled[g])
    twin = part.twin.copy()
    twin[one[wrong]] = twin[other[wrong]] = -1
    return replace(part, twin=twin), filled


def _crosses(f: Ints, g: Ints, crossed: NDArray[np.bool_], child: Ints, parent: Ints, p: int) -> NDArray[np.bool_]:
    """Whether a side between each child and its parent disagrees, (p,); False at roots.

    Where several sides join the two, the last of them counts.
    """
    key = np.concatenate((f * p + g, g * p + f))
    order = np.argsort(key, kind="stable")
    key, value = key[order], np.concatenate((crossed, crossed))[order]
    place = np.searchsorted(key, child * p + parent, side="right") - 1
    found = (child != parent) & (place >= 0)
    return np.where(found, value[np.maximum(place, 0)], False)


def turned(part: SelectedPart, sign: Signs) -> tuple[SelectedPart, Ints]:
    """The same polygons with those of sign -1 wound the other way, and the old corner of each corner."""
    mesh, sides = part.mesh, part.sides
    corner = np.arange(len(mesh.corners))
    back = sign[sides.polygon] < 0
    ends = mesh.starts[sides.polygon] + mesh.starts[sides.polygon + 1] - 1
    corner = np.where(back, ends - corner, corner)
    before = np.empty_like(corner)
    before[sides.follow] = np.arange(len(corner))
    side = np.where(back, before[corner], corner)  # the old side that each side is
    place = np.empty_like(side)
    place[side] = np.arange(len(side))

    def renumbered(twin: Ints) -> Ints:
        old = twin[side]
        return np.where(old >= 0, place[np.maximum(old, 0)], old)

    turned_sides = PolygonSides(sides.follow, sides.polygon, sides.key, sides.edge[side], renumbered(sides.twin))
    turned_mesh = PolygonMesh(mesh.V, mesh.corners[corner], mesh.starts)
    return SelectedPart(turned_mesh, turned_sides, part.seam, renumbered(part.twin)), corner

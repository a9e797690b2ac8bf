"""Every mesh that is mapped: a data folder's, generated ones, and those that the test dependencies ship."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np

from conformal_uv import samples

from ..speed.meshes import ellipsoid as spiral_ellipsoid
from ..speed.meshes import from_file
from ..speed.quality import boundary_vertices
from .shapes import (
    Mesh,
    above_plane,
    dumbbell,
    ellipsoid,
    hull,
    icosphere,
    limbs,
    rod,
    twisted,
    without_face,
    without_star,
)

import meshes as by_hand  # isort: skip
import nasty_meshes as nasty  # isort: skip

__all__ = ["Maker", "all_meshes"]

Maker = Callable[[], Mesh]
LEVELS = (1, 2, 3, 4, 5)


def all_meshes(folder: Path | None) -> dict[str, Maker]:
    """By name; OBJ files under the folder by their path in it, and what is cut out of them where they are closed."""
    data = _data(folder) if folder is not None else {}
    brains = _shipped()
    closed = {name: make for name, make in data.items() if len(boundary_vertices(make()[1])) == 0}
    closed |= {name: make for name, make in brains.items() if name.endswith("pial left")}
    return {**data, **brains, **_generated(), **with_holes(closed)}


def _data(folder: Path) -> dict[str, Maker]:
    paths = sorted(folder.rglob("*.obj"))
    return {p.relative_to(folder).with_suffix("").as_posix(): partial(from_file, p) for p in paths}


def _shipped() -> dict[str, Maker]:
    """The average brain's surfaces inside nilearn's wheel."""
    if not all(importlib.util.find_spec(name) for name in ("nilearn", "nibabel")):
        return {}
    names = {"pial": "pial", "white": "white", "inflated": "infl"}
    sides = ("left", "right")
    return {
        f"nilearn fsaverage5 {kind} {side}": partial(_brain, f"{file}_{side}")
        for kind, file in names.items()
        for side in sides
    }


def _brain(name: str) -> Mesh:
    import nibabel
    import nilearn

    path = Path(nilearn.__file__).parent / "datasets" / "data" / "fsaverage5" / f"{name}.gii.gz"
    V, F = (array.data for array in nibabel.load(path).darrays[:2])
    return V.astype(np.float64), F.astype(np.int64)


def _generated() -> dict[str, Maker]:
    """Families by formula and by hand."""
    closed = dict(_closed())
    return {**dict(_disks()), **closed, **with_holes({name: closed[name] for name in HOLED})}


def with_holes(closed: dict[str, Maker]) -> dict[str, Maker]:
    """Disks out of closed surfaces: without the star of a vertex, without a face, and cut by a plane."""
    cuts = {"without a star": without_star, "without a face": without_face, "cut by a plane": above_plane}
    return {
        f"{name}, {told}": (lambda make=make, cut=cut: cut(make()))
        for name, make in closed.items()
        for told, cut in cuts.items()
    }


HOLED = ("icosphere 3", "ellipsoid 1:1.5:2.5, level 4", "hull of 1000", "limb of 5 radii", "3 limbs of 2 radii")
HOLED += ("dumbbell 0.1", "ellipsoid 1:1:5, level 4", "bumpy sphere")


def _disks() -> Iterator[tuple[str, Maker]]:
    for count in (500, 3_000, 20_000):
        yield f"mask of {count}", partial(samples.mask, count)
    for count in (900, 10_000, 50_000):
        yield f"terrain of {count}", partial(samples.terrain, count, seed=7)
    for angle in (60.0, 120.0, 160.0, 175.0):
        yield f"cap of {angle:g} degrees", partial(samples.spherical_cap, 2000, angle)
    yield "flat disk", samples.flat_disk
    for name, mesh in nasty.EMBEDDED.items():
        yield f"nasty: {name}", lambda mesh=mesh: mesh
    yield "strip of 20 quads", partial(by_hand.strip, 20)
    yield "fan of 9", partial(by_hand.fan, 9)
    yield "wheel of 7", partial(by_hand.wheel, 7)
    yield "wheel of 3", partial(by_hand.wheel, 3)
    yield "plate 12 x 8", partial(by_hand.plate, 12, 8)
    for seed in (1, 2, 3):
        yield f"scattered disk {seed}", partial(by_hand.scattered_disk, 300, 40, seed)
    for factor in (3, 10, 30, 100):
        yield f"terrain stretched {factor}:1", partial(_stretched, samples.terrain, 3600, factor)
        yield f"mask stretched {factor}:1", partial(_stretched, samples.mask, 3000, factor)
    for length in (3, 6, 12, 50):
        yield f"ribbon 1 x {length}", partial(nasty.grid, 8 * length + 1, 9, length, 1)
    yield "twisted ribbon 1 x 12", lambda: twisted(nasty.grid(97, 9, 12, 1), 1.5)
    for lanes in (2, 4):
        yield f"maze of {lanes} lanes", partial(nasty.maze, lanes)
    yield "open limb of 12 radii", partial(nasty.finger, 12.0, 16)


def _stretched(sample: Callable[[int], Mesh], count: int, factor: float) -> Mesh:
    V, F = sample(count)
    return V * [factor, 1.0, 1.0], F


def _closed() -> Iterator[tuple[str, Maker]]:
    for make in (by_hand.tetrahedron, by_hand.octahedron):
        yield make.__name__, make
    for level in (0, *LEVELS):
        yield f"icosphere {level}", partial(icosphere, level)
    for level in LEVELS:
        yield f"ellipsoid 1:1.5:2.5, level {level}", partial(ellipsoid, level, 1.0, 1.5, 2.5)
    yield "ellipsoid of 20000", partial(spiral_ellipsoid, 20_000)
    for axes in ((1, 1, 5), (1, 1, 20), (1, 1, 0.2), (1, 1, 0.02), (1, 4, 8)):
        yield f"ellipsoid {':'.join(map(str, axes))}, level 4", partial(ellipsoid, 4, *axes)
    for count, seed in ((12, 1), (20, 1), (20, 2), (50, 1), (50, 2), (200, 1), (1000, 1), (5000, 1)):
        yield f"hull of {count}" + ("" if seed == 1 else f", seed {seed}"), partial(hull, count, seed)
    yield "hull of 500, 1:1:6", partial(hull, 500, 3, 1, 1, 6)
    for length in (1, 2, 5, 10):
        yield f"limb of {length} radii", partial(limbs, 4, length)
    yield "limb of 5 radii, fine", partial(limbs, 5, 5)
    yield "3 limbs of 2 radii", partial(limbs, 4, 2, 3)
    yield "6 limbs of 3 radii", partial(limbs, 4, 3, 6)
    for waist in (0.3, 0.1):
        yield f"dumbbell {waist}", partial(dumbbell, 4, waist)
    for sides, rings, length in ((4, 2, 1), (4, 12, 6), (8, 30, 20), (24, 30, 6), (6, 80, 100)):
        yield f"rod {sides} x {rings}, length {length}", partial(rod, sides, rings, float(length))
    yield "bumpy sphere", _bumpy


def _bumpy() -> Mesh:
    V, F = icosphere(4)
    x, y, z = V[:, :1], V[:, 1:2], V[:, 2:]
    return V * (1 + 0.2 * np.sin(3 * x + 1) + 0.15 * np.cos(4 * y * z) + 0.1 * np.sin(2 * y + z)), F

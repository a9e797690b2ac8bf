"""Closed meshes mapped to spheres: read, solved by numpy alone so that a thread may, and only then written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import bpy
import numpy as np

from conformal_uv import (
    Callback,
    CancelledError,
    ConformalUVError,
    MeshError,
    PolygonMesh,
    SphereMap,
    equirectangular,
    octahedral,
    sphere_map,
    triangulate,
)

from .mesh_reading import MeshArrays, read_mesh
from .mesh_writing import write_shape_key, write_uv
from .tasks import UNEVEN, even_scale
from .uv_layers import has_room, uv_layer_name
from .words import as_blender_says, told

SHAPE_KEY = "Conformal Sphere"
LAYOUTS = {"EQUIRECTANGULAR": equirectangular, "OCTAHEDRAL": octahedral}

_kept: dict[tuple[bytes, str], tuple[SphereMap, np.ndarray]] = {}  # the last maps and the vertices they use


@dataclass(eq=False)
class SpherePart:
    """One mesh to map.

    Attributes
    ----------
    solved : SphereMap or None
    used : (q,) int64
        The mesh's vertices that the map has.
    refusal : str
        Why there is none.
    """

    arrays: MeshArrays
    digest: bytes
    uneven: str = ""
    solved: SphereMap | None = None
    used: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    refusal: str = ""

    @classmethod
    def of(cls, ob: bpy.types.Object) -> SpherePart:
        """Read an object's mesh, in Object Mode."""
        arrays = read_mesh(ob.data, "")
        everything = np.ones(len(arrays.selected), dtype=bool)
        return cls(arrays, arrays.digest(everything), "" if even_scale(ob) else UNEVEN)

    @property
    def mesh(self) -> PolygonMesh:
        """The mesh in double precision."""
        arrays = self.arrays
        return PolygonMesh(arrays.V.astype(np.float64), arrays.corners.astype(np.int64), arrays.starts.astype(np.int64))


def solve(parts: Sequence[SpherePart], method: str, *, callback: Callback | None = None, backend: str = "auto") -> None:
    """Solve every part, or say in it why that can not be; what was solved for the same meshes is asked first.

    Raises
    ------
    CancelledError
    """
    found = {}
    for number, part in enumerate(parts):
        key = (part.digest, method)
        try:
            found[key] = _kept.get(key) or _solved(part, method, _share(callback, number, len(parts)), backend)
            part.solved, part.used = found[key]
        except CancelledError:
            raise
        except ConformalUVError as error:
            part.refusal = as_blender_says(error.told(lambda remedy: ""))
    _kept.clear()
    _kept.update(found)


def forget() -> None:
    """Keep no map."""
    _kept.clear()


def write(ob: bpy.types.Object, part: SpherePart, uv: str) -> str:
    """Write shape key and UVs; why nothing was written, empty where it was."""
    layer = uv_layer_name(ob.data, "")
    if part.solved is None:
        return part.refusal
    if uv in LAYOUTS and not has_room(ob.data, layer):
        return told("it has eight UV maps already; remove one")
    mesh = part.mesh
    positions, xyz = mesh.V.copy(), np.zeros_like(mesh.V)
    positions[part.used], xyz[part.used] = part.solved.around_surface, part.solved.xyz
    write_shape_key(ob, SHAPE_KEY, positions)
    if uv in LAYOUTS:
        write_uv(ob.data, layer, LAYOUTS[uv](xyz, mesh), np.ones(len(mesh.corners), dtype=bool))
    return ""


def _solved(part: SpherePart, method: str, callback: Callback | None, backend: str) -> tuple[SphereMap, np.ndarray]:
    mesh = part.mesh
    triangles, polygon, _ = triangulate(mesh)
    used, F = np.unique(triangles, return_inverse=True)
    try:
        result = sphere_map(
            mesh.V[used], F.reshape(-1, 3), method=method, rotation="surface", backend=backend, callback=callback
        )
    except MeshError as error:
        raise error.renumbered(polygon, used) from error
    return result, used


def _share(callback: Callback | None, number: int, count: int) -> Callback | None:
    """The callback for one of several parts, its fraction that of all."""
    if callback is None:
        return None
    return lambda stage, fraction: callback(stage, (number + fraction) / count)

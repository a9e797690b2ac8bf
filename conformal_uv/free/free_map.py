"""The conformal map of a surface with disk topology to the plane, its boundary free."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ..mesh.mesh_objects import MeshObject
from ..operators.factorized_disk import FactorizedDisk
from ..options import FreeOptions, Repair
from ..progress import Callback, Progress
from .mapper import mapped_free
from .result import FreeMap

__all__ = ["free_map"]


def free_map(
    V: ArrayLike | MeshObject,
    F: ArrayLike | None = None,
    *,
    boundary_scale: ArrayLike | None = None,
    boundary_angles: ArrayLike | None = None,
    refine: bool = False,
    laplacian: str = "auto",
    repair: str = "auto",
    backend: str = "auto",
    callback: Callback | None = None,
) -> FreeMap:
    """Flatten a triangle mesh conformally, its boundary as long as it is on the surface.

    Boundary first flattening (R. Sawhney, K. Crane 2017) with boundary scale factors of 1: the boundary keeps its
    lengths, but for the smallest change that closes it, and turns as the curvature inside asks for; then both
    coordinates are extended harmonically. A surface that can be developed comes out as it is, rolled out. Nothing
    keeps the map from covering a part of the plane twice; see `FreeMap.crossings`.

    Parameters
    ----------
    V : (n, 3) floats
        Vertex positions, any units; or, without F, a mesh: (V, F), or one of trimesh, pyvista, meshio or open3d.
    F : (m, 3) integers
        Triangles, 0-based, consistently wound: one connected surface with one boundary loop and no handles.
    boundary_scale : (nb,) floats, optional
        Logarithm of the wanted scale at each boundary vertex, in the order of the boundary loop (the order of
        `FreeMap.boundary`); by default 0.
    boundary_angles : (nb,) floats, optional
        Turning angle (pi less the interior angle, radians) at each boundary vertex in the same order, 2 pi in all: the
        boundary gets exactly these, and its mean scale is 1.
    refine : bool
        Move all vertices on, boundary included, while that lowers the mean angle error; no face folds on the way.
        Takes some tens of steps, each as long as the map itself.
    laplacian : {"auto", "cotan", "intrinsic-delaunay"}
        As in `disk_map`.
    repair : {"auto", "always", "never"}
        Where triangles came out folded, vertices around them are moved, those of the boundary if nothing else helps;
        "auto" pays at most half a degree of mean angle error for it.
    backend : {"auto", "cholmod", "superlu", "multigrid"}
        As in `disk_map`.
    callback : callable, optional
        Called as ``callback(stage, fraction)``; the work stops with CancelledError when it returns False.

    Returns
    -------
    FreeMap

    Raises
    ------
    MeshError
        Or the subclass that says what is wrong with the mesh.
    OptionError
        An option that does not fit.
    SolverError
        The numerical solution failed.
    CancelledError
        The callback returned False.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> V, F = mask(500)
    >>> m = cuv.free_map(V, F)
    >>> m.uv.shape, len(m.flipped), len(m.crossings)
    ((500, 2), 0, 0)
    >>> m.distortion.angle_mean < cuv.disk_map(V, F).distortion.angle_mean
    True
    """
    options = FreeOptions(
        boundary_scale=boundary_scale,  # type: ignore[arg-type]
        boundary_angles=boundary_angles,  # type: ignore[arg-type]
        refine=refine,
        repair=Repair.of("repair", repair),
    )
    factorized = FactorizedDisk(V, F, laplacian=laplacian, backend=backend, callback=callback)
    return mapped_free(factorized, options, Progress(callback))

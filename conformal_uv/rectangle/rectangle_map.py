"""The conformal map of a surface with disk topology onto a rectangle."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from ..mesh.mesh_objects import MeshObject
from ..operators.factorized_disk import FactorizedDisk
from ..options import CornerChoice, RectangleOptions, Repair
from ..progress import Callback, Progress
from .mapper import mapped_rectangle
from .result import RectangleMap

__all__ = ["rectangle_map"]


def rectangle_map(
    V: ArrayLike | MeshObject,
    F: ArrayLike | None = None,
    corners: Sequence[int] | None = None,
    *,
    corner_choice: str = "turning",
    laplacian: str = "auto",
    repair: str = "auto",
    backend: str = "auto",
    callback: Callback | None = None,
) -> RectangleMap:
    """Map a triangle mesh conformally onto a rectangle of height 1; its width is the conformal modulus.

    Four boundary vertices become the corners. Each coordinate is harmonic, constant on two opposite sides, and without
    flux through the other two (P. Henrici, "Applied and computational complex analysis" 3, 1986, section 16.11); their
    energies enclose the modulus. Strips do not crowd as in the disk, if the corners are those of the strip.

    Parameters
    ----------
    V : (n, 3) floats
        Vertex positions, any units; or, without F, a mesh: (V, F), or one of trimesh, pyvista, meshio or open3d.
    F : (m, 3) integers
        Triangles, 0-based, consistently wound: one connected surface with one boundary loop and no handles.
    corners : four vertex indices, optional
        Boundary vertices, in the direction of the boundary, that are sent to (0, 0), (w, 0), (w, 1), (0, 1).
    corner_choice : {"turning", "area"}
        Which corners without `corners`. "turning": the four that the boundary turns most around, well apart. "area":
        of these and of some rotations of the quarters of the boundary's length, those whose map has the least area
        distortion; as many maps are made.
    laplacian : {"auto", "cotan", "intrinsic-delaunay"}
        As in `disk_map`.
    repair : {"auto", "always", "never"}
        Where triangles came out folded, patches around them are moved, then sides are brought into order and other
        weights taken; "auto" pays at most half a degree of mean angle error for it.
    backend : {"auto", "cholmod", "superlu", "multigrid"}
        As in `disk_map`.
    callback : callable, optional
        Called as ``callback(stage, fraction)``; the work stops with CancelledError when it returns False.

    Returns
    -------
    RectangleMap

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
    >>> from conformal_uv.samples import terrain
    >>> V, F = terrain(900)
    >>> m = cuv.rectangle_map(V, F, corners=[0, 29, 899, 870])
    >>> m.corners.tolist(), m.uv[0].tolist(), m.uv[870].tolist()
    ([0, 29, 899, 870], [0.0, 0.0], [0.0, 1.0])
    >>> low, high = m.modulus_bounds
    >>> low < m.modulus < high < 1.02 * low
    True
    """
    options = RectangleOptions(
        corners=corners,  # type: ignore[arg-type]
        corner_choice=CornerChoice.of("corner_choice", corner_choice),
        repair=Repair.of("repair", repair),
    )
    factorized = FactorizedDisk(V, F, laplacian=laplacian, backend=backend, callback=callback)
    return mapped_rectangle(factorized, options, Progress(callback))

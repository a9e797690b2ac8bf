"""The conformal map of a surface with disk topology onto the unit disk."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from ..mesh.mesh_objects import MeshObject
from ..progress import Callback
from .mapper import DiskMapper
from .result import DiskMap

__all__ = ["disk_map"]


def disk_map(
    V: ArrayLike | MeshObject,
    F: ArrayLike | None = None,
    *,
    method: str = "auto",
    objective: str | None = None,
    pins: Sequence[int] | None = None,
    pin_mode: str | None = None,
    center: int | None = None,
    boundary_vertex: int | None = None,
    balance: str = "middle",
    tolerance: float = 1e-10,
    relative_tolerance: float = 0.0,
    max_iterations: int = 50,
    laplacian: str = "auto",
    repair: str = "auto",
    backend: str = "auto",
    callback: Callback | None = None,
) -> DiskMap:
    """Map a triangle mesh conformally onto the unit disk.

    Parameters
    ----------
    V : (n, 3) floats
        Vertex positions, any units; or, without F, a mesh: (V, F), or one of trimesh, pyvista, meshio or open3d.
    F : (m, 3) integers
        Triangles, 0-based, consistently wound: one connected surface with one boundary loop and no handles.
    method : {"auto", "linear", "newton", "augmented-lagrangian"}
        "linear": boundary angles from the harmonic measure, one factorization. "newton": from there, the boundary
        angles that minimise the energy. "auto": the one of these two with less angle error; large surfaces get the
        linear map unless the first steps of Newton's method do better. Where pins are constraints, or the objective is
        "dirichlet", it is "newton". "augmented-lagrangian": the algorithm of Choi's report.
    objective : {"conformal", "dirichlet"}, optional
        What is minimised: the Dirichlet energy less the area of the image, or the Dirichlet energy alone. By
        default "conformal"; "dirichlet", the report's, for the augmented Lagrangian. "linear" minimises neither.
    pins : three vertex indices, optional
        Boundary vertices to be sent to 1, w, w^2, w = exp(2 pi i / 3), in the boundary's direction. The augmented
        Lagrangian always has pins, by default a third of the boundary's vertices apart, from its first.
    pin_mode : {"moebius", "constraint"}, optional
        How pins are reached: by a Moebius map of the solution, or as constraints of the optimisation as in the
        report (always so for the augmented Lagrangian), which can fold a map whose pins sit badly.
    center : int, optional
        Interior vertex to be sent to 0; by default `balance` says what is there. A vertex that only folded
        triangles would allow in the middle comes as near as the repair leaves it, and `DiskMap.center` is None.
    boundary_vertex : int, optional
        Boundary vertex to be sent to 1; by default the first of the boundary loop.
    balance : {"middle", "area"}
        What comes to 0 without `center` and `pins`. "middle": the peak of the surface's torsion function, wherever
        between vertices that is. "area": what the Moebius map of least area distortion sends there, which gives limbs
        more room and costs some thousandths of a degree on smooth surfaces, more on coarse ones.
    tolerance : float
        Newton's method ends at this norm of the projected gradient of the energy in the angles (radians).
    relative_tolerance : float
        Or, where that comes first, at this part of the norm that it starts from, that of the linear map.
    max_iterations : int
        Most iterations of "newton" and "augmented-lagrangian"; a result that stopped there has
        ``converged == False`` and a warning is logged.
    laplacian : {"auto", "cotan", "intrinsic-delaunay"}
        "cotan": the cotangent weights of the triangles as they are. "intrinsic-delaunay": those of the intrinsic
        Delaunay triangulation of the same surface, never negative, on mollified lengths where faces have no area.
        "auto" uses the latter when an interior edge has a negative weight or a face no area, except with the
        Dirichlet objective, which is the report's problem on the triangles as they are.
    repair : {"auto", "always", "never"}
        Where triangles came out folded, "auto" restores an embedding if that costs at most half a degree of mean
        angle error, "always" whatever it costs, as long as doubles hold one; see `DiskMap.repair` for the cost and
        `DiskMap.flipped` for what is left. "never" leaves them; so does the augmented Lagrangian always.
    backend : {"auto", "cholmod", "superlu", "multigrid"}
        Library of the linear solver. "auto" obeys the environment variable CONFORMAL_UV_BACKEND; without it, it is a
        factorization by CHOLMOD, or by SuperLU where that is not installed, and multigrid (with
        ``conformal-uv[large]``) where a factorization would not fit into memory.
    callback : callable, optional
        Called as ``callback(stage, fraction)``; the work stops with CancelledError when it returns False.

    Returns
    -------
    DiskMap

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
    >>> m = cuv.disk_map(V, F)
    >>> m.uv.shape, m.converged, len(m.flipped)
    ((500, 2), True, 0)
    """
    return DiskMapper(V, F, laplacian=laplacian, backend=backend, callback=callback).map(
        method=method,
        objective=objective,
        pins=pins,
        pin_mode=pin_mode,
        center=center,
        boundary_vertex=boundary_vertex,
        balance=balance,
        tolerance=tolerance,
        relative_tolerance=relative_tolerance,
        max_iterations=max_iterations,
        repair=repair,
        callback=callback,
    )

"""The conformal map of a closed genus-0 surface onto the unit sphere."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DisconnectedError, OptionError, TopologyError
from ..linear.backends import choose_backend
from ..mesh.geometry import triangle_geometry
from ..mesh.mesh_objects import MeshObject, triangles_of
from ..mesh.surface import Surface
from ..operators.orientation_sign import inverted_faces, outward_signs
from ..optimize import Status
from ..options import Laplacian, Normalization, Repair, Rotation, SphereBoundary, SphereMethod, SphereOptions
from ..progress import Callback, Progress
from .centring import centred, landmark_aligned, principal_rotation, surface_rotation, unit
from .repair import mended
from .result import SphereMap
from .solution import ClosedSurface, SphereSolution

__all__ = ["sphere_map"]

Real = NDArray[np.float64]
log = logging.getLogger(__name__)


def sphere_map(
    V: ArrayLike | MeshObject,
    F: ArrayLike | None = None,
    *,
    method: str = "auto",
    normalization: str = "area",
    rotation: str = "principal",
    landmarks: Sequence[int] | None = None,
    boundary: str = "refuse",
    tolerance: float = 1e-8,
    max_iterations: int = 50,
    laplacian: str = "auto",
    repair: str = "auto",
    backend: str = "auto",
    callback: Callback | None = None,
) -> SphereMap:
    """Map a closed triangle mesh conformally onto the unit sphere.

    Parameters
    ----------
    V : (n, 3) floats
        Vertex positions; or, without F, a mesh: (V, F), or one of trimesh, pyvista, meshio or open3d.
    F : (m, 3) integers
        Triangles of one closed surface of genus 0, wound anticlockwise seen from outside.
    method : {"auto", "linear", "schwarz", "newton", "augmented-lagrangian"}
        "linear": the disk's map of the surface without one regular vertex, projected stereographically; on small
        surfaces the best of some vertices. "schwarz": from there harmonic in two charts in turn, which mends the
        neighbourhood of that vertex and crowded limbs. "newton": from the better of these to a minimiser of the
        conformal energy among the maps that are centred by area. "auto": the one of the three with the least angle
        error; on surfaces of 10,000 vertices and more of the first two. "augmented-lagrangian": Newton's minimiser in
        the way of Choi's report, for small meshes.
    normalization : {"area", "center", "none"}
        The Moebius map at the end: the centre of mass of the surface's area (each vertex's third of its faces), or
        of the vertices, comes to the middle of the ball; "none" leaves what the method ends with.
    rotation : {"principal", "surface", "none"}
        To the principal axes of that mass, or as near as possible to the surface's own directions.
    landmarks : three vertex indices, optional
        Vertices sent to (0, 0, -1), (1, 0, 0) and (0, 0, 1), in the place of normalization and rotation.
    boundary : {"refuse", "cap"}
        What to do with boundary loops: refuse, or close each by a virtual vertex in its middle for the solution.
    tolerance : float
        Newton's method ends at this norm of the projected gradient.
    max_iterations, laplacian, repair, backend, callback
        As in `disk_map`.

    Returns
    -------
    SphereMap

    Raises
    ------
    MeshError
        Or the subclass that says what is wrong with the mesh; TopologyError where it has boundary or handles.
    OptionError
        An option that does not fit.
    SolverError
        The numerical solution failed.
    CancelledError
        The callback returned False.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> octahedron = [[1, 0, 0], [-1, 0, 0], [0, 2, 0], [0, -2, 0], [0, 0, 3], [0, 0, -3]]
    >>> F = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    >>> m = cuv.sphere_map(octahedron, F)
    >>> m.xyz.shape, len(m.flipped)
    ((6, 3), 0)
    """
    options = SphereOptions(
        method=SphereMethod.of("method", method),
        normalization=Normalization.of("normalization", normalization),
        rotation=Rotation.of("rotation", rotation),
        landmarks=landmarks,  # type: ignore[arg-type]
        boundary=SphereBoundary.of("boundary", boundary),
        tolerance=tolerance,
        max_iterations=max_iterations,
        laplacian=Laplacian.of("laplacian", laplacian),
        repair=Repair.of("repair", repair),
    )
    choose_backend(backend)  # complains of what is not there before any work
    progress = Progress(callback)
    progress("checks", 0.0)
    surface = Surface.from_arrays(*triangles_of(V, F))
    n, m = surface.n, surface.m
    if options.boundary is SphereBoundary.CAP and surface.loops:
        surface = surface.capped()
    _require_sphere(surface)
    surface.require_extent()
    _check_landmarks(options.landmarks, n)
    closed = ClosedSurface(surface, options, backend, progress)
    solution = closed.solved()
    converged = solution.status not in (Status.STALLED, Status.MAX_ITERATIONS)
    if not converged:
        log.warning("%s stopped before its tolerance, after %d rows", solution.method, len(solution.history))
    progress("placement", 0.0)
    x = _placed(surface, solution.x, closed.mass, options)
    if options.repair is not Repair.NEVER and len(inverted_faces(x, surface.corners)) > len(solution.folds):
        x = mended(surface, x, progress)  # crowded faces that rounding has turned over
    result = _result(closed, x, (n, m), solution, converged, options)
    progress("placement", 1.0)
    return result


def _require_sphere(surface: Surface) -> None:
    if surface.pieces > 1:
        raise DisconnectedError(f"The mesh has {surface.pieces} pieces that do not touch; map each by itself.")
    if surface.loops:
        loops = len(surface.loops)
        advice = "Use disk_map()." if loops == 1 and surface.genus == 0 else "Fill its holes first."
        raise TopologyError(
            f"The surface has {loops} boundary loop{'s' * (loops > 1)}; a sphere has none. {advice}",
            [loop[0] for loop in surface.loops],
        )
    if surface.genus:
        raise TopologyError(
            f"The surface is closed but has genus {surface.genus}: no map to the sphere keeps its angles. "
            "Cut it open and use unwrap()."
        )


def _check_landmarks(landmarks: tuple[int, int, int] | None, n: int) -> None:
    if landmarks is not None and (len(set(landmarks)) < 3 or min(landmarks) < 0 or max(landmarks) >= n):
        told = ", ".join(map(str, landmarks))
        raise OptionError(f"landmarks are {told}; pass three different vertices of 0 .. {n - 1}.")


def _placed(surface: Surface, x: Real, mass: Real, options: SphereOptions) -> Real:
    if options.landmarks is not None:
        return unit(landmark_aligned(x, options.landmarks))
    if options.normalization is Normalization.CENTER:
        mass = np.full(surface.n, 1.0 / surface.n)
        x = centred(x, mass)
    if options.rotation is Rotation.PRINCIPAL:
        x = x @ principal_rotation(x, mass).T
    elif options.rotation is Rotation.SURFACE:
        x = x @ surface_rotation(x, surface.V, mass).T
    return unit(x)


def _result(
    closed: ClosedSurface,
    x: Real,
    own: tuple[int, int],
    solution: SphereSolution,
    converged: bool,
    options: SphereOptions,
) -> SphereMap:
    surface, laplacian = closed.surface, closed.laplacian
    a, b, c = (x[corner] for corner in surface.corners)
    dirichlet = sum(laplacian.energy(column.astype(np.complex128)) for column in x.T)
    corners = surface.corners if laplacian.corners is None else laplacian.corners
    wound = np.where(outward_signs(x, corners) < 0, -1.0, 1.0)
    area = 0.5 * float(triangle_geometry(x, corners).double_area @ wound)
    vertices, faces = own
    inverted = inverted_faces(x, surface.corners)
    return SphereMap(
        xyz=x[:vertices],
        full=x,
        dirichlet_energy=dirichlet,
        conformal_energy=dirichlet - area,
        signed_volume=float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0,
        flipped=inverted[inverted < faces],
        converged=converged,
        history=solution.history,
        repaired=solution.unfolded,
        method=solution.method,
        status=solution.status,
        normalization=options.normalization,
        laplacian=laplacian.kind,
        surface=surface,
    )

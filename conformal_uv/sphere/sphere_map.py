"""The conformal map of a closed genus-0 surface onto the unit sphere."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from operator import index

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..disk.options import checked_limits
from ..errors import DisconnectedError, OptionError, TopologyError
from ..linear.backends import choose_backend
from ..mesh.geometry import triangle_geometry
from ..mesh.surface import Surface
from ..operators.areas import lumped_areas
from ..operators.dirichlet import DirichletProblem
from ..operators.edge_laplacian import LAPLACIANS, EdgeLaplacian, edge_laplacian
from ..operators.orientation_sign import inverted_faces, outward_signs
from ..optimize import AugmentedLagrangianStep, NewtonStep, augmented_lagrangian
from ..progress import Callback, Progress
from .augmented_lagrangian import SphereProblem
from .centring import centred, landmark_aligned, principal_rotation, surface_rotation, unit
from .energy import SphereEnergy
from .newton import SphereNewton, minimise_sphere_energy
from .puncture import linear_sphere, most_regular_vertex
from .repair import unfolded
from .result import SphereMap

__all__ = ["sphere_map"]

Real = NDArray[np.float64]
log = logging.getLogger(__name__)

CHOICES = {
    "method": ("newton", "linear", "augmented-lagrangian"),
    "boundary": ("refuse", "cap"),
    "normalization": ("area", "centre", "none"),
    "rotation": ("principal", "surface", "none"),
    "laplacian": LAPLACIANS,
    "repair": ("auto", "never"),
}


def sphere_map(
    V: ArrayLike,
    F: ArrayLike,
    *,
    method: str = "newton",
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
    F : (m, 3) integers
        Triangles of one closed surface of genus 0, wound anticlockwise seen from outside.
    method : {"newton", "linear", "augmented-lagrangian"}
        "linear": the disk's map of the surface without its most regular vertex, projected stereographically.
        "newton": from there to a minimiser of the conformal energy among the maps that are centred by area.
        "augmented-lagrangian": the same minimiser in the way of Choi's report, for small meshes.
    normalization : {"area", "centre", "none"}
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
    """
    given = dict(
        method=method,
        normalization=normalization,
        rotation=rotation,
        boundary=boundary,
        laplacian=laplacian,
        repair=repair,
    )
    for name, value in given.items():
        if not isinstance(value, str) or value not in CHOICES[name]:
            raise OptionError(f"{name} is {value!r}; choose {', '.join(CHOICES[name])}.")
    tolerance, _, max_iterations = checked_limits(tolerance, max_iterations)
    choose_backend(backend)  # complains of what is not there before any work
    progress = Progress(callback)
    progress("checks", 0.0)
    surface = Surface.from_arrays(V, F)
    n, m = surface.n, surface.m
    if boundary == "cap" and surface.loops:
        surface = surface.capped()
    _require_sphere(surface)
    surface.require_extent()
    marks = _landmarks(landmarks, n)
    mass = lumped_areas(surface.geometry, surface.corners, surface.n)
    mass = mass / mass.sum() if mass.sum() > 0.0 else np.full(surface.n, 1.0 / surface.n)
    edges = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, laplacian)
    x = centred(linear_sphere(surface, laplacian, backend, progress), mass)
    x, folded = _unfolded(surface, x, mass, repair, progress)
    history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...] = ()
    converged = True
    if method != "linear":
        if method == "newton":
            x, history, converged = _newton(
                surface, edges, x, mass, tolerance, max_iterations, backend, progress
            )
        else:
            flat, history, converged = augmented_lagrangian(
                SphereProblem(edges, surface.corners, mass),
                x.reshape(-1),
                max_iterations=max_iterations,
                progress=progress,
            )
            x = unit(flat.reshape(-1, 3))
        x, after = _unfolded(surface, x, mass, repair, progress)
        folded += after
        if not converged:
            log.warning("%s stopped before its tolerance, after %d rows", method, len(history))
    progress("placement", 0.0)
    x = _placed(surface, x, mass, normalization, rotation, marks)
    result = _result(surface, edges, x, (n, m), history, converged, folded, method, normalization)
    progress("placement", 1.0)
    return result


def _require_sphere(surface: Surface) -> None:
    if surface.pieces > 1:
        raise DisconnectedError(f"The mesh has {surface.pieces} pieces that do not touch; map each by itself.")
    if surface.loops:
        advice = "Use disk_map()." if len(surface.loops) == 1 and surface.genus == 0 else "Fill its holes first."
        raise TopologyError(
            f"The surface has {len(surface.loops)} boundary loops; a sphere has none. {advice}",
            [loop[0] for loop in surface.loops],
        )
    if surface.genus:
        raise TopologyError(
            f"The surface is closed but has genus {surface.genus}: no map to the sphere keeps its angles. "
            "Cut it open and use unwrap()."
        )


def _landmarks(landmarks: Sequence[int] | None, n: int) -> tuple[int, int, int] | None:
    if landmarks is None:
        return None
    try:
        a, b, c = (index(v) for v in landmarks)
    except (TypeError, ValueError) as error:
        raise OptionError(f"landmarks is {landmarks!r}; pass three vertex indices.") from error
    if len({a, b, c}) < 3 or min(a, b, c) < 0 or max(a, b, c) >= n:
        raise OptionError(f"landmarks are {a}, {b}, {c}; pass three different vertices of 0 .. {n - 1}.")
    return a, b, c


def _unfolded(surface: Surface, x: Real, mass: Real, repair: str, progress: Progress) -> tuple[Real, int]:
    """Positions after the repair, centred again, and the number of faces unfolded."""
    before = len(inverted_faces(x, surface.corners))
    if repair == "never" or not before:
        return x, 0
    moved = unfolded(surface, x, progress)
    if moved is x:
        return x, 0
    return centred(moved, mass), before - len(inverted_faces(moved, surface.corners))


def _newton(
    surface: Surface,
    edges: EdgeLaplacian,
    x: Real,
    mass: Real,
    tolerance: float,
    max_iterations: int,
    backend: str,
    progress: Progress,
) -> SphereNewton:
    grounded = np.array([most_regular_vertex(surface)])
    problem = DirichletProblem(
        edges, grounded, surface.n, points=surface.V, backend=backend, progress=progress
    )
    start = SphereEnergy(edges, surface.corners, x)
    return minimise_sphere_energy(
        start, problem, mass, tolerance=tolerance, max_iterations=max_iterations, progress=progress
    )


def _placed(
    surface: Surface, x: Real, mass: Real, normalization: str, rotation: str, marks: tuple[int, int, int] | None
) -> Real:
    if marks is not None:
        return unit(landmark_aligned(x, marks))
    if normalization == "centre":
        mass = np.full(surface.n, 1.0 / surface.n)
        x = centred(x, mass)
    if rotation == "principal":
        x = x @ principal_rotation(x, mass).T
    elif rotation == "surface":
        x = x @ surface_rotation(x, surface.V, mass).T
    return unit(x)


def _result(
    surface: Surface,
    edges: EdgeLaplacian,
    x: Real,
    own: tuple[int, int],
    history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...],
    converged: bool,
    folded: int,
    method: str,
    normalization: str,
) -> SphereMap:
    a, b, c = (x[corner] for corner in surface.corners)
    dirichlet = sum(edges.energy(column.astype(np.complex128)) for column in x.T)
    signs = outward_signs(x, surface.corners)
    area = 0.5 * float(triangle_geometry(x, surface.corners).double_area @ np.where(signs < 0, -1.0, 1.0))
    vertices, faces = own
    inverted = np.flatnonzero(signs <= 0)
    return SphereMap(
        xyz=x[:vertices],
        full=x,
        dirichlet_energy=dirichlet,
        conformal_energy=dirichlet - area,
        signed_volume=float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0,
        flipped=inverted[inverted < faces],
        converged=converged,
        history=history,
        repaired=folded,
        method=method,
        normalization=normalization,
        laplacian=edges.kind,
        surface=surface,
    )

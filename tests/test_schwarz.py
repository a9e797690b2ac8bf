"""The sphere's methods against each other: Schwarz between linear and Newton, and the choice among them."""

from __future__ import annotations

import numpy as np
import pytest
from meshes_closed import icosphere
from numpy.typing import NDArray

import conformal_uv as cuv
from conformal_uv.mesh import Surface
from conformal_uv.operators.edge_laplacian import edge_laplacian
from conformal_uv.operators.orientation_sign import inverted_faces
from conformal_uv.progress import Progress
from conformal_uv.sphere import solution
from conformal_uv.sphere.energy import SphereEnergy
from conformal_uv.sphere.schwarz import TwoCharts
from conformal_uv.sphere.stereographic import from_plane, to_plane

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]

UNSEEN = 0.02  # degrees, that the choice may give away for fewer folds


def ellipsoid(level: int) -> Mesh:
    V, F = icosphere(level)
    return V * [1.0, 1.5, 2.5], F


def limb(level: int) -> Mesh:
    """A sphere with a limb five radii long, where any map to the sphere crowds."""
    V, F = icosphere(level)
    along = np.maximum(V[:, 2] - 0.8, 0.0)
    V[:, 2] += 25.0 * along
    V[:, :2] *= (1.0 - 1.5 * along)[:, None]
    return V, F


def test_harmonic_in_both_charts() -> None:
    V, F = ellipsoid(3)
    surface = Surface.from_arrays(V, F)
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, "cotan")
    start = cuv.sphere_map(V, F, method="linear", rotation="none", laplacian="cotan").xyz
    charts = TwoCharts(laplacian, start, surface.V, "auto", Progress())
    x = charts.alternated(start)
    L = cuv.cotangent_laplacian(V, F)
    south = to_plane(x)  # its chart was the last to be solved in
    assert np.abs((L @ south)[x[:, 2] < -0.05]).max() < 1e-12
    turned = to_plane(np.where(x[:, 2:] > -0.99, x * [1.0, -1.0, -1.0], [0.0, 0.0, -1.0]))
    held = abs(L) @ (start[:, 2] < 0.3) == 0.0  # with all their neighbours, in the south's chart
    assert held.sum() > 100 and np.abs((L @ turned)[held]).max() < 1e-12
    assert held[np.argmax(start[:, 2])]  # the puncture among them, where the linear map is not harmonic
    np.testing.assert_allclose(from_plane(south), x, atol=1e-12)


def test_relaxing_lowers_the_energy_of_the_polyhedron() -> None:
    V, F = ellipsoid(3)
    surface = Surface.from_arrays(V, F)
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n)
    start = cuv.sphere_map(V, F, method="linear", rotation="none").xyz
    charts = TwoCharts(laplacian, start, surface.V, "auto", Progress())
    x = charts.alternated(start)
    relaxed = charts.relaxed(x, surface.corners)
    values = [SphereEnergy(laplacian, surface.corners, y).value for y in (start, x, relaxed)]
    assert values[0] > values[1] > values[2]
    np.testing.assert_allclose(np.linalg.norm(relaxed, axis=1), 1.0, atol=1e-15)


@pytest.mark.parametrize("mesh", [ellipsoid(0), ellipsoid(1), ellipsoid(3), limb(3), limb(4)])
def test_auto_is_never_worse_than_any(mesh: Mesh) -> None:
    found = {method: cuv.sphere_map(*mesh, method=method) for method in ("auto", "linear", "schwarz", "newton")}
    least = min(m.distortion.angle_mean for m in found.values())
    auto = found["auto"]
    assert auto.distortion.angle_mean <= least + UNSEEN
    assert auto.method in ("linear", "schwarz", "newton")
    assert auto.status in ("angles", "converged", "stalled", "direct")
    assert len(auto.flipped) == 0
    assert found["newton"].status in ("converged", "stalled")


def test_newton_folds_no_face_that_was_sound() -> None:
    """On limbs the energy falls by folding crowded faces; such steps are not taken."""
    V, F = limb(4)
    schwarz = cuv.sphere_map(V, F, method="schwarz")
    newton = cuv.sphere_map(V, F, method="newton", repair="never")
    assert len(schwarz.flipped) == len(newton.flipped) == 0
    assert newton.conformal_energy <= schwarz.conformal_energy + 1e-9


def test_large_surfaces_do_without_newton(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(solution, "LARGE", 0)
    m = cuv.sphere_map(*ellipsoid(3))
    assert (m.method, m.status, m.history) == ("schwarz", "no-gain", ())


@pytest.mark.parametrize(
    ("name", "most"),
    [
        ("scans/david", 0.874),
        ("meshes/ods_hammer", 1.42),
        ("meshes/ods_human_man", 5.96),
        ("meshes/ods_wingnut", 1.70),
        ("meshes/ods_goathead", 3.15),
    ],
)
def test_closed_meshes_of_the_data_folder(load_scan, name: str, most: float) -> None:
    """Bounds: a prototype of Schwarz's method, rounded up; goathead's is the linear map's."""
    m = cuv.sphere_map(*load_scan(f"{name}.obj"))
    assert m.distortion.angle_mean <= most
    assert len(m.flipped) == 0


@pytest.mark.parametrize("repair", ["auto", "always"])
def test_folds_of_slivers_are_mended_where_they_are(repair: str) -> None:
    """A vertex of every twentieth star moved onto the opposite edge of a neighbour face: slivers, folded by the
    intrinsic Laplacian's map."""
    V, F = ellipsoid(3)
    rng = np.random.default_rng(0)
    for f in rng.choice(len(F), 20, replace=False):
        a, b, c = F[f]
        V[a] = 0.5 * (V[b] + V[c]) + 1e-3 * (V[a] - V[b])
    folded, mended = (cuv.sphere_map(V, F, method="linear", repair=r) for r in ("never", repair))
    assert len(folded.flipped) > 0
    assert len(mended.flipped) == 0 and mended.repaired == len(folded.flipped)
    assert mended.distortion.angle_mean <= folded.distortion.angle_mean + 0.5
    assert len(inverted_faces(mended.xyz, mended.surface.corners)) == 0

"""The sphere map: known maps, figures on scans, invariance, repair, and what it refuses."""

from __future__ import annotations

import nasty_meshes
import numpy as np
import pytest
from meshes_closed import icosphere
from numpy.typing import NDArray

import conformal_uv as cuv
from conformal_uv.mesh import Surface
from conformal_uv.operators.areas import lumped_areas
from conformal_uv.operators.edge_laplacian import edge_laplacian
from conformal_uv.sphere.centring import centred, unit
from conformal_uv.sphere.energy import SphereEnergy
from conformal_uv.sphere.stereographic import from_plane, to_plane

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]
ELLIPSOID = np.array([1.0, 1.5, 2.5])


def bumpy(level: int = 3) -> Mesh:
    """A star-shaped surface without symmetry, so that its principal axes have senses to tell."""
    V, F = icosphere(level)
    x, y, z = V[:, :1], V[:, 1:2], V[:, 2:]
    return V * (1 + 0.2 * np.sin(3 * x + 1) + 0.15 * np.cos(4 * y * z) + 0.1 * np.sin(2 * y + z)), F


def assert_covers_the_sphere(m: cuv.SphereMap) -> None:
    assert np.abs(np.linalg.norm(m.xyz, axis=1) - 1).max() <= 1e-12
    assert len(m.flipped) == 0
    assert 0.9 < m.signed_volume / (4 * np.pi / 3) < 1.0


def mass(m: cuv.SphereMap) -> NDArray[np.float64]:
    area = lumped_areas(m.surface.geometry, m.surface.corners, m.surface.n)
    return area / area.sum()


# --- known maps ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("level", [1, 2, 3])
def test_round_sphere_comes_back_as_itself(level: int) -> None:
    """The inclusion of an inscribed polyhedron has conformal energy 0; centred by area it is unique up to rotation."""
    V, F = icosphere(level)
    m = cuv.sphere_map(V, F, rotation="surface", tolerance=1e-12)
    assert m.converged and abs(m.conformal_energy) <= 1e-12
    expected = centred(V, mass(m))
    left, _, right = np.linalg.svd(m.xyz.T @ expected)
    np.testing.assert_allclose(m.xyz @ left @ right, expected, rtol=0, atol=1e-10)


def test_refinement_of_an_ellipsoid_converges() -> None:
    """The mean angle error of a convergent map falls at least with h^0.9 and the energy with h^1.8."""
    energies = []
    for level in (2, 3, 4, 5):
        V, F = icosphere(level)
        m = cuv.sphere_map(V * ELLIPSOID, F)
        assert m.converged
        assert_covers_the_sphere(m)
        energies.append(m.conformal_energy)
    rates = np.log2(np.array(energies[:-1]) / energies[1:])
    assert rates.min() >= 1.8


# --- figures ------------------------------------------------------------------------------------------------


def test_david_is_mapped_better_than_flash(load_scan) -> None:
    """FLASH (Choi, Lam, Lui 2015) has 0.912 degrees; the issue asks for 0.89 and 0.880."""
    V, F = load_scan("scans/david.obj")
    linear, newton = (cuv.sphere_map(V, F, method=method) for method in ("linear", "newton"))
    assert linear.distortion.angle_mean <= 0.89 and newton.distortion.angle_mean <= 0.880
    assert newton.converged and newton.gradient_norm <= 1e-8
    assert_covers_the_sphere(linear)
    assert_covers_the_sphere(newton)


def test_cortex_is_mapped_better_than_flash() -> None:
    """The fsaverage5 left pial surface; FLASH has 2.114 degrees, the issue asks for 2.10 and 2.09."""
    nilearn = pytest.importorskip("nilearn", reason="the brain surface comes with nilearn")
    from pathlib import Path

    nibabel = pytest.importorskip("nibabel")
    path = Path(nilearn.__file__).parent / "datasets" / "data" / "fsaverage5" / "pial_left.gii.gz"
    V, F = (array.data for array in nibabel.load(path).darrays[:2])
    linear, newton = (cuv.sphere_map(V, F, method=method) for method in ("linear", "newton"))
    assert linear.distortion.angle_mean <= 2.10 and newton.distortion.angle_mean <= 2.09
    assert_covers_the_sphere(linear)
    assert_covers_the_sphere(newton)


def test_ellipsoid_figure() -> None:
    """Axes 1 : 1.5 : 2.5, 2,562 vertices; the issue asks for 1.24 degrees."""
    V, F = icosphere(4)
    assert len(V) == 2562
    m = cuv.sphere_map(V * ELLIPSOID, F)
    assert m.distortion.angle_mean <= 1.24
    assert_covers_the_sphere(m)


# --- what a result is ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_energies_volume_and_centre_are_what_they_say(method: str) -> None:
    V, F = bumpy()
    m = cuv.sphere_map(V, F, method=method, laplacian="cotan")
    L = cuv.cotangent_laplacian(V, F)
    dirichlet = 0.5 * np.trace(m.xyz.T @ (L @ m.xyz))
    a, b, c = (m.xyz[F[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    # Sums of some thousand terms of size 1: rounding 1e-13.
    assert m.dirichlet_energy == pytest.approx(dirichlet, abs=1e-11)
    assert m.conformal_energy == pytest.approx(dirichlet - area, abs=1e-11)
    assert m.signed_volume == pytest.approx(np.einsum("ij,ij->", a, np.cross(b, c)) / 6, abs=1e-11)
    assert np.linalg.norm(mass(m) @ m.xyz) <= 1e-12
    second = m.xyz.T @ (mass(m)[:, None] * m.xyz)
    assert np.abs(second - np.diag(np.diag(second))).max() <= 1e-12
    assert second[0, 0] >= second[1, 1] >= second[2, 2]


def test_newton_lowers_the_energy_and_is_certified() -> None:
    V, F = bumpy()
    linear, newton = (cuv.sphere_map(V, F, method=method) for method in ("linear", "newton"))
    assert newton.conformal_energy < linear.conformal_energy
    assert linear.history == () and linear.converged
    energy = np.array([row.energy for row in newton.history])
    assert np.diff(energy).max() <= 1e-12
    assert newton.converged and newton.gradient_norm <= 1e-8
    # With the gauge fixed the energy does not drift: going on changes nothing.
    further = cuv.sphere_map(V, F, method="newton", tolerance=1e-11)
    assert further.conformal_energy == pytest.approx(newton.conformal_energy, abs=1e-12)
    stopped = cuv.sphere_map(V, F, method="newton", max_iterations=0)
    assert not stopped.converged and stopped.status == "max-iterations"


def test_derivatives_of_the_energy() -> None:
    V, F = bumpy(2)
    surface = Surface.from_arrays(V, F)
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, "cotan")
    rng = np.random.default_rng(0)
    x = unit(V + 0.02 * rng.normal(size=V.shape))  # no face inverted: its area would count negative
    energy = SphereEnergy(laplacian, surface.corners, x)
    one, two = (energy.tangent(rng.normal(size=V.shape)) for _ in range(2))

    def along(t: float) -> float:
        return SphereEnergy(laplacian, surface.corners, x + t * one).value

    # Central differences, error h^2 times a derivative, plus rounding over h or h^2.
    assert np.vdot(energy.gradient, one) == pytest.approx((along(1e-5) - along(-1e-5)) / 2e-5, rel=1e-6)
    second = (along(1e-4) - 2 * along(0.0) + along(-1e-4)) / 1e-8
    assert np.vdot(energy.hessian_product(one), one) == pytest.approx(second, rel=1e-5)
    other = np.vdot(one, energy.hessian_product(two))
    assert np.vdot(energy.hessian_product(one), two) == pytest.approx(other, rel=1e-12)


def test_newton_and_the_reports_way_find_one_minimiser() -> None:
    """Two independent algorithms; they agree up to a rotation as far as the slower one's tolerance of 1e-8 goes."""
    V, F = icosphere(2)
    V = V * [1.0, 1.2, 1.5] * (1 + 0.1 * np.sin(2 * V[:, :1] + V[:, 1:2]))
    newton = cuv.sphere_map(V, F, rotation="none", tolerance=1e-11)
    report = cuv.sphere_map(V, F, method="augmented-lagrangian", rotation="none")
    assert report.converged and report.history[-1].constraint_norm < 1e-8
    assert report.conformal_energy == pytest.approx(newton.conformal_energy, abs=1e-9)
    left, _, right = np.linalg.svd(report.xyz.T @ newton.xyz)
    np.testing.assert_allclose(report.xyz @ left @ right, newton.xyz, rtol=0, atol=1e-6)


def test_capped_boundary_is_left_out_of_the_result() -> None:
    """A sphere with one face taken out, closed again by the cap, is nearly the sphere."""
    V, F = icosphere(3)
    m = cuv.sphere_map(V, F[1:], boundary="cap", rotation="surface")
    assert m.xyz.shape == V.shape and len(m.flipped) == 0
    assert np.abs(np.linalg.norm(m.xyz, axis=1) - 1).max() <= 1e-12
    whole = cuv.sphere_map(V, F, rotation="surface")
    assert np.abs(m.xyz - whole.xyz).max() < 0.05  # an edge is 0.14
    assert m.distortion.angle_error.shape == (len(F) - 1 + 3, 3)
    with pytest.raises(cuv.TopologyError, match="boundary"):
        cuv.sphere_map(V, F[1:])


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_rotated_scaled_and_relabelled_copies_have_the_same_map(method: str) -> None:
    V, F = bumpy()
    rng = np.random.default_rng(3)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    order = rng.permutation(len(V))
    place = np.argsort(order)
    one = cuv.sphere_map(V, F, method=method)
    two = cuv.sphere_map(1e3 * (V @ turn)[order] + [5.0, -7.0, 2.0], place[F][rng.permutation(len(F))], method=method)
    np.testing.assert_allclose(two.xyz, one.xyz[order], rtol=0, atol=1e-7)


# --- normal positions ---------------------------------------------------------------------------------------


def test_centring_undoes_a_map_pushed_far_off() -> None:
    """Nearly everything pushed into a spot of a hundredth of the sphere's radius comes back."""
    V, _ = icosphere(3)
    weight = np.full(len(V), 1 / len(V))
    pushed = from_plane(to_plane(V @ np.array([[1, 0, 0], [0, 0.8, 0.6], [0, -0.6, 0.8]])) * 1e-2)
    assert np.linalg.norm(weight @ pushed) > 0.99
    back = centred(pushed, weight)
    assert np.linalg.norm(weight @ back) <= 1e-13
    expected = centred(V, weight)
    left, _, right = np.linalg.svd(back.T @ expected)
    np.testing.assert_allclose(back @ left @ right, expected, rtol=0, atol=1e-9)


def test_landmarks_come_to_their_places() -> None:
    V, F = bumpy()
    m = cuv.sphere_map(V, F, landmarks=(10, 200, 300))
    np.testing.assert_array_equal(m.xyz[[10, 200, 300]], [[0, 0, -1], [1, 0, 0], [0, 0, 1]])
    # A Moebius map: cross-ratios of the plane are those of the map without landmarks.
    four = [1, 50, 120, 250]
    z, w = (to_plane(x[four]) for x in (cuv.sphere_map(V, F).xyz, m.xyz))

    def cross_ratio(p: NDArray[np.complex128]) -> complex:
        a, b, c, d = p
        return complex((a - c) * (b - d) / ((b - c) * (a - d)))

    assert cross_ratio(w) == pytest.approx(cross_ratio(z), rel=1e-9)


def test_stereographic_projection_is_its_own_inverse_and_keeps_the_outside_outside() -> None:
    z = np.array([0.3 + 0.1j, 1.2 - 0.5j, -0.2 + 2j])
    np.testing.assert_allclose(to_plane(from_plane(z)), z, rtol=1e-14)
    a, b, c = from_plane(z)
    anticlockwise = ((z[1] - z[0]).conjugate() * (z[2] - z[0])).imag > 0
    assert (a @ np.cross(b, c) > 0) == anticlockwise


# --- bad input ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("mesh", "error", "words"),
    [
        (nasty_meshes.MASK, cuv.TopologyError, "disk_map"),
        (nasty_meshes.torus(), cuv.TopologyError, "genus 1"),
        (nasty_meshes.grid(4, 4, 1, 1), cuv.TopologyError, "boundary"),
        (
            (np.vstack((icosphere(1)[0], icosphere(1)[0] + 9)), np.vstack((icosphere(1)[1], icosphere(1)[1] + 42))),
            cuv.DisconnectedError,
            "2 pieces",
        ),
    ],
)
def test_other_surfaces_are_refused(mesh: Mesh, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        cuv.sphere_map(*mesh)


@pytest.mark.parametrize(
    "options",
    [
        {"method": "magic"},
        {"normalization": "centroid"},
        {"rotation": "upside"},
        {"laplacian": "uniform"},
        {"landmarks": (1, 2)},
        {"landmarks": (1, 1, 2)},
        {"landmarks": (0, 1, 99999)},
        {"tolerance": 0.0},
    ],
    ids=str,
)
def test_options_that_do_not_fit_are_refused(options: dict) -> None:
    with pytest.raises(cuv.OptionError):
        cuv.sphere_map(*icosphere(1), **options)


def test_tetrahedron_is_the_smallest_sphere() -> None:
    """Regular, it comes back as itself."""
    V = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    m = cuv.sphere_map(V, [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    np.testing.assert_allclose(m.xyz @ m.xyz.T, V @ V.T / 3, rtol=0, atol=1e-9)


def test_slivers_and_zero_area_faces_are_mapped() -> None:
    V, F = nasty_meshes.flattened(*bumpy(), 20, 1e-4)
    V, F = nasty_meshes.flattened(V, F, 5, 0.0, seed=2)
    m = cuv.sphere_map(V, F)
    assert m.laplacian == "intrinsic-delaunay"
    assert np.isfinite(m.xyz).all() and len(m.flipped) == 0


def test_callback_sees_the_stages_and_cancels() -> None:
    seen: list[str] = []

    def note(stage: str, fraction: float) -> None:
        assert 0.0 <= fraction <= 1.0
        seen.append(stage)

    cuv.sphere_map(*bumpy(2), callback=note)
    assert [stage for k, stage in enumerate(seen) if k == 0 or stage != seen[k - 1]][0] == "checks"
    assert {"checks", "assembly", "factorization", "linear", "newton", "placement"} <= set(seen)
    for stop in range(len(seen)):
        calls = iter(range(len(seen)))
        with pytest.raises(cuv.CancelledError):
            cuv.sphere_map(*bumpy(2), callback=lambda stage, fraction, c=calls, s=stop: next(c) != s)

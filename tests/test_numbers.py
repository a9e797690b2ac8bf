"""Numbers that are said of meshes and maps: right at every scale, and of what is stored."""

from __future__ import annotations

import numpy as np
import pytest
from meshes_closed import icosphere
from nasty_meshes import flattened, grid
from scipy.spatial.transform import Rotation

import conformal_uv as cuv
from conformal_uv.mesh.arrays import on_one_line
from conformal_uv.operators.angle_mean import AngleMean
from conformal_uv.samples import mask

SCALES = [1e-150, 1e-100, 1e-78, 1e-20, 1e20, 1e80, 1e100, 1e150]
MESH = mask(400)


def bumpy_sphere(level: int) -> tuple[np.ndarray, np.ndarray]:
    V, F = icosphere(level)
    return V * (1.0 + 0.3 * V[:, :1] * V[:, 1:2] + 0.2 * V[:, 2:] ** 3 + 0.1 * V[:, :1]), F


def powers(scale: float) -> float:
    """The power of two next to a scale: results then differ by nothing but their exponents."""
    return float(2.0 ** np.round(np.log2(scale)))


@pytest.mark.parametrize("scale", SCALES)
def test_measures_at_every_scale(scale: float) -> None:
    V, F = MESH
    s = powers(scale)
    np.testing.assert_array_equal(cuv.face_areas(s * V, F), cuv.face_areas(V, F) * s * s)
    np.testing.assert_array_equal(cuv.mixed_voronoi_areas(s * V, F), cuv.mixed_voronoi_areas(V, F) * s * s)
    np.testing.assert_array_equal(cuv.gradient(s * V, F).toarray(), cuv.gradient(V, F).toarray() / s)
    lengths = np.linalg.norm(V[F[:, [1, 2, 0]]] - V[F[:, [2, 0, 1]]], axis=2)
    np.testing.assert_array_equal(
        cuv.cotangent_laplacian_intrinsic(s * lengths, F).toarray(),
        cuv.cotangent_laplacian_intrinsic(lengths, F).toarray(),
    )


@pytest.mark.parametrize("image_scale", [1e-150, 1.0, 1e150])
@pytest.mark.parametrize("scale", SCALES)
def test_distortion_at_every_scale_of_surface_and_image(scale: float, image_scale: float) -> None:
    V, F = MESH
    uv = cuv.disk_map(V, F, method="linear").uv
    s, t = powers(scale), powers(image_scale)
    at_one, here = cuv.distortion(V, F, uv), cuv.distortion(s * V, F, t * uv)
    np.testing.assert_array_equal(here.angle_error, at_one.angle_error)
    np.testing.assert_array_equal(here.quasi_conformal, at_one.quasi_conformal)
    np.testing.assert_array_equal(here.flipped, at_one.flipped)
    with np.errstate(over="ignore", under="ignore"):
        wanted = at_one.area_scale * (t / s) ** 2 if 1e-150 < t / s < 1e150 else at_one.area_scale * (t / s) * (t / s)
    np.testing.assert_allclose(here.area_scale, wanted, rtol=1e-15)


@pytest.mark.parametrize("scale", SCALES)
def test_distortion_of_charts_and_spheres_at_every_scale(scale: float) -> None:
    V, F = MESH
    s = powers(scale)
    at_one, here = (cuv.unwrap(k * V, F, method="linear").charts[0].distortion for k in (1.0, s))
    np.testing.assert_array_equal(here.angle_error, at_one.angle_error)
    V, F = bumpy_sphere(2)
    at_one, here = (cuv.sphere_map(k * V, F, method="linear").distortion for k in (1.0, s))
    np.testing.assert_array_equal(here.angle_error, at_one.angle_error)
    assert len(here.flipped) == len(at_one.flipped) == 0


@pytest.mark.parametrize("scale", [1e-150, 1e-9, 1.0, 1e150])
@pytest.mark.parametrize("shift", [0.0, 1e6])
def test_vertices_on_one_line_are_refused(scale: float, shift: float) -> None:
    V, F = grid(20, 20, 1.0, 1.0)
    rng = np.random.default_rng(1)
    for along in (V[:, :1], V[:, :1] ** 2 + V[:, 1:2], np.zeros((400, 1))):
        line = scale * (shift * rng.normal(size=3) + along * rng.normal(size=3))
        with pytest.raises(cuv.DegenerateFaceError, match="one line") as caught:
            cuv.disk_map(line, F)
        assert len(caught.value.indices) == len(F)
        result = cuv.unwrap(line, F)
        assert not result.mapped.any() and isinstance(result.charts[0].error, cuv.DegenerateFaceError)
        assert "one line" in str(result.charts[0].error)
    V, F = bumpy_sphere(2)
    with pytest.raises(cuv.DegenerateFaceError, match="one line"):
        cuv.sphere_map(scale * (shift + V[:, :1] * rng.normal(size=3)), F)


def test_a_line_is_told_from_a_strip_as_far_as_rounding_lets() -> None:
    rng = np.random.default_rng(5)
    turned = Rotation.random(random_state=3).as_matrix()
    along = np.sort(rng.random(300))
    for width, line in ((0.0, True), (1e-17, True), (1e-13, False), (1e-6, False)):
        V = np.column_stack((along, width * rng.random(300), np.zeros(300))) @ turned.T
        assert on_one_line(V) is line, width


@pytest.mark.parametrize("thinness", [1e-3, 1e-12, 1e-100])
def test_a_thin_sheet_is_no_line(thinness: float) -> None:
    V, F = grid(10, 10, 1.0, thinness)
    assert len(cuv.disk_map(V, F, method="linear").uv) == 100


def test_lost_to_float32_is_that_of_the_packed_islands() -> None:
    """Two ribbons side by side: in single precision more is lost of an island in a small corner of the square."""
    V, F = grid(120, 4, 30.0, 1.0)
    count = 9
    V = np.concatenate([V + [0.0, 2.0 * k, 0.0] for k in range(count)])
    F = np.concatenate([F + 480 * k for k in range(count)])
    result = cuv.unwrap(V, F, method="linear", repair="never")
    corners = result.uv.astype(np.float32).astype(float).reshape(-1, 3, 2)
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    lost = result.lost_to_float32()
    # differences and products of float32 numbers are exact in doubles, the last difference is not: few are near 0
    assert abs(int(lost.sum()) - int((areas <= 0.0).sum())) <= 2
    assert len(lost) == count
    alone = sum(len(chart.map.lost_to_float32) for chart in result.charts)
    assert lost.sum() > alone  # what was said before


def test_lost_to_float32_follows_the_caller_s_own_packing() -> None:
    V, F = MESH
    result = cuv.unwrap(V, F, method="linear")
    assert result.lost_to_float32().sum() == 0
    assert result.lost_to_float32(result.uv + 2e6).sum() > len(F) // 2
    turned = result.uv @ Rotation.from_rotvec([0, 0, 1.0]).as_matrix()[:2, :2].T
    assert result.lost_to_float32(turned).sum() == 0


def test_energy_of_a_folded_sphere_is_the_solver_s() -> None:
    V, F = bumpy_sphere(3)
    rng = np.random.default_rng(0)
    found = cuv.sphere_map(V + 0.12 * rng.normal(size=V.shape), F, method="linear", repair="never", laplacian="cotan")
    assert len(found.flipped) > 0
    x = found.xyz
    normal = np.cross(x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]])
    sign = np.where(np.einsum("ij,ij->i", x[F[:, 0]], normal) < 0.0, -1.0, 1.0)
    area = 0.5 * float(sign @ np.linalg.norm(normal, axis=1))
    assert found.conformal_energy == pytest.approx(found.dirichlet_energy - area, abs=1e-12)


def test_backend_of_the_augmented_lagrangian() -> None:
    V, F = mask(200)
    assert cuv.disk_map(V, F, method="augmented-lagrangian", max_iterations=1).backend == "superlu"


@pytest.mark.parametrize(("surface", "image", "scale"), [(1e-300, 1e300, np.inf), (1e300, 1e-300, 0.0)])
def test_areas_that_no_double_can_compare(surface: float, image: float, scale: float) -> None:
    """The quotient of the units has no double either; angles are what they are, and nothing warns."""
    V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), [[0, 1, 2]]
    d = cuv.distortion(surface * V, F, image * V[:, :2])
    assert d.area_scale.tolist() == [scale] and d.angle_max == pytest.approx(0.0, abs=1e-13)


def test_angle_mean_of_maps_that_differ_in_few_vertices() -> None:
    """Against the whole distortion; where nothing, little and much was moved, faces without area among them."""
    V, F = flattened(*mask(800), 5, 0.0)
    m = cuv.disk_map(V, F)
    z = np.ascontiguousarray(m.uv).view(np.complex128).reshape(-1)
    angles = AngleMean(m.surface, z)
    rng = np.random.default_rng(0)
    for count in (0, 3, 700):
        moved = z.copy()
        moved[rng.choice(len(z), count, replace=False)] *= 0.9
        expected = cuv.distortion(V, F, moved.view(np.float64).reshape(-1, 2)).angle_mean
        assert angles.of(moved) == pytest.approx(expected, rel=1e-12)
    assert angles.of(z) == angles.first == pytest.approx(m.distortion.angle_mean, rel=1e-12)

"""Operators against hand-worked triangles, closed forms and independent formulas.

Tolerances are rounding bounds: a few eps, times how much a thin triangle magnifies it (`thinness`), times the size
of the terms that were added up.
"""

from __future__ import annotations

import importlib.util
from fractions import Fraction

import meshes
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import diags_array

import conformal_uv as cuv
from conformal_uv import samples
from conformal_uv.linear import backends
from conformal_uv.linear.backends import choose_backend, linear_solver
from conformal_uv.linear.linear_system import LowerTriangle
from conformal_uv.mesh import Surface
from conformal_uv.operators import DirichletProblem
from conformal_uv.operators.edge_laplacian import cotan_edges
from conformal_uv.operators.wirtinger import conformal_energy, enclosed_area

EPS = np.finfo(float).eps
HAS_CHOLMOD = importlib.util.find_spec("cvxopt") is not None
needs_cholmod = pytest.mark.skipif(not HAS_CHOLMOD, reason="the CHOLMOD backend needs cvxopt")

# A(0,0) B(4,0) C(1,3): cot A = 1/3, cot B = 1, cot C = 1/2, area 6, circumcentre (2, 1).
ACUTE = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 3.0, 0.0]])
# A(0,0) B(4,0) C(1,1): obtuse at C, area 2.
OBTUSE = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
ONE = np.array([[0, 1, 2]])

GENERATED = {
    "flat disk": samples.flat_disk(500, seed=1),
    "cap": samples.spherical_cap(500, 80.0, seed=2),
    "mask": samples.mask(800, seed=3),
    "terrain": samples.terrain(600, seed=4),
    "plate with holes": meshes.plate(7, 5, ((1, 1, 2, 3), (5, 2, 1, 1))),
    "torus": meshes.torus(12, 9),
}


def opposite_lengths(V: NDArray, F: NDArray) -> NDArray:
    """Length of the edge opposite to each corner, (m, 3)."""
    return np.stack([np.linalg.norm(V[F[:, (c + 1) % 3]] - V[F[:, (c + 2) % 3]], axis=1) for c in range(3)], axis=1)


def thinness(V: NDArray, F: NDArray) -> float:
    """Largest ratio of the longest edge squared to twice the area: rounding in a cotangent grows with it."""
    cross = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    return float((opposite_lengths(V, F).max(axis=1) ** 2 / np.linalg.norm(cross, axis=1)).max())


def dirichlet_problem(V: NDArray, F: NDArray, backend: str = "auto") -> DirichletProblem:
    """That of the cotangent Laplacian, with the boundary loop given."""
    surface = Surface.from_arrays(V, F)
    laplacian = cotan_edges(surface.edges, surface.geometry)
    return DirichletProblem(laplacian, surface.require_disk(), len(V), backend=backend)


def turned_into_space(xy: NDArray) -> NDArray:
    """Plane points put into a slanted plane by a rotation (Rodrigues' matrix of the quaternion 1, 2, -1, 3)."""
    w, x, y, z = np.array([1.0, 2.0, -1.0, 3.0]) / np.sqrt(15.0)
    return (
        xy
        @ np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        ).T
    )


# --- Laplacians ---------------------------------------------------------------------------------------------


def test_cotangent_laplacian_of_a_hand_worked_triangle() -> None:
    """Weights are half the opposite cotangents: AB 1/4, BC 1/6, CA 1/2."""
    ab, bc, ca = Fraction(1, 4), Fraction(1, 6), Fraction(1, 2)
    expected = [[ab + ca, -ab, -ca], [-ab, ab + bc, -bc], [-ca, -bc, ca + bc]]
    L = cuv.cotangent_laplacian(ACUTE, ONE)
    np.testing.assert_allclose(L.toarray(), np.array(expected, dtype=float), rtol=4 * EPS)


def test_negative_weight_of_an_obtuse_angle() -> None:
    """At C: CA . CB = (-1, -1) . (3, -1) = -2, twice the area 4, so cot C = -1/2 and w_AB = -1/4."""
    assert cuv.cotangent_laplacian(OBTUSE, ONE)[0, 1] == pytest.approx(0.25, rel=4 * EPS)


def test_two_triangles_share_the_weight_of_their_edge() -> None:
    """A square's diagonal has two right angles opposite, weight 0; its sides one of 45 degrees, weight 1/2."""
    L = cuv.cotangent_laplacian(*meshes.strip(1)).toarray()
    side = -0.5
    expected = [[1, side, side, 0], [side, 1, 0, side], [side, 0, 1, side], [0, side, side, 1]]
    np.testing.assert_allclose(L, expected, atol=4 * EPS)


@pytest.mark.parametrize("name", GENERATED)
def test_laplacian_is_divergence_of_gradient(name: str) -> None:
    """L = G' M G, entry by entry within the rounding of the sums on the right."""
    V, F = GENERATED[name]
    G, M = cuv.gradient(V, F), diags_array(np.repeat(cuv.face_areas(V, F), 3))
    difference = abs(cuv.cotangent_laplacian(V, F) - G.T @ M @ G)
    bound = 8 * EPS * thinness(V, F) * (abs(G).T @ M @ abs(G))
    assert (difference - bound).max() <= 0.0


@pytest.mark.parametrize("name", GENERATED)
def test_intrinsic_laplacian_is_the_extrinsic_one(name: str) -> None:
    V, F = GENERATED[name]
    L = cuv.cotangent_laplacian(V, F)
    intrinsic = cuv.cotangent_laplacian_intrinsic(opposite_lengths(V, F), F)
    # Squared lengths are off by a few eps of the longest; that over twice the area, once for dot and once for area.
    assert abs(L - intrinsic).max() <= 16 * EPS * thinness(V, F) ** 2


def test_intrinsic_laplacian_refuses_lengths_without_area() -> None:
    with pytest.raises(cuv.DegenerateFaceError) as caught:
        cuv.cotangent_laplacian_intrinsic([[1, 1, 1], [1, 2, 3], [1, 1, 5]], [[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    assert caught.value.indices == (1, 2)  # on a line, and no triangle at all


@pytest.mark.parametrize("operator", [cuv.cotangent_laplacian, cuv.gradient, cuv.mixed_voronoi_areas])
def test_operators_refuse_faces_without_area(operator) -> None:
    with pytest.raises(cuv.DegenerateFaceError) as caught:
        operator([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]], [[0, 1, 3], [0, 1, 2]])
    assert caught.value.indices == (1,)


@pytest.mark.parametrize("seed", range(3))
def test_linear_functions_are_harmonic_on_flat_ground(seed: int) -> None:
    V, F = samples.flat_disk(400, seed)
    boundary = cuv.disk_map(V, F, method="linear").boundary
    inside = np.setdiff1d(np.arange(len(V)), boundary)
    L = cuv.cotangent_laplacian(turned_into_space(V), F)
    x = V @ [0.3, -1.7, 0.0] + 5.0
    bound = 8 * EPS * thinness(V, F) * (abs(L) @ np.abs(x))
    assert (np.abs(L @ x) <= bound)[inside].all()
    assert np.abs((L @ x)[boundary]).max() > 0.01  # the flux across the boundary: L is not just 0


@pytest.mark.parametrize("name", GENERATED)
def test_laplacian_is_semidefinite_with_the_constants_as_kernel(name: str) -> None:
    V, F = GENERATED[name]
    L = cuv.cotangent_laplacian(V, F).toarray()
    np.testing.assert_array_equal(L, L.T)
    values = np.linalg.eigvalsh(L)
    rounding = len(V) * EPS * values[-1]
    assert abs(values[0]) <= rounding
    assert values[1] > 1e3 * rounding  # connected: nothing else in the kernel
    assert np.abs(L.sum(axis=1)).max() <= 8 * EPS * np.abs(L).sum(axis=1).max()


def test_uniform_laplacian_is_degree_minus_adjacency() -> None:
    F = meshes.plate(7, 5, ((1, 1, 2, 3), (5, 2, 1, 1)))[1]
    n = int(F.max()) + 1
    adjacency = np.zeros((n, n))
    for a, b, c in F:
        for i, j in ((a, b), (b, c), (c, a)):
            adjacency[i, j] = adjacency[j, i] = 1.0
    np.testing.assert_array_equal(cuv.uniform_laplacian(F).toarray(), np.diag(adjacency.sum(axis=1)) - adjacency)
    assert cuv.uniform_laplacian(F, n + 2).shape == (n + 2, n + 2)


# --- areas and gradient -------------------------------------------------------------------------------------


def test_face_areas_by_hand() -> None:
    np.testing.assert_allclose(cuv.face_areas(ACUTE, ONE), [6.0], rtol=4 * EPS)
    np.testing.assert_allclose(cuv.face_areas(turned_into_space(OBTUSE), ONE), [2.0], rtol=16 * EPS)
    octahedron = cuv.face_areas(*meshes.octahedron())  # edges of length sqrt 2
    np.testing.assert_allclose(octahedron, np.full(8, np.sqrt(3.0) / 2.0), rtol=4 * EPS)


def test_mixed_voronoi_areas_by_hand() -> None:
    """The acute triangle's regions are cut at the circumcentre (2, 1): at A the quadrilateral (0,0) (2,0) (2,1)
    (1/2, 3/2) of area 9/4, at B 7/4, at C 2. The obtuse one is shared 1/4, 1/4, 1/2; the right-angled one goes
    the same way by either rule."""
    np.testing.assert_allclose(cuv.mixed_voronoi_areas(ACUTE, ONE), [2.25, 1.75, 2.0], rtol=8 * EPS)
    np.testing.assert_allclose(cuv.mixed_voronoi_areas(OBTUSE, ONE), [0.5, 0.5, 1.0], rtol=8 * EPS)
    right = np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0]])
    np.testing.assert_allclose(cuv.mixed_voronoi_areas(right, ONE), [1.0, 0.5, 0.5], rtol=8 * EPS)


@pytest.mark.parametrize("name", GENERATED)
def test_mixed_voronoi_areas_sum_to_the_area(name: str) -> None:
    V, F = GENERATED[name]
    areas, total = cuv.mixed_voronoi_areas(V, F), cuv.face_areas(V, F).sum()
    assert areas.min() > 0.0
    assert areas.sum() == pytest.approx(total, rel=8 * EPS * thinness(V, F))


def test_gradient_of_linear_functions() -> None:
    """On a slanted plane the gradient of x -> d . x is d less its normal part, on every face."""
    V, F = samples.flat_disk(300, seed=5)
    d = np.array([0.4, -1.1, 0.7])
    normal = turned_into_space(np.array([[0.0, 0.0, 1.0]]))[0]
    W = turned_into_space(V)
    got = (cuv.gradient(W, F) @ (W @ d)).reshape(-1, 3)
    shortest = np.sqrt(4.0 / np.sqrt(3.0) * cuv.face_areas(W, F).min())  # values are rounded by eps, over this
    bound = 8 * EPS * thinness(W, F) / shortest
    np.testing.assert_allclose(got, np.tile(d - (d @ normal) * normal, (len(F), 1)), rtol=0, atol=bound)


# --- Moebius maps -------------------------------------------------------------------------------------------

CIRCLE = np.exp(1j * np.array([0.1, 0.4, 1.9, 2.2, 3.6, 5.5]))


def test_three_pairs_are_met() -> None:
    z, w = [0.3 + 1j, -2.0, 0.5j], [1.0 + 1j, 4.0 - 2j, -3.0]
    np.testing.assert_allclose(cuv.Moebius.from_three_pairs(z, w)(z), w, rtol=32 * EPS)


def test_three_pairs_on_the_circle_give_a_map_of_the_disk() -> None:
    m = cuv.Moebius.from_three_pairs(CIRCLE[[0, 2, 4]], np.exp(2j * np.pi / 3 * np.arange(3)))
    np.testing.assert_allclose(np.abs(m(CIRCLE)), 1.0, rtol=0, atol=32 * EPS)
    assert abs(m(0.3 - 0.2j)) < 1.0
    backwards = cuv.Moebius.from_three_pairs(CIRCLE[[0, 4, 2]], np.exp(2j * np.pi / 3 * np.arange(3)))
    assert abs(backwards(0.3 - 0.2j)) > 1.0  # the other order turns the disk inside out


@pytest.mark.parametrize("p", [0.0, 0.3 + 0.4j, -0.99j, 0.999999])
def test_to_zero(p: complex) -> None:
    m = cuv.Moebius.to_zero(p, CIRCLE[1])
    assert abs(m(p)) <= EPS / (1.0 - abs(p))
    assert m.disk_centre() == pytest.approx(p, abs=4 * EPS)
    magnified = 64 * EPS / (1.0 - abs(p))  # the derivative at the circle's nearest point is (1 + |p|) / (1 - |p|)
    assert abs(m(CIRCLE[1]) - 1.0) <= magnified
    np.testing.assert_allclose(np.abs(m(CIRCLE)), 1.0, rtol=0, atol=magnified)
    turns = np.angle(np.roll(m(CIRCLE), -1) / m(CIRCLE)) % (2 * np.pi)
    assert turns.sum() == pytest.approx(2 * np.pi)  # once round, in the same direction
    # Closed form |(z - p) / (1 - conj(p) z)| of the hyperbolic distance.
    z = 0.2 - 0.5j
    assert abs(m(z)) == pytest.approx(abs((z - p) / (1 - np.conj(p) * z)), rel=1e-14)


def test_composition_and_inverse() -> None:
    one, two = cuv.Moebius(1 + 2j, 0.5, 0.2j, 1 - 1j), cuv.Moebius(0.3, 2j, 1.0, -1 + 0.5j)
    z = CIRCLE * np.linspace(0.1, 0.9, 6)
    np.testing.assert_allclose((one @ two)(z), one(two(z)), rtol=32 * EPS)
    assert np.abs((one @ two)(z) - (two @ one)(z)).min() > 1e-3  # the order matters for these
    np.testing.assert_allclose(one.inverse()(one(z)), z, rtol=64 * EPS)
    np.testing.assert_allclose((one @ one.inverse())(z), z, rtol=64 * EPS)


@pytest.mark.parametrize("p", [1.0, 0.6 + 0.8j, 2.0, complex(np.nan, 0)])
def test_to_zero_refuses_points_outside(p: complex) -> None:
    with pytest.raises(cuv.OptionError, match="not inside the unit disk"):
        cuv.Moebius.to_zero(p)


@pytest.mark.parametrize(
    ("z", "w"),
    [
        ([0, 1, 1], [0, 1, 2]),
        ([0, 1, 2], [3, 1, 3]),
        ([0, 1], [0, 1]),
        ([0, 1, 2, 3], [0, 1, 2, 3]),
        ([0, 1, np.nan], [0, 1, 2]),
        ([0, 1, 2], [0, 1, np.inf]),
    ],
)
def test_three_pairs_must_be_three_different_points(z: list, w: list) -> None:
    with pytest.raises(cuv.OptionError, match="Three different points"):
        cuv.Moebius.from_three_pairs(z, w)


# --- distortion ---------------------------------------------------------------------------------------------


def singular_values(V: NDArray, F: NDArray, image: NDArray) -> NDArray:
    """Of each face's linear map, by LAPACK in orthonormal frames of both triangles: the independent oracle."""

    def in_frame(P: NDArray) -> NDArray:
        P = np.column_stack((P, np.zeros((len(P), 3 - P.shape[1]))))
        sides = np.stack((P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]]), axis=2)
        return np.linalg.qr(sides)[1]

    return np.linalg.svd(in_frame(image) @ np.linalg.inv(in_frame(V)), compute_uv=False)


def angles(V: NDArray, F: NDArray) -> NDArray:
    """Corner angles in degrees, by the law of cosines."""
    a, b, c = opposite_lengths(V, F).T
    return np.degrees(
        np.arccos(
            np.stack(
                (
                    (b * b + c * c - a * a) / (2 * b * c),
                    (c * c + a * a - b * b) / (2 * c * a),
                    (a * a + b * b - c * c) / (2 * a * b),
                ),
                axis=1,
            )
        )
    )


def test_distortion_of_the_identity() -> None:
    V, F = samples.flat_disk(400, seed=6)
    W = turned_into_space(V)
    bound = 32 * EPS * thinness(V, F)
    d = cuv.distortion(W, F, V[:, :2])
    assert d.angle_max <= np.degrees(bound)
    np.testing.assert_allclose(d.quasi_conformal, 1.0, rtol=0, atol=bound)
    np.testing.assert_allclose(d.area_scale, 1.0, rtol=0, atol=bound)
    assert len(d.flipped) == 0


@pytest.mark.parametrize(
    ("matrix", "large", "small"),
    [
        ([[3.0, 0.0], [0.0, 0.5]], 3.0, 0.5),
        ([[1.0, 1.5], [0.0, 1.0]], 2.0, 0.5),  # shear k: singular values (sqrt(k^2 + 4) +- k) / 2
        ([[0.6, -0.8], [0.8, 0.6]], 1.0, 1.0),
        ([[-1.2, -1.6], [-1.6, 1.2]], 2.0, 2.0),  # reflection and doubling
    ],
)
def test_distortion_of_linear_maps(matrix: list, large: float, small: float) -> None:
    V, F = samples.flat_disk(200, seed=7)
    uv = V[:, :2] @ np.array(matrix).T
    d = cuv.distortion(turned_into_space(V), F, uv)
    bound = 64 * EPS * thinness(V, F) * large / small
    np.testing.assert_allclose(d.quasi_conformal, large / small, rtol=bound)
    np.testing.assert_allclose(d.area_scale, large * small, rtol=bound)
    np.testing.assert_array_equal(d.flipped, np.arange(len(F)) if np.linalg.det(matrix) < 0 else [])
    expected = np.abs(angles(np.column_stack((uv, 0 * uv[:, 0])), F) - angles(V, F))
    np.testing.assert_allclose(d.angle_error, expected, rtol=0, atol=1e-11)  # arccos loses half the digits at worst
    assert d.angle_mean == pytest.approx(expected.mean(), abs=1e-11)
    assert d.angle_sd == pytest.approx(np.sqrt(((expected - expected.mean()) ** 2).mean()), abs=1e-11)
    assert d.angle_max == pytest.approx(expected.max(), abs=1e-11)


def test_shear_of_the_hand_worked_triangle() -> None:
    """(x, y) -> (x + y, y) takes A, B, C to (0,0), (4,0), (4,3): angles atan 3/4, 90 degrees and the rest."""
    before = np.degrees([np.arctan(3.0), np.pi / 4, np.arctan(2.0)])
    after = np.degrees([np.arctan(0.75), np.pi / 2, np.arctan(4 / 3)])
    d = cuv.distortion(ACUTE, ONE, [[0, 0], [4, 0], [4, 3]])
    np.testing.assert_allclose(d.angle_error, [np.abs(after - before)], rtol=1e-13)
    np.testing.assert_allclose(d.quasi_conformal, (3 + np.sqrt(5)) / 2, rtol=1e-14)  # golden ratio squared
    np.testing.assert_allclose(d.area_scale, 1.0, rtol=1e-14)


@pytest.mark.parametrize("columns", [2, 3])
def test_distortion_against_singular_values(columns: int) -> None:
    """Random images in the plane and in space; half of the faces fold over."""
    V, F = samples.mask(400, seed=8)
    image = np.random.default_rng(9).normal(size=(len(V), columns))
    d = cuv.distortion(V, F, image)
    sigma = singular_values(V, F, image)
    ratio = sigma[:, 0] / sigma[:, 1]
    # The smaller value is off by eps of the larger, so the ratio by eps times its square.
    np.testing.assert_allclose(d.quasi_conformal / ratio, 1.0, rtol=0, atol=64 * EPS * thinness(V, F) * ratio.max())
    np.testing.assert_allclose(d.area_scale, sigma.prod(axis=1), rtol=64 * EPS * thinness(V, F) * ratio.max())
    a, b, c = (image[F[:, k]] for k in range(3))
    if columns == 2:
        signed = np.linalg.det(np.stack((b - a, c - a), axis=1))
    else:
        signed = np.linalg.det(np.stack((a, b, c), axis=1))  # seen from the origin
    np.testing.assert_array_equal(d.flipped, np.flatnonzero(signed <= 0))
    assert 0.4 * len(F) < len(d.flipped) < 0.6 * len(F)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_area_scale_has_the_units_of_the_surface(unit: float) -> None:
    V, F = samples.mask(300, seed=10)
    one = cuv.disk_map(V, F, method="linear")
    other = cuv.distortion(unit * V, F, one.uv)
    bound = 64 * EPS * thinness(V, F)
    np.testing.assert_allclose(other.area_scale * unit**2, cuv.distortion(V, F, one.uv).area_scale, rtol=bound)
    np.testing.assert_allclose(other.quasi_conformal, one.distortion.quasi_conformal, rtol=bound)
    # and so has that of the map itself, which works on scaled positions
    m = cuv.disk_map(unit * V, F, method="linear")
    np.testing.assert_allclose(m.distortion.area_scale, cuv.distortion(unit * V, F, m.uv).area_scale, rtol=bound)


@pytest.mark.parametrize("solid", [meshes.octahedron, meshes.icosahedron])
def test_inscribed_solids_are_their_own_sphere_maps(solid) -> None:
    V, F = solid()
    d = cuv.distortion(7.0 * V, F, V)
    assert d.angle_max <= 1e-12
    np.testing.assert_allclose(d.quasi_conformal, 1.0, rtol=0, atol=64 * EPS)
    np.testing.assert_allclose(d.area_scale, 1 / 49, rtol=64 * EPS)
    assert len(d.flipped) == 0
    everything = np.arange(len(F))
    np.testing.assert_array_equal(cuv.distortion(V, F, -V).flipped, everything)  # the antipodal map
    np.testing.assert_array_equal(cuv.distortion(V, F[:, ::-1], V).flipped, everything)
    one = F.copy()
    one[3] = one[3, ::-1]
    np.testing.assert_array_equal(cuv.distortion(V, one, V).flipped, [3])


def test_faces_without_image_area_are_told() -> None:
    V, F = meshes.plate(3, 3)
    for columns in (2, 3):
        image = V[:, :columns].copy()
        image[6] = image[5]  # the edge of faces 4 and 10
        d = cuv.distortion(V, F, image)
        assert np.isinf(d.quasi_conformal[[4, 10]]).all()
        np.testing.assert_array_equal(np.flatnonzero(d.area_scale == 0.0), [4, 10])
        assert {4, 10} <= set(d.flipped.tolist())
        assert np.isfinite(d.angle_error).all()


@pytest.mark.parametrize("shape", [(15, 2), (16, 1), (16, 4), (16,), (2, 16)])
def test_image_of_another_shape_is_refused(shape: tuple[int, ...]) -> None:
    V, F = meshes.plate(3, 3)
    with pytest.raises(cuv.MeshError, match=r"image has shape .*; pass \(16, 2\) or \(16, 3\)"):
        cuv.distortion(V, F, np.zeros(shape))


def test_image_that_is_not_finite_is_refused() -> None:
    V, F = meshes.plate(3, 3)
    image = V[:, :2].copy()
    image[[4, 9]] = [[np.nan, 0.0], [0.0, -np.inf]]
    with pytest.raises(cuv.NonFiniteError, match="2 vertices is NaN or infinite: vertices 4, 9") as caught:
        cuv.distortion(V, F, image)
    assert caught.value.indices == (4, 9)


def test_faces_without_area_on_the_surface_are_told() -> None:
    """Infinite scale and ratio there, nothing not a number, the other faces as they were."""
    V, F = meshes.plate(3, 3)
    W = V.copy()
    W[6] = W[5]  # the edge of faces 4 and 10
    d = cuv.distortion(W, F, V[:, :2])
    assert np.isinf(d.area_scale[[4, 10]]).all() and np.isinf(d.quasi_conformal[[4, 10]]).all()
    rest = np.setdiff1d(np.arange(len(F)), [4, 10])
    np.testing.assert_allclose(d.quasi_conformal[rest], cuv.distortion(W, F[rest], V[:, :2]).quasi_conformal, rtol=EPS)
    assert np.isfinite(d.area_scale[rest]).all() and np.isfinite(d.angle_error).all()
    assert len(d.flipped) == 0


# --- energies -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["cap", "mask", "terrain"])
def test_energies_against_the_matrix_and_the_boundary_polygon(name: str) -> None:
    """1/2 uv' L uv, and less the shoelace area of the boundary; for a random image, not a map the code made."""
    V, F = GENERATED[name]
    surface = Surface.from_arrays(V, F)
    uv = np.random.default_rng(11).normal(size=(len(V), 2))
    z = uv[:, 0] + 1j * uv[:, 1]
    dirichlet = 0.5 * float(np.sum(uv * (cuv.cotangent_laplacian(V, F) @ uv)))
    x, y = uv[surface.require_disk()].T
    area = 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    assert abs(area) > 0.1  # energies that leave it out or turn it round fail below
    bound = 64 * EPS * thinness(V, F) * dirichlet
    assert abs(conformal_energy(surface.geometry, z, surface.corners) - (dirichlet - area)) <= bound
    assert enclosed_area(z[surface.require_disk()]) == pytest.approx(area, rel=1e-12)


def test_a_collapsed_face_keeps_no_angle() -> None:
    """All of its corners count as 0, so each is off by its own angle, and so for collapsed faces of the surface."""
    V, F = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]
    point = np.zeros((3, 2))
    np.testing.assert_allclose(cuv.distortion(V, F, point).angle_error, [[90, 45, 45]], rtol=1e-15)
    np.testing.assert_allclose(cuv.distortion(np.zeros((3, 3)), F, V[:, :2]).angle_error, [[90, 45, 45]], rtol=1e-15)


# --- linear solves ------------------------------------------------------------------------------------------


def lower_triangle(A: NDArray) -> LowerTriangle:
    """A dense symmetric matrix in the form that is factorized."""
    rows = [np.concatenate(([j], j + 1 + np.flatnonzero(A[j + 1 :, j]))) for j in range(len(A))]
    return LowerTriangle(
        np.concatenate([A[r, j] for j, r in enumerate(rows)]),
        np.concatenate(rows).astype(np.int32),
        np.concatenate(([0], np.cumsum([len(r) for r in rows]))),
    )


BACKENDS = [pytest.param("cholmod", marks=needs_cholmod), "superlu"]


@pytest.mark.parametrize("backend", BACKENDS)
def test_backend_solves(backend: str) -> None:
    """Against numpy's dense solve, for one and for several right-hand sides, which stay as they were."""
    rng = np.random.default_rng(12)
    B = rng.normal(size=(40, 40)) * (rng.random((40, 40)) < 0.1)
    A = B @ B.T + 3.0 * np.eye(40)
    factor = linear_solver(lower_triangle(A), backend)
    assert factor.backend == backend
    bound = 40 * EPS * np.linalg.cond(A)
    for shape in ((40,), (40, 2)):
        rhs = rng.normal(size=shape)
        kept = rhs.copy()
        x = factor.solve(rhs)
        expected = np.linalg.solve(A, rhs)
        assert x.shape == shape
        assert np.abs(x - expected).max() <= bound * np.abs(expected).max()
        np.testing.assert_array_equal(rhs, kept)


@pytest.mark.parametrize("backend", BACKENDS)
def test_backend_solves_for_a_few_rows(backend: str) -> None:
    """As for the whole right-hand sides; entries that come out 0 on a block of their own among them."""
    A = np.zeros((30, 30))
    A[:20, :20] = 4.0 * np.eye(20) - np.eye(20, k=1) - np.eye(20, k=-1)
    A[20:, 20:] = 2.0 * np.eye(10)
    solver = linear_solver(lower_triangle(A), backend)
    rows = np.array([1, 5, 22])
    for k in (1, 2, 5):
        values = np.random.default_rng(k).normal(size=(3, k))
        rhs = np.zeros((30, k))
        rhs[rows] = values
        np.testing.assert_allclose(solver.solve_at(rows, values), solver.solve(rhs), rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("backend", BACKENDS)
def test_singular_matrix_is_refused(backend: str) -> None:
    A = np.diag([2.0, 0.0, 1.0])
    with pytest.raises(cuv.SolverError, match="singular to working precision") as caught:
        linear_solver(lower_triangle(A), backend)
    assert isinstance(caught.value, RuntimeError)


def test_choice_of_backend(monkeypatch: pytest.MonkeyPatch) -> None:
    V, F = meshes.plate(3, 3)
    monkeypatch.delenv("CONFORMAL_UV_BACKEND", raising=False)
    assert cuv.disk_map(V, F).backend == ("cholmod" if HAS_CHOLMOD else "superlu")
    assert cuv.disk_map(V, F, backend="superlu").backend == "superlu"
    monkeypatch.setenv("CONFORMAL_UV_BACKEND", " SuperLU ")
    assert cuv.disk_map(V, F).backend == "superlu"
    if HAS_CHOLMOD:
        assert cuv.disk_map(V, F, backend="cholmod").backend == "cholmod"  # the option goes first
    monkeypatch.setenv("CONFORMAL_UV_BACKEND", "pardiso")
    with pytest.raises(cuv.OptionError, match="'pardiso'; choose auto, cholmod, superlu or multigrid"):
        cuv.disk_map(V, F)
    with pytest.raises(cuv.OptionError, match="'umfpack'"):
        cuv.disk_map(V, F, backend="umfpack")


def test_backends_without_cvxopt(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CONFORMAL_UV_BACKEND", raising=False)
    monkeypatch.setattr(backends.importlib.util, "find_spec", lambda name: None)
    assert choose_backend() == "superlu"
    with pytest.raises(cuv.MissingDependencyError, match="pip install cvxopt"):
        choose_backend("cholmod")


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name", ["cap", "terrain"])
def test_dirichlet_problem_against_a_dense_solve(name: str, backend: str) -> None:
    """Extension, flux (the Schur complement) and harmonic measure; vertex order mixed by a relabelling."""
    V, F = GENERATED[name]
    shuffle = np.random.default_rng(13).permutation(len(V))
    V, F = V[np.argsort(shuffle)], shuffle[F]
    problem = dirichlet_problem(V, F, backend)
    b = problem.boundary
    i = np.setdiff1d(np.arange(len(V)), b)
    L = cuv.cotangent_laplacian(V, F).toarray()
    Lii, Lib, Lbb = L[np.ix_(i, i)], L[np.ix_(i, b)], L[np.ix_(b, b)]
    bound = len(V) * EPS * np.linalg.cond(Lii)
    assert bound < 1e-8
    rng = np.random.default_rng(14)
    zb = rng.normal(size=len(b)) + 1j * rng.normal(size=len(b))
    zi = -np.linalg.solve(Lii, Lib @ zb)
    z = problem.extend(zb)
    np.testing.assert_array_equal(z[b], zb)
    np.testing.assert_allclose(z[i], zi, rtol=0, atol=bound)
    S = Lbb - Lib.T @ np.linalg.solve(Lii, Lib)
    np.testing.assert_allclose(problem.flux(zb, problem.interior_values(zb)), S @ zb, rtol=0, atol=10 * bound)
    pole = len(i) // 2
    h = -np.linalg.solve(Lii, Lib)[pole]
    np.testing.assert_allclose(problem.harmonic_measure(int(i[pole])), h, rtol=0, atol=bound)


def test_dirichlet_problem_without_interior() -> None:
    V, F = meshes.strip(4)
    problem = dirichlet_problem(V, F)
    b = problem.boundary
    zb = np.exp(1j * np.arange(len(b)))
    np.testing.assert_array_equal(problem.extend(zb)[b], zb)
    L = cuv.cotangent_laplacian(V, F).toarray()[np.ix_(b, b)]
    np.testing.assert_allclose(problem.flux(zb, problem.interior_values(zb)), L @ zb, rtol=0, atol=32 * EPS)


@pytest.mark.parametrize("seed", range(3))
def test_harmonic_measure_is_a_probability_on_a_delaunay_mesh(seed: int) -> None:
    """Weights are non-negative there, so the maximum principle holds; seen from every vertex in turn."""
    V, F = samples.flat_disk(300, seed)
    problem = dirichlet_problem(V, F)
    measures = np.array([problem.harmonic_measure(int(v)) for v in problem.interior])
    assert measures.min() >= -len(V) * EPS
    np.testing.assert_allclose(measures.sum(axis=1), 1.0, rtol=0, atol=len(V) * EPS)
    # A coordinate is its own harmonic extension: the mean of the boundary under the measure is the vertex.
    np.testing.assert_allclose(measures @ V[problem.boundary], V[problem.interior], rtol=0, atol=len(V) * EPS)


def test_harmonic_function_converges_at_second_order() -> None:
    """Manufactured solution x^2 - y^2 on the disk, triangles cut in four, new boundary vertices on the circle.

    In the L2 norm, where piecewise linear elements are of second order without a logarithm (Aubin, Nitsche).
    """

    def on_circle(points: NDArray, outside: NDArray) -> NDArray:
        points = points.copy()
        points[outside] /= np.linalg.norm(points[outside], axis=1)[:, None]
        return points

    mesh = samples.flat_disk(40, seed=15)
    error = []
    for _ in range(5):
        V, F = mesh
        problem = dirichlet_problem(V, F)
        exact = V[:, 0] ** 2 - V[:, 1] ** 2
        found = problem.extend(exact[problem.boundary] + 0j).real
        error.append(float(np.sqrt(cuv.mixed_voronoi_areas(V, F) @ (found - exact) ** 2)))
        mesh = meshes.refined(mesh, on_circle)
    rates = np.log2(np.array(error[:-1]) / error[1:])
    print("errors", error, "rates", rates)
    assert rates[1:].min() >= 1.8

"""Maps to the disk: the report's published figures, closed forms, invariants, two algorithms against each other.

Meshes are generated, or the data folder's (skipped without it).
"""

from __future__ import annotations

import importlib.util
import itertools
import logging
import subprocess
import sys
from pathlib import Path

import meshes
import numpy as np
import pytest
from numpy.typing import NDArray

import conformal_uv as cuv
from conformal_uv import samples
from conformal_uv.disk.boundary_energy import BoundaryEnergy
from conformal_uv.mesh import Surface
from conformal_uv.operators import DirichletProblem, dirichlet
from conformal_uv.operators.edge_laplacian import cotan_edges
from conformal_uv.optimize import NewtonStep

EPS = np.finfo(float).eps
CUBE_ROOTS = np.array([1.0, -0.5 + 0.75**0.5 * 1j, -0.5 - 0.75**0.5 * 1j])
METHODS = ("linear", "newton", "augmented-lagrangian")

GENERATED = {
    "flat disk": samples.flat_disk(700, seed=1),
    "cap": samples.spherical_cap(700, 110.0, seed=2),
    "mask": samples.mask(1500, seed=3),
    "terrain": samples.terrain(900, seed=4),
}
SMALLER = {  # for the augmented Lagrangian, some hundred factorizations
    "flat disk": samples.flat_disk(200, seed=1),
    "cap": samples.spherical_cap(200, 110.0, seed=2),
    "mask": samples.mask(300, seed=3),
    "terrain": samples.terrain(200, seed=4),
}


def generated(name: str, method: str) -> tuple[NDArray, NDArray]:
    return (SMALLER if method == "augmented-lagrangian" else GENERATED)[name]


def as_complex(m: cuv.DiskMap) -> NDArray[np.complex128]:
    return m.uv[:, 0] + 1j * m.uv[:, 1]


def shoelace(points: NDArray) -> float:
    x, y = points.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def signed_areas(uv: NDArray, F: NDArray) -> NDArray:
    p = uv[F]
    return 0.5 * np.linalg.det(np.stack((p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1))


def assert_is_a_disk_embedding(m: cuv.DiskMap, F: NDArray) -> None:
    """On the circle to 1e-12, once round it, inside it, no face turned over: together, one to one onto the polygon."""
    rim = m.uv[m.boundary]
    np.testing.assert_allclose(np.hypot(*rim.T), 1.0, rtol=0, atol=1e-12)
    assert np.hypot(*m.uv.T).max() <= 1.0 + 1e-12
    z = as_complex(m)[m.boundary]
    gaps = np.angle(np.roll(z, -1) / z)
    assert gaps.min() > 0.0
    assert gaps.sum() == pytest.approx(2.0 * np.pi)
    areas = signed_areas(m.uv, F)
    assert areas.min() > 0.0
    assert len(m.flipped) == 0
    assert areas.sum() == pytest.approx(shoelace(rim), rel=1e-12)


# --- the report's published output --------------------------------------------------------------------------


def report_mesh(folder: Path, name: str) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """V, F, the author's uv and his table (rho, norm of the constraints, norm of the KKT residual)."""
    V, uv = (np.loadtxt(folder / "choi_report" / f"{name}_{kind}.dat", delimiter=",") for kind in ("v", "uv"))
    F = np.loadtxt(folder / "choi_report" / f"{name}_f.dat", delimiter=",", dtype=int) - 1
    table = np.loadtxt(folder / "choi_report" / f"table_{name}.csv", delimiter=",", skiprows=1)
    return V, F, uv, table[:, 1:]


@pytest.mark.parametrize("name", ["test1", "testr"])
def test_augmented_lagrangian_repeats_the_reports_tables(data_folder: Path, name: str) -> None:
    """Printed to 12 decimals; entries below 1e-9 are round-off there (data/README.md)."""
    V, F, uv, table = report_mesh(data_folder, name)
    m = cuv.disk_map(V, F, method="augmented-lagrangian")
    rows = np.array(m.history)
    assert rows.shape == table.shape == (11, 3)
    np.testing.assert_array_equal(rows[:, 0], table[:, 0])
    small = table[:, 1:] < 1e-9
    assert rows[:, 1:][small].max() < 1e-9
    np.testing.assert_allclose(rows[:, 1:][~small], table[:, 1:][~small], rtol=0, atol=1e-8)
    np.testing.assert_allclose(m.uv, uv, rtol=0, atol=1e-10)
    assert m.converged
    assert (m.method, m.objective) == ("augmented-lagrangian", "dirichlet")


@pytest.mark.parametrize("name", ["test1", "testr"])
def test_pinned_newton_meets_the_authors_coordinates(data_folder: Path, name: str) -> None:
    """Another algorithm for the same minimiser; the author stops at 1e-8, so 1e-9 in the coordinates."""
    V, F, uv, _ = report_mesh(data_folder, name)
    m = cuv.disk_map(V, F, pin_mode="constraint", objective="dirichlet")
    assert m.converged and m.gradient_norm < 1e-10
    np.testing.assert_allclose(m.uv, uv, rtol=0, atol=1e-9)


@pytest.mark.parametrize("objective", ["dirichlet", "conformal"])
def test_newton_and_augmented_lagrangian_have_one_minimiser(objective: str) -> None:
    """Two independent algorithms under the same pins; the second stops at residuals of 1e-8."""
    V, F = SMALLER["cap"]
    boundary = cuv.disk_map(V, F, method="linear").boundary
    pins = boundary[[3, 14, 30]]
    al = cuv.disk_map(V, F, method="augmented-lagrangian", objective=objective, pins=pins)
    mapper = cuv.DiskMapper(V, F, laplacian="cotan")
    newton = mapper.map(pin_mode="constraint", objective=objective, pins=pins)
    assert al.converged and newton.converged
    np.testing.assert_allclose(al.uv, newton.uv, rtol=0, atol=1e-8)
    assert_is_a_disk_embedding(newton, F)
    other = mapper.map(
        pin_mode="constraint", objective="conformal" if objective == "dirichlet" else "dirichlet", pins=pins
    )
    assert np.abs(other.uv - newton.uv).max() > 1e-5  # the objectives differ, so do their minimisers


def test_augmented_lagrangian_starts_from_tuttes_embedding() -> None:
    """design.md 3.3: boundary equally spaced from its first vertex, every other vertex the mean of its neighbours."""
    V, F = GENERATED["mask"]
    m = cuv.disk_map(V, F, method="augmented-lagrangian", max_iterations=0)
    assert m.history == () and not m.converged
    z, nb = as_complex(m), len(m.boundary)
    np.testing.assert_allclose(z[m.boundary], np.exp(2j * np.pi * np.arange(nb) / nb), rtol=0, atol=1e-14)
    residual = cuv.uniform_laplacian(F) @ z
    inside = np.setdiff1d(np.arange(len(V)), m.boundary)
    assert np.abs(residual[inside]).max() < 1e-12


def test_stopped_augmented_lagrangian_says_so() -> None:
    V, F = SMALLER["cap"]
    whole = cuv.disk_map(V, F, method="augmented-lagrangian")
    part = cuv.disk_map(V, F, method="augmented-lagrangian", max_iterations=3)
    assert whole.converged and not part.converged
    assert part.history == whole.history[:3]
    assert whole.history[-1].constraint_norm < 1e-8
    assert whole.gradient_norm is None


# --- scans --------------------------------------------------------------------------------------------------


def test_human_face(load_scan) -> None:
    """The bars are those of design.md, set by the prototype on this scan (17,157 vertices)."""
    V, F = load_scan("scans/human_face.obj")
    mapper = cuv.DiskMapper(V, F)
    linear, newton = mapper.map(method="linear"), mapper.map(method="newton")
    for m in (linear, newton):
        assert_is_a_disk_embedding(m, F)
    assert linear.conformal_energy <= 3.60e-3
    assert linear.distortion.angle_mean <= 1.211
    assert newton.conformal_energy <= 3.38e-3
    assert newton.converged and newton.gradient_norm <= 1e-8
    assert len(newton.history) - 1 <= 8
    assert sum(row.cg_steps for row in newton.history) <= 45


@pytest.mark.parametrize("method", ["linear", "newton"])
@pytest.mark.parametrize(
    "name",
    ["confmap_bumpcap", "ods_cube_no_bottom", "ods_demosthenes_low_res", "ods_hand_lowres"]
    + ["cut_fish_low", "cut_goathead"],
)
def test_disks_of_the_data_folder(load_scan, name: str, method: str) -> None:
    V, F = load_scan(f"meshes/{name}.obj")
    m = cuv.disk_map(V, F, method=method)
    assert_is_a_disk_embedding(m, F)
    assert m.converged


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_a_face_crowded_out_is_told(load_scan, method: str) -> None:
    """The cut penguin has an ear whose angle on the circle, 1e-11, leaves doubles no area; all others stand right."""
    V, F = load_scan("meshes/cut_penguin.obj")
    m = cuv.disk_map(V, F, method=method)
    assert m.converged
    assert len(m.flipped) <= 1
    np.testing.assert_array_equal(m.lost_to_double, m.flipped)
    areas = signed_areas(m.uv, F)
    assert np.delete(areas, m.flipped).min() > 0.0
    assert np.abs(areas[m.flipped]).max(initial=0.0) < 1e-20


# --- invariants of every map --------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", GENERATED)
def test_generated_surfaces_are_embedded(name: str, method: str) -> None:
    V, F = generated(name, method)
    m = cuv.disk_map(V, F, method=method)
    assert_is_a_disk_embedding(m, F)
    assert m.converged
    np.testing.assert_array_equal(m.boundary, meshes.slow_loops(F)[0])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", GENERATED)
def test_energies_of_the_map_are_those_of_its_coordinates(name: str, method: str) -> None:
    """1/2 uv' L uv with the matrix, less the shoelace area of the boundary polygon; rounding of sums of size pi."""
    V, F = generated(name, method)
    m = cuv.disk_map(V, F, method=method)
    expected = 0.5 * float(np.sum(m.uv * (cuv.cotangent_laplacian(V, F) @ m.uv)))
    assert m.dirichlet_energy == pytest.approx(expected, abs=1e-12)
    assert m.conformal_energy == pytest.approx(expected - shoelace(m.uv[m.boundary]), abs=1e-12)
    assert m.conformal_energy >= 0.0


@pytest.mark.parametrize("name", ["cap", "mask", "terrain"])
def test_newton_lowers_the_energy_of_linear(name: str) -> None:
    """With no step allowed the linear map stays; the minimum lies below it, at the energy the solver saw last."""
    V, F = GENERATED[name]
    mapper = cuv.DiskMapper(V, F, laplacian="cotan")  # energies are reported of the mesh's own cotangents
    linear, newton = mapper.map(method="linear"), mapper.map(method="newton")
    start = mapper.map(method="newton", max_iterations=0)
    np.testing.assert_allclose(start.uv, linear.uv, rtol=0, atol=1e-14)
    assert newton.conformal_energy < linear.conformal_energy
    assert newton.history[-1].energy == pytest.approx(newton.conformal_energy, abs=1e-12)


# --- closed forms -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("n", "seed"), [(60, 0), (700, 1), (3000, 2)])
def test_flat_disk_comes_back_as_itself(n: int, seed: int) -> None:
    """It is its own map, up to a Moebius map of the disk; gradient 1e-10 leaves angles exact to about 1e-9."""
    V, F = samples.flat_disk(n, seed)
    m = cuv.disk_map(V, F)
    assert m.conformal_energy <= 1e-12
    assert m.distortion.angle_max <= 1e-5
    z, w = as_complex(m), V[:, 0] + 1j * V[:, 1]
    three = m.boundary[[0, len(m.boundary) // 3, 2 * len(m.boundary) // 3]]
    np.testing.assert_allclose(cuv.Moebius.from_three_pairs(w[three], z[three])(w), z, rtol=0, atol=1e-9)


def cap_error(V: NDArray, F: NDArray, angle: float, method: str, three: NDArray | None = None) -> float:
    """Largest distance of the map from the stereographic projection, three boundary vertices made to agree."""
    m = cuv.disk_map(V, F, method=method)
    z, w = as_complex(m), (V[:, 0] + 1j * V[:, 1]) / (1.0 + V[:, 2]) / np.tan(np.radians(angle) / 2.0)
    if three is None:
        three = m.boundary[[0, len(m.boundary) // 3, 2 * len(m.boundary) // 3]]
    return float(np.abs(cuv.Moebius.from_three_pairs(w[three], z[three])(w) - z).max())


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_cap_converges_to_its_stereographic_projection(method: str) -> None:
    """Quasi-uniform irregular meshes, edges halved three times: second order over the whole range."""
    error = [cap_error(*samples.spherical_cap(300 * 4**k, 60.0), 60.0, method) for k in range(4)]
    rate = np.log2(error[0] / error[3]) / 3.0
    print(method, "errors", error, "rate", rate)
    assert rate >= 1.8


def test_linear_map_of_a_refined_cap_converges_at_second_order() -> None:
    """One coarse cap, triangles cut in four, new vertices on the sphere and, outside, on the cap's rim.

    Newton's maximum error on such meshes carries the factor log(1/h) that is known of linear elements in the
    maximum norm (Scott 1976), with rates of 1.5 to 1.8 here; so the test of both methods is the one above.
    """
    height, radius = np.cos(np.radians(60.0)), np.sin(np.radians(60.0))

    def on_cap(points: NDArray, outside: NDArray) -> NDArray:
        points = points / np.linalg.norm(points, axis=1)[:, None]
        rim = points[outside, :2]
        points[outside, :2] = radius * rim / np.linalg.norm(rim, axis=1)[:, None]
        points[outside, 2] = height
        return points

    mesh, error = samples.spherical_cap(40, 60.0), []
    loop = np.array(meshes.slow_loops(mesh[1])[0])
    three = loop[[0, len(loop) // 3, 2 * len(loop) // 3]]  # the same vertices on every level
    for _ in range(4):
        error.append(cap_error(*mesh, 60.0, "linear", three))
        mesh = meshes.refined(mesh, on_cap)
    rates = np.log2(np.array(error[:-1]) / error[1:])
    print("errors", error, "rates", rates)
    assert rates.mean() >= 1.8


# --- invariance ---------------------------------------------------------------------------------------------

MASK = samples.mask(1500, seed=3)
GRID = 2.0**-24  # the mask is 0.2 high: coordinates on this grid lose 1e-7 of it, the same for all the tests below
MASK = (np.round(MASK[0] / GRID) * GRID, MASK[1])
CENTER = int(np.argmin(np.linalg.norm(MASK[0][:, :2] - [0.01, 0.02], axis=1)))


def placed(V: NDArray, F: NDArray, method: str, center: int, boundary_vertex: int) -> NDArray:
    """The map under a normalisation that names vertices.

    Rounding of the positions (eps of their size, over the shortest edge, some 1e-13) and of the solves (eps times
    a condition number of some 1e4) stay below 1e-11. Newton's angles are exact to tolerance over the smallest
    eigenvalue of the Hessian, about 2 pi / nb = 0.05: 1e-12 / 0.05. That makes 1e-9 a bound with room.
    """
    m = cuv.disk_map(V, F, method=method, center=center, boundary_vertex=boundary_vertex, tolerance=1e-12)
    assert m.gradient_norm is None or m.gradient_norm <= 1e-11
    return m.uv


@pytest.fixture(scope="module", params=["linear", "newton"])
def reference(request) -> tuple[str, int, NDArray]:
    rim = int(meshes.slow_loops(MASK[1])[0][7])
    return request.param, rim, placed(*MASK, request.param, CENTER, rim)


def test_rotation_changes_nothing(reference) -> None:
    method, rim, uv = reference
    Q, _ = np.linalg.qr(np.random.default_rng(16).normal(size=(3, 3)))
    Q *= np.sign(np.linalg.det(Q))
    np.testing.assert_allclose(placed(MASK[0] @ Q.T, MASK[1], method, CENTER, rim), uv, rtol=0, atol=1e-9)


def test_translation_changes_nothing(reference) -> None:
    """By a power of two that keeps the coordinates exact on their grid: all differences stay as they are."""
    method, rim, uv = reference
    shift = np.array([2.0**20, -(2.0**24), 2.0**27])  # 2^27 and GRID are 51 bits apart
    V = MASK[0] + shift
    np.testing.assert_array_equal(V - shift, MASK[0])
    np.testing.assert_allclose(placed(V, MASK[1], method, CENTER, rim), uv, rtol=0, atol=1e-9)


@pytest.mark.parametrize("unit", [1e-6, 1e6, 1e-150, 1e150])
def test_scale_changes_nothing(reference, unit: float) -> None:
    method, rim, uv = reference
    np.testing.assert_allclose(placed(unit * MASK[0], MASK[1], method, CENTER, rim), uv, rtol=0, atol=1e-9)


def test_relabelling_changes_nothing(reference) -> None:
    method, rim, uv = reference
    rng = np.random.default_rng(17)
    name = rng.permutation(len(MASK[0]))
    V = np.empty_like(MASK[0])
    V[name] = MASK[0]
    F = name[MASK[1]][rng.permutation(len(MASK[1]))]
    F = np.take_along_axis(F, (rng.integers(3, size=len(F))[:, None] + np.arange(3)) % 3, axis=1)
    got = placed(V, F, method, int(name[CENTER]), int(name[rim]))
    np.testing.assert_allclose(got[name], uv, rtol=0, atol=1e-9)


def test_reversed_faces_mirror_the_map(reference) -> None:
    """The surface seen from below: the complex conjugate, with the same vertices at 0 and 1."""
    method, rim, uv = reference
    got = placed(MASK[0], MASK[1][:, ::-1], method, CENTER, rim)
    np.testing.assert_allclose(got, uv * [1.0, -1.0], rtol=0, atol=1e-9)


# --- placing and asking again -------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_center_and_boundary_vertex_are_met_exactly(method: str) -> None:
    for center, boundary_vertex in ((CENTER, None), (None, 5), (CENTER, 11)):
        boundary_vertex = None if boundary_vertex is None else int(meshes.slow_loops(MASK[1])[0][boundary_vertex])
        m = cuv.disk_map(*MASK, method=method, center=center, boundary_vertex=boundary_vertex)
        assert m.center == (center if center is not None else m.center)
        if m.center is not None:
            assert m.uv[m.center].tolist() == [0.0, 0.0]
        first = m.boundary[0] if boundary_vertex is None else boundary_vertex
        assert m.uv[first].tolist() == [1.0, 0.0]
        assert_is_a_disk_embedding(m, MASK[1])


@pytest.mark.parametrize(
    ("method", "pin_mode"), [("linear", None), ("newton", "moebius"), ("newton", "constraint"), (METHODS[2], None)]
)
def test_pins_lie_at_the_cube_roots(method: str, pin_mode: str | None) -> None:
    mesh = generated("mask", method)
    loop = meshes.slow_loops(mesh[1])[0]
    pins = [loop[k * len(loop) // 12] for k in (0, 5, 9)]
    m = cuv.disk_map(*mesh, method=method, pin_mode=pin_mode, pins=pins)
    assert m.pins == tuple(pins) and m.center is None
    exact = 1e-8 if method == "augmented-lagrangian" else 1e-15  # which stops at |c| < 1e-8
    np.testing.assert_allclose(as_complex(m)[pins], CUBE_ROOTS, rtol=0, atol=exact)
    assert_is_a_disk_embedding(m, mesh[1])


def test_moebius_placement_is_a_moebius_map_of_the_solution() -> None:
    """Three boundary vertices fix it; all others must follow."""
    one = cuv.disk_map(*MASK)
    loop = one.boundary
    two = cuv.disk_map(*MASK, pins=loop[[4, 50, 90]])
    three = loop[[10, 60, 110]]
    z, w = as_complex(one), as_complex(two)
    np.testing.assert_allclose(cuv.Moebius.from_three_pairs(z[three], w[three])(z), w, rtol=0, atol=1e-12)
    assert np.abs(z - w).max() > 0.1


def test_center_where_a_moebius_map_of_the_vertices_folds() -> None:
    """Then the moved boundary is extended harmonically, and moved on until the centre is where it belongs.

    On this flat Delaunay mesh of scattered points that is an embedding (Tutte), every interior vertex at the weighted
    mean of its neighbours, the centre among them. Centres are taken that see no boundary vertex under more than a
    third of the harmonic measure (with half of it, no map of the disk brings them to 0).
    """
    V, F = meshes.scattered_disk(30, 16, seed=4)
    mapper = cuv.DiskMapper(V, F, laplacian="cotan")
    base, loop = as_complex(mapper.map(method="newton")), mapper.boundary
    L = cuv.cotangent_laplacian(V, F).toarray()
    inside = np.setdiff1d(np.arange(len(V)), loop)
    measure = -np.linalg.solve(L[np.ix_(inside, inside)], L[np.ix_(inside, loop)])
    extended = []
    for center in inside[measure.max(axis=1) < 1 / 3]:
        m = mapper.map(method="newton", center=int(center), repair="never")
        assert_is_a_disk_embedding(m, F)
        assert m.uv[center].tolist() == [0.0, 0.0]
        z = cuv.Moebius.to_zero(base[center], base[loop[0]])(base)
        extended.append(bool(signed_areas(np.column_stack((z.real, z.imag)), F).min() <= 0.0))
        if extended[-1]:
            assert np.abs((L @ as_complex(m))[inside]).max() < 1e-12
        else:
            np.testing.assert_allclose(as_complex(m), z, rtol=0, atol=1e-12)
    assert any(extended) and not all(extended)


def test_default_pins_are_a_third_of_the_loop_apart() -> None:
    """design.md 3.3: loop positions 0, nb // 3 and 2 (nb // 3); with 14 the last is 8, not 2 nb // 3 = 9."""
    mesh = meshes.plate(4, 3)
    m = cuv.disk_map(*mesh, method="augmented-lagrangian")
    loop = meshes.slow_loops(mesh[1])[0]
    nb = len(loop)
    assert nb == 14
    assert m.pins == (loop[0], loop[nb // 3], loop[2 * (nb // 3)])


ASKED_AGAIN = [
    {"method": "newton"},
    {"method": "newton", "center": CENTER},
    {"method": "newton", "boundary_vertex": meshes.slow_loops(MASK[1])[0][31]},
    {"method": "newton", "pins": meshes.slow_loops(MASK[1])[0][9:100:40]},
    {"method": "linear"},
    {"method": "linear", "center": CENTER},
    {"objective": "dirichlet"},
    {"pin_mode": "constraint", "pins": meshes.slow_loops(MASK[1])[0][9:100:40]},
    {"pin_mode": "constraint", "pins": meshes.slow_loops(MASK[1])[0][5:120:50]},  # neighbours differ in one thing
    {"objective": "dirichlet", "pin_mode": "constraint", "pins": meshes.slow_loops(MASK[1])[0][5:120:50]},
    {"method": "newton", "max_iterations": 1},
    {"method": "newton", "boundary_vertex": meshes.slow_loops(MASK[1])[0][60]},
    {"method": "newton", "boundary_vertex": meshes.slow_loops(MASK[1])[0][60], "tolerance": 1e-3},
    {"method": "augmented-lagrangian", "max_iterations": 2},
    {},  # linear or Newton's once more
]


def test_mapper_asked_again_gives_the_one_shot_map(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same steps on the same factorization, so the same numbers; and one factorization for all of them.

    The augmented Lagrangian makes one more, of the graph Laplacian, for Tutte's embedding.
    """
    expected = [cuv.disk_map(*MASK, laplacian="cotan", **options) for options in ASKED_AGAIN]
    made = []
    original = dirichlet.linear_solver

    def counting(*args, **kwargs):
        made.append(args[0].n)
        return original(*args, **kwargs)

    monkeypatch.setattr(dirichlet, "linear_solver", counting)
    mapper = cuv.DiskMapper(*MASK, laplacian="cotan")
    for options, one_shot in zip(ASKED_AGAIN, expected, strict=True):
        again = mapper.map(**options)
        np.testing.assert_allclose(again.uv, one_shot.uv, rtol=0, atol=1e-13, err_msg=str(options))
        assert (again.center, again.pins, again.converged) == (one_shot.center, one_shot.pins, one_shot.converged)
        assert len(made) == 1 + (again.method == "augmented-lagrangian")
        del made[1:]
    distinct = [m.uv for m in expected[:-1]]
    assert min(np.abs(a - b).max() for a, b in itertools.combinations(distinct, 2)) > 1e-9


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_another_place_takes_no_other_solution(method: str) -> None:
    """Told by the stages that run: another tolerance solves again, without a factorization."""
    mapper = cuv.DiskMapper(*MASK)
    mapper.map(method=method)
    for options in ({"center": CENTER}, {"boundary_vertex": int(mapper.boundary[5])}, {"pins": mapper.boundary[:9:4]}):
        stages: set[str] = set()
        mapper.map(method=method, callback=lambda stage, _, stages=stages: stages.add(stage), **options)
        assert "placement" in stages and stages <= {"placement", "repair"}
    stages = set()
    mapper.map(tolerance=1e-6, callback=lambda stage, _: stages.add(stage))
    assert "newton" in stages and stages <= {"linear", "newton", "placement", "repair"}


def test_mapper_knows_its_boundary_and_backend() -> None:
    mapper = cuv.DiskMapper(*MASK, backend="superlu")
    assert mapper.backend == mapper.map(method="linear").backend == "superlu"
    np.testing.assert_array_equal(mapper.boundary, mapper.map().boundary)


# --- options ------------------------------------------------------------------------------------------------

PLATE = meshes.plate(3, 3)  # loop 0 1 2 3 7 11 15 14 13 12 8 4; interior 5 6 9 10


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "spectral"}, "method is 'spectral'; choose linear or newton or augmented-lagrangian"),
        ({"objective": "area"}, "objective is 'area'; choose conformal or dirichlet"),
        ({"pin_mode": "soft"}, "pin_mode is 'soft'; choose moebius or constraint"),
        ({"repair": "sometimes"}, "repair is 'sometimes'; choose auto, always, never"),
        ({"laplacian": "graph"}, "laplacian is 'graph'; choose auto, cotan, intrinsic-delaunay"),
        ({"method": "augmented-lagrangian", "pin_mode": "moebius"}, "takes its pins as constraints"),
        ({"method": "linear", "pin_mode": "constraint"}, "linear method does not optimise"),
        ({"tolerance": 0.0}, "tolerance must be positive"),
        ({"tolerance": -1e-9}, "tolerance must be positive"),
        ({"tolerance": np.nan}, "tolerance must be positive"),
        ({"relative_tolerance": 1.0}, "relative_tolerance must be at least 0 and less than 1"),
        ({"relative_tolerance": -0.1}, "relative_tolerance must be at least 0 and less than 1"),
        ({"relative_tolerance": "small"}, "relative_tolerance 'small'.*pass numbers"),
        ({"max_iterations": -1}, "max_iterations not negative"),
        ({"pins": [0, 3, 15], "center": 5}, "Three pins already fix the map"),
        ({"pins": [0, 3, 15], "boundary_vertex": 0}, "Three pins already fix the map"),
        ({"pin_mode": "constraint", "center": 5}, "Three pins already fix the map"),
        ({"method": "augmented-lagrangian", "boundary_vertex": 0}, "Three pins already fix the map"),
        ({"pins": [0, 3]}, "2 pins; pass three"),
        ({"pins": [0, 3, 15, 12]}, "4 pins; pass three"),
        ({"pins": [0, 3, 10]}, r"Pins \[10\] are not on the boundary"),
        ({"pins": [0, 3, 3]}, "Pins 0, 3, 3 are not three different"),
        ({"pins": [0, 15, 3]}, "against the boundary's direction.*pass 0, 3, 15"),
        ({"pins": [0, 3, 16]}, "pins is vertex 16"),
        ({"pins": [0, -1, 3]}, "pins is vertex -1"),
        ({"pins": [0, 1.5, 3]}, "pins is 1.5; pass a vertex index"),
        ({"center": 3}, "center 3 lies on the boundary"),
        ({"center": 16}, r"center is vertex 16; the mesh has vertices 0 \.\. 15"),
        ({"center": -1}, "center is vertex -1"),
        ({"center": 5.0}, "center is 5.0; pass a vertex index"),
        ({"center": "5"}, "center is '5'; pass a vertex index"),
        ({"boundary_vertex": 5}, "boundary_vertex 5 is not on the boundary"),
        ({"boundary_vertex": 16}, "boundary_vertex is vertex 16"),
        ({"boundary_vertex": 1.0}, "boundary_vertex is 1.0; pass a vertex index"),
    ],
    ids=str,
)
def test_options_that_do_not_fit_are_refused(options: dict, message: str) -> None:
    with pytest.raises(cuv.OptionError, match=message) as caught:
        cuv.disk_map(*PLATE, **options)
    assert isinstance(caught.value, ValueError)


def test_options_may_be_numpy_integers() -> None:
    one = cuv.disk_map(*PLATE, center=np.int32(9), boundary_vertex=np.uint8(15))
    np.testing.assert_array_equal(one.uv, cuv.disk_map(*PLATE, center=9, boundary_vertex=15).uv)
    for pins in ([0, 3, 15], [3, 15, 0], [15, 0, 3]):  # any rotation of the loop's order
        pinned = cuv.disk_map(*PLATE, pins=np.array(pins))
        np.testing.assert_allclose(as_complex(pinned)[pins], CUBE_ROOTS, rtol=0, atol=1e-15)


# --- progress and cancelling --------------------------------------------------------------------------------

STAGES = {
    "linear": ["checks", "assembly", "ordering", "factorization", "linear", "placement"],
    "newton": ["checks", "assembly", "ordering", "factorization", "linear", "newton", "placement"],
    "augmented-lagrangian": ["checks", "augmented lagrangian", "placement"],
}


@pytest.mark.parametrize("method", METHODS)
def test_progress_goes_through_the_stages_in_order(method: str) -> None:
    calls: list[tuple[str, float]] = []
    mesh = generated("mask", method)
    cuv.disk_map(*mesh, method=method, callback=lambda stage, fraction: calls.append((stage, fraction)))
    assert [stage for stage, _ in itertools.groupby(calls, key=lambda call: call[0])] == STAGES[method]
    assert all(0.0 <= fraction <= 1.0 for _, fraction in calls)
    assert calls[0] == ("checks", 0.0) and calls[-1] == ("placement", 1.0)


@pytest.mark.parametrize("method", METHODS)
def test_any_call_of_the_callback_can_cancel(method: str) -> None:
    """For every k, False at the k-th call ends the work there, and the mapper still maps afterwards."""
    stages: list[str] = []
    mesh = generated("mask", method)
    expected = cuv.disk_map(*mesh, method=method, callback=lambda stage, _: stages.append(stage))
    assert len(stages) > len(STAGES[method])
    for k, stage in enumerate(stages):
        seen: list[str] = []

        def stop(stage: str, _: float, seen=seen, k=k) -> bool:
            seen.append(stage)
            return len(seen) <= k

        with pytest.raises(cuv.CancelledError, match=f"Cancelled during {stage}"):
            cuv.disk_map(*mesh, method=method, callback=stop)
        assert seen == stages[: k + 1]
    mapper = cuv.DiskMapper(*mesh)
    with pytest.raises(cuv.CancelledError):
        mapper.map(method=method, callback=lambda stage, fraction: (stage, fraction) != ("placement", 1.0))
    np.testing.assert_allclose(mapper.map(method=method).uv, expected.uv, rtol=0, atol=1e-13)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("answer", [None, True, 0, ""])
def test_only_false_cancels(method: str, answer: object) -> None:
    assert cuv.disk_map(*PLATE, method=method, callback=lambda stage, fraction: answer).converged


@pytest.mark.parametrize("method", METHODS)
def test_exceptions_of_the_callback_pass_through(method: str) -> None:
    for stage in STAGES[method]:

        def fail(now: str, _: float, stage=stage) -> None:
            if now == stage:
                raise ZeroDivisionError(stage)

        with pytest.raises(ZeroDivisionError, match=stage):
            cuv.disk_map(*PLATE, method=method, callback=fail)


# --- Newton's method ----------------------------------------------------------------------------------------

DESCENTS = {
    "mask": (MASK, {}),
    "dirichlet": (MASK, {"objective": "dirichlet"}),
    "flat disk": (GENERATED["flat disk"], {}),
    "far start": (meshes.fan(7), {}),
    "long way": (meshes.plate(4, 3), {}),
    "a full step too long": (  # a step here must be halved or the energy rises from 3.5 to 3.9
        (lambda V, F: (V * [1.0, 1.0, 8.0], F))(*samples.terrain(400)),
        {"pin_mode": "constraint", "objective": "dirichlet", "pins": [0, 399, 20]},
    ),
    "bad pins": (MASK, {"pin_mode": "constraint", "pins": meshes.slow_loops(MASK[1])[0][:9:4]}),
}


@pytest.mark.parametrize("name", DESCENTS)
def test_newton_never_raises_the_energy(name: str) -> None:
    """Down to the resolution of a sum of size pi in doubles."""
    mesh, options = DESCENTS[name]
    m = cuv.disk_map(*mesh, method="newton", **options)
    energy = np.array([row.energy for row in m.history])
    assert len(energy) > 2
    assert np.diff(energy).max() <= 64 * EPS * (np.pi + abs(energy[0]))
    assert energy[-1] < energy[0]
    assert all(isinstance(row, NewtonStep) and 0.0 <= row.step_length <= 1.0 for row in m.history)
    assert m.history[-1].step_length == 0 and m.history[-1].cg_steps == 0
    assert m.gradient_norm == m.history[-1].gradient_norm
    assert m.converged and m.gradient_norm <= 1e-10


@pytest.mark.parametrize("most", [0, 1])
def test_stopped_newton_says_so(most: int, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING, logger="conformal_uv"):
        m = cuv.disk_map(*MASK, method="newton", max_iterations=most)
    assert not m.converged and m.status == "max-iterations"
    assert len(m.history) == most + 1
    assert m.gradient_norm > 1e-10
    assert "newton stopped before its tolerance" in caplog.text
    assert_is_a_disk_embedding(m, MASK[1])


@pytest.mark.parametrize("part", [1e-2, 1e-6])
def test_relative_tolerance_ends_newton_early(part: float) -> None:
    """As soon as the gradient is at that part of where it began, and not before."""
    m = cuv.disk_map(*MASK, relative_tolerance=part)
    norms = [step.gradient_norm for step in m.history]
    assert m.converged and norms[-1] <= part * norms[0] < norms[-2]
    assert norms[-1] > 1e-10  # where it would have ended by itself
    assert m.history == cuv.disk_map(*MASK, tolerance=part * norms[0]).history


def test_converged_newton_is_silent(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        assert cuv.disk_map(*MASK).converged
    assert caplog.text == ""


@pytest.mark.skipif(importlib.util.find_spec("cvxopt") is None, reason="the CHOLMOD backend needs cvxopt")
@pytest.mark.parametrize("method", ["linear", "newton"])
@pytest.mark.parametrize("name", GENERATED)
def test_backends_give_one_map(name: str, method: str) -> None:
    """Two factorizations of one matrix; the bound is derived at `placed`."""
    cholmod, superlu = (
        cuv.disk_map(*GENERATED[name], method=method, tolerance=1e-12, backend=backend)
        for backend in ("cholmod", "superlu")
    )
    assert (cholmod.backend, superlu.backend) == ("cholmod", "superlu")
    np.testing.assert_allclose(cholmod.uv, superlu.uv, rtol=0, atol=1e-9)


@pytest.mark.parametrize("minus_area", [True, False])
def test_derivatives_of_the_boundary_energy(minus_area: bool) -> None:
    """Against central differences, at angles far from the minimum; and the value against the explicit matrix."""
    V, F = samples.spherical_cap(150, 100.0, seed=18)
    surface = Surface.from_arrays(V, F)
    b = surface.require_disk()
    problem = DirichletProblem(cotan_edges(surface.edges, surface.geometry), b, len(V), backend="superlu")
    rng = np.random.default_rng(19)
    theta = 2 * np.pi * (np.arange(len(b)) + rng.uniform(-0.4, 0.4, len(b))) / len(b)

    def at(angles: NDArray) -> BoundaryEnergy:
        return BoundaryEnergy(problem, angles, minus_area=minus_area)

    energy = at(theta)
    z = problem.extend(np.exp(1j * theta))
    uv = np.column_stack((z.real, z.imag))
    value = 0.5 * float(np.sum(uv * (cuv.cotangent_laplacian(V, F) @ uv)))
    assert energy.value == pytest.approx(value - (shoelace(uv[b]) if minus_area else 0.0), abs=1e-12)
    h = 1e-5
    steps = h * np.eye(len(b))
    # Truncation h^2 / 6 of third derivatives of size 10, rounding eps / h of values of size 10: below 1e-9.
    slope = [(at(theta + step).value - at(theta - step).value) / (2 * h) for step in steps]
    np.testing.assert_allclose(energy.gradient, slope, rtol=0, atol=1e-9)
    assert np.abs(energy.gradient).max() > 0.01
    difference = np.array([(at(theta + step).gradient - at(theta - step).gradient) / (2 * h) for step in steps])
    hessian = np.array([energy.hessian_product(unit) for unit in np.eye(len(b))])
    np.testing.assert_allclose(hessian, difference, rtol=0, atol=1e-9)
    np.testing.assert_allclose(hessian, hessian.T, rtol=0, atol=1e-13)
    np.testing.assert_allclose(hessian @ np.ones(len(b)), 0.0, rtol=0, atol=1e-12)  # a rotation costs nothing
    np.testing.assert_allclose(energy.moebius_products(), hessian @ energy.moebius_moves, rtol=0, atol=1e-12)


# --- what is loaded -----------------------------------------------------------------------------------------


def test_the_solver_loads_none_of_the_optional_libraries() -> None:
    """In a fresh interpreter: import, map, and list what came along."""
    program = (
        "import sys\n"
        "import conformal_uv as cuv\n"
        "V = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [.5, .5, .3]]\n"
        "F = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]\n"
        "for method in ('linear', 'newton', 'augmented-lagrangian'):\n"
        "    assert cuv.disk_map(V, F, method=method).distortion.angle_max > 0\n"
        "print(' '.join(sys.modules))\n"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert run.returncode == 0, run.stderr
    loaded = {name.split(".")[0] for name in run.stdout.split()}
    assert {"conformal_uv", "numpy", "scipy"} <= loaded
    assert not loaded & {"bpy", "pymeshlab", "matplotlib", "trimesh", "typer", "rich"}
    assert run.stdout.count("\n") == 1 and run.stderr == ""  # and it prints nothing

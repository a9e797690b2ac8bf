"""Many islands at once: the maps are those of each island by itself, and one island's trouble is its own."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from meshes import annulus, fan, moebius_band, plate, scattered_disk, strip, wheel

import conformal_uv as cuv
from conformal_uv.atlas import FactorizedDisks, sound_disks
from conformal_uv.charts import chart_atlas
from conformal_uv.operators.dirichlet import DirichletProblem

EQUAL = 1e-10  # between an island's map and that of a mesh of its own


def bumpy(mesh, seed, noise=0.1):
    V, F = mesh
    rng = np.random.default_rng(seed)
    V = np.column_stack((V, np.zeros((len(V), 3 - V.shape[1])))) if V.shape[1] < 3 else V
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    moved = (V + rng.normal(scale=noise, size=V.shape)) @ (turn * np.sign(np.linalg.det(turn))).T
    return moved * 10.0 ** rng.uniform(-3.0, 3.0) + rng.normal(size=3), F


def side_by_side(meshes):
    first = np.cumsum([0, *(len(V) for V, _ in meshes[:-1])])
    faces = [F + k for (_, F), k in zip(meshes, first, strict=True)]
    return np.concatenate([V for V, _ in meshes]), np.concatenate(faces)


FAMILIES = {
    "triangles": lambda k: fan(1),
    "quads": lambda k: strip(1),
    "strips": lambda k: strip(2 + k % 5),
    "fans": lambda k: fan(2 + k % 4),
    "plates": lambda k: plate(1 + k % 4, 2 + k % 3),
    "squares": lambda k: plate(4, 4),
    "wheels": lambda k: wheel(3 + k % 6),
    "few": lambda k: scattered_disk(12 + k % 3, 8 + k % 5, k),  # all boundary angles chosen for the least shear
    "scattered": lambda k: scattered_disk(12, 17 + k % 4, k),  # a third of them with negative weights
}


@pytest.mark.parametrize("method", ["linear", "newton", "auto"])
@pytest.mark.parametrize("family", FAMILIES)
def test_an_island_is_mapped_as_if_it_were_alone(family, method):
    meshes = [bumpy(FAMILIES[family](k), k) for k in range(24)]
    u = cuv.unwrap(*side_by_side(meshes), method=method, upright="none")
    assert len(u.charts) == 24
    alone = u.charts.solutions.alone
    assert len(alone) <= 6, "what is compared was not mapped together"
    if (family, method) == ("few", "auto"):
        assert sum(u.charts[k].map.objective == "relative" for k in range(24) if k not in alone) >= 12
    for chart, (V, F) in zip(u.charts, meshes, strict=True):
        single = cuv.disk_map(V, F, method=method)
        assert np.abs(chart.map.uv - single.uv).max() <= EQUAL
        for name in ("method", "status", "objective", "laplacian"):
            assert getattr(chart.map, name) == getattr(single, name)
        assert chart.map.converged and np.array_equal(chart.map.flipped, single.flipped)
        assert chart.map.conformal_energy == pytest.approx(single.conformal_energy, rel=1e-9, abs=1e-12)
        assert chart.map.dirichlet_energy == pytest.approx(single.dirichlet_energy, rel=1e-9)
        assert np.array_equal(chart.map.boundary, single.boundary)
        assert chart.map.distortion.angle_mean == pytest.approx(single.distortion.angle_mean, abs=1e-6)
        assert len(chart.map.history) == 0 or chart.map.gradient_norm <= 1e-10
        if single.objective == "conformal":  # exact directions of the same Hessian need no more steps than inexact ones
            assert len(chart.map.history) <= len(single.history) + 1


@pytest.mark.parametrize("laplacian", ["auto", "cotan", "intrinsic-delaunay"])
@pytest.mark.parametrize("family", FAMILIES)
def test_an_island_is_flattened_as_if_it_were_alone(family, laplacian):
    meshes = [bumpy(FAMILIES[family](k), k) for k in range(24)]
    u = cuv.unwrap(*side_by_side(meshes), shape="free", laplacian=laplacian)
    alone = u.charts.solutions.alone
    assert len(alone) <= 8, "what is compared was not mapped together"
    for number, (chart, (V, F)) in enumerate(zip(u.charts, meshes, strict=True)):
        single = cuv.free_map(V, F, laplacian=laplacian)
        size = np.abs(single.uv).max()
        assert np.abs(chart.map.uv - single.uv).max() <= EQUAL * size
        for name in ("status", "laplacian", "backend", "converged"):
            assert getattr(chart.map, name) == getattr(single, name)
        for name in ("boundary", "flipped", "crossings"):
            assert np.array_equal(getattr(chart.map, name), getattr(single, name))
        if number not in alone:
            assert chart.map.repair is None and single.repair is None and len(single.crossings) == 0
        conformal, dirichlet = u.charts.solutions.energies()
        assert conformal[number] == pytest.approx(single.conformal_energy, rel=1e-9, abs=1e-12 * size**2)
        assert dirichlet[number] == pytest.approx(single.dirichlet_energy, rel=1e-9)


@pytest.mark.parametrize(
    "options", [{}, {"upright": "y", "rotation": 0.3}, {"upright": "none"}, {"holes": "fill"}], ids=str
)
def test_flat_islands_are_framed_and_placed_as_one_by_one(options, monkeypatch):
    """Some lie flat and are laid along their sides, some are upright; a hole is filled, its middle in no frame."""
    flat = [bumpy((V * [1.0, 1.0, 0.0], F), k, noise=0.0) for k, (V, F) in enumerate([plate(3, 2), plate(2, 4)])]
    lying = [(V @ np.diag([1.0, 1.0, 0.0]), F) for V, F in [plate(4, 2), plate(5, 3), strip(3)]]
    bent = [bumpy(scattered_disk(9, 12, k), k) for k in range(12)]
    pierced = [bumpy(plate(5, 5, ((1, 1, 3, 3),)), k) for k in range(3)] if "holes" in options else []
    V, F = side_by_side([*flat, *lying, *bent, *pierced])
    together = cuv.unwrap(V, F, shape="free", **options)
    monkeypatch.setattr(chart_atlas, "FEWEST", 1000)
    one_by_one = cuv.unwrap(V, F, shape="free", **options)
    assert len(one_by_one.charts.solutions.alone) == len(one_by_one.charts) > 2 * len(together.charts.solutions.alone)
    assert np.abs(together.uv - one_by_one.uv).max() <= EQUAL
    meshes = together.charts.meshes
    for first, end in zip(meshes.first_vertex[:-1], meshes.first_virtual, strict=True):
        own = slice(first, end)
        assert np.abs(together.charts.solutions.z[own] - one_by_one.charts.solutions.z[own]).max() <= EQUAL
    assert together.charts.notes(np.arange(len(together.charts))) == one_by_one.charts.notes(
        np.arange(len(one_by_one.charts))
    )
    assert len(together.charts.shaped) == len(one_by_one.charts.shaped) == len(together.charts)


def test_flat_islands_that_cross_themselves_or_fold_are_left_to_themselves():
    """A long spiral of triangles runs over itself; it is told as for one."""
    t = np.linspace(0.0, 2.5 * np.pi, 60)
    inner, outer = (np.column_stack((r * np.cos(t), r * np.sin(t), h * t)) for r, h in ((1.0, 0.02), (1.3, 0.02)))
    V = np.concatenate((inner, outer))
    k = np.arange(59)
    F = np.concatenate((np.column_stack((k, 60 + k, k + 1)), np.column_stack((k + 1, 60 + k, 61 + k))))
    meshes = [bumpy(plate(2, 2), seed) for seed in range(9)] + [(V, F)]
    u = cuv.unwrap(*side_by_side(meshes), shape="free")
    assert 9 in u.charts.solutions.alone and len(u.charts[9].map.crossings) > 0
    assert any("crosses itself" in note for note in u.charts[9].notes)
    assert len(u.charts.solutions.alone) == 1


def test_islands_of_two_shapes_are_mapped_together_each():
    meshes = [bumpy(plate(2, 2), k) for k in range(20)]
    shapes = ["disk", "free"] * 10
    u = cuv.unwrap(*side_by_side(meshes), shape=shapes)
    assert not u.charts.solutions.alone
    assert [type(chart.map).__name__ for chart in u.charts] == ["DiskMap", "FreeMap"] * 10


def test_alike_vertices_are_chosen_by_the_surface_as_for_one_disk():
    """Flat plates: two vertices have the torsion function's peak."""
    plates = [plate(columns, rows) for columns in (3, 5, 7) for rows in (2, 3, 4)]
    meshes = [bumpy((V * [1.0, 1.0, 0.0], F), k, noise=0.0) for k, (V, F) in enumerate(plates)]
    meshes += [(V[::-1], len(V) - 1 - F) for V, F in meshes]  # neither the first nor the last of them
    u = cuv.unwrap(*side_by_side(meshes), method="linear", upright="none")
    assert not u.charts.solutions.alone
    for chart, (V, F) in zip(u.charts, meshes, strict=True):
        assert np.abs(chart.map.uv - cuv.disk_map(V, F, method="linear").uv).max() <= EQUAL


@pytest.mark.parametrize(
    "options",
    [
        {"rotation": 0.4, "upright": "y"},
        {"laplacian": "cotan"},
        {"laplacian": "intrinsic-delaunay"},
        {"backend": "superlu"},
        {"repair": "never"},
        {"max_iterations": 1, "method": "newton"},
        {"relative_tolerance": 1e-3},
        {"place": "disk"},
    ],
    ids=str,
)
def test_options_mean_the_same_for_islands_together_and_one_by_one(options, monkeypatch):
    V, F = side_by_side([bumpy(scattered_disk(6, 13, k), k) for k in range(16)])
    together = cuv.unwrap(V, F, **options)
    monkeypatch.setattr(chart_atlas, "FEWEST", 1000)
    one_by_one = cuv.unwrap(V, F, **options)
    assert (
        len(one_by_one.charts.solutions.alone) == 16 > len(together.charts.solutions.alone)
        or "max_iterations" in options
    )
    assert np.abs(together.uv - one_by_one.uv).max() <= (EQUAL if "relative_tolerance" not in options else 1e-4)
    for one, other in zip(together.charts, one_by_one.charts, strict=True):
        assert (one.map.status, one.map.converged) == (other.map.status, other.map.converged)


def test_the_numbers_of_all_islands_are_those_of_each_together(monkeypatch):
    V, F = side_by_side([bumpy(plate(2 + k % 3, 3), k) for k in range(12)])
    u = cuv.unwrap(V, F)
    numbers = cuv.unwrap_numbers(u)
    each = cuv.distortion_numbers([chart.distortion for chart in u.charts])
    assert numbers.distortion.angle_mean == pytest.approx(each.angle_mean, rel=1e-12)
    assert numbers.distortion.quasi_conformal_max == pytest.approx(each.quasi_conformal_max, rel=1e-9)
    assert numbers.conformal_energy == pytest.approx(sum(chart.map.conformal_energy for chart in u.charts))
    assert numbers.mapped_charts == numbers.converged_charts == 12 and numbers.triangles == len(F)
    # packed at their sizes on the surface, but for rounding one area of the texture to one of the surface
    scale = [
        chart.placement.scale**2
        * chart.map.distortion.area_scale
        @ cuv.face_areas(V, F)[chart.faces]
        / cuv.face_areas(V, F)[chart.faces].sum()
        for chart in u.charts
    ]
    assert scale == pytest.approx([scale[0]] * 12)


def test_one_islands_fault_leaves_the_others_alone():
    good = [bumpy(plate(3, 3), k) for k in range(10)]
    flat = np.zeros((3, 3)), np.array([[0, 1, 2]])
    line = np.column_stack((np.arange(3.0), np.arange(3.0), np.zeros(3))), np.array([[0, 1, 2]])
    nan = np.full((3, 3), np.nan), np.array([[0, 1, 2]])
    bad = [flat, line, nan, moebius_band(8), annulus(6)]
    u = cuv.unwrap(*side_by_side([*good[:5], *bad, *good[5:]]), upright="none")
    assert u.charts.mapped.tolist() == [True] * 5 + [False] * 4 + [True] * 6
    kinds = [type(chart.error).__name__ for chart in u.charts if chart.error is not None]
    assert kinds == ["DegenerateFaceError", "DegenerateFaceError", "NonFiniteError", "OrientationError"]
    for number, (V, F) in zip([*range(5), *range(10, 15)], good, strict=True):
        assert np.abs(u.charts[number].map.uv - cuv.disk_map(V, F).uv).max() <= EQUAL


def test_a_folded_island_is_mended_as_if_it_were_alone():
    """The linear map of the stretched disk folds some faces; the others need no repair."""
    V, F = scattered_disk(60, 20, 3)
    V = np.column_stack((V, np.zeros((len(V), 3 - V.shape[1]))))
    V[:, 0] *= 60.0
    single = cuv.disk_map(V, F, method="linear")
    assert single.repair is not None
    u = cuv.unwrap(*side_by_side([*(bumpy(plate(3, 3), k) for k in range(9)), (V, F)]), method="linear", upright="none")
    assert list(u.charts.solutions.alone) == [9]
    assert np.array_equal(u.charts[9].map.uv, single.uv)


def test_islands_in_several_batches_and_asked_again_are_the_same(monkeypatch):
    V, F = side_by_side([bumpy(plate(3, 3), k) for k in range(30)])
    whole = cuv.unwrap(V, F)
    monkeypatch.setattr(chart_atlas, "BATCH", 100)
    unwrapper = cuv.Unwrapper(V, F)
    first = unwrapper.unwrap()
    assert len(unwrapper._atlas._made[1]) > 3
    assert np.abs(first.uv - whole.uv).max() <= EQUAL
    made = []
    init = DirichletProblem.__init__
    monkeypatch.setattr(DirichletProblem, "__init__", lambda self, *a, **k: (made.append(1), init(self, *a, **k))[1])
    assert np.array_equal(unwrapper.unwrap().uv, first.uv)
    turned = unwrapper.unwrap(rotation=0.3)
    assert not made, "nothing is factorized again"
    z, before = (u.charts[4].map.uv @ [1.0, 1j] for u in (turned, first))
    assert z == pytest.approx(before * np.exp(0.3j))


def test_an_island_that_can_not_be_factorized_is_looked_for_by_halves(monkeypatch):
    meshes = [bumpy(plate(2, 2), k) for k in range(100)]
    whole = cuv.unwrap(*side_by_side(meshes))

    def refusing(disks, *rest):
        if 37 in disks.number:
            raise cuv.SolverError("a block is singular")
        return FactorizedDisks(disks, *rest)

    monkeypatch.setattr(chart_atlas, "FactorizedDisks", refusing)
    u = cuv.unwrap(*side_by_side(meshes))
    alone = sorted(u.charts.solutions.alone)
    assert 37 in alone and len(alone) < 2 * chart_atlas.FEWEST
    assert np.abs(u.uv - whole.uv).max() <= EQUAL


def test_named_vertices_take_their_island_out_of_the_batch():
    meshes = [bumpy(plate(4, 4), k) for k in range(10)]
    V, F = side_by_side(meshes)
    rim = int(np.setdiff1d(np.arange(25), [6, 7, 8, 11, 12, 13, 16, 17, 18])[3]) + 3 * 25
    u = cuv.unwrap(V, F, boundary_vertex=rim, upright="none")
    assert list(u.charts.solutions.alone) == [3]
    assert u.charts[3].map.uv[rim - 75] == pytest.approx([1.0, 0.0])
    assert np.abs(u.charts[2].map.uv - cuv.disk_map(*meshes[2]).uv).max() <= EQUAL


def test_progress_of_islands_never_falls_and_can_cancel(monkeypatch):
    monkeypatch.setattr(chart_atlas, "BATCH", 200)
    V, F = side_by_side([bumpy(plate(3, 3), k) for k in range(40)])
    told = []
    cuv.unwrap(V, F, callback=lambda stage, fraction: told.append((stage, fraction)))
    fractions = [fraction for _, fraction in told]
    assert fractions == sorted(fractions) and fractions[-1] == 1.0
    solved = sorted({fraction for stage, fraction in told if stage == "newton"})
    assert len(solved) >= 3 and solved[-1] > 0.8, "batches begin where those before have ended"
    with pytest.raises(cuv.CancelledError):
        cuv.unwrap(V, F, callback=lambda stage, fraction: stage != "newton")


def test_charts_are_made_when_they_are_looked_at():
    u = cuv.unwrap(*side_by_side([bumpy(strip(1), k) for k in range(20)]))
    assert not u.charts._made
    assert u.charts[-1].faces.tolist() == [38, 39] and u.charts[-1] is u.charts[19]
    assert [len(chart.F) for chart in u.charts[3:6]] == [2, 2, 2]
    with pytest.raises(IndexError):
        u.charts[20]
    surface = u.charts[7].map.surface
    again = cuv.Surface.from_arrays(u.charts[7].mesh.V, u.charts[7].F)
    assert np.array_equal(surface.edges.twin, again.edges.twin) and np.array_equal(surface.V, again.V)
    assert surface.unit == again.unit and np.array_equal(surface.geometry.dot, again.geometry.dot)


def test_a_centre_that_would_leave_its_cell_is_held_as_in_one_disk():
    """Of the ninth, the energy would fall by a tenth and more without holding the centre, beyond its neighbours."""
    meshes = [bumpy(FAMILIES["few"](k), k, noise=0.2) for k in range(302, 318)]
    u = cuv.unwrap(*side_by_side(meshes), method="newton", upright="none")
    assert 8 not in u.charts.solutions.alone
    for number in (7, 8):
        chart, single = u.charts[number], cuv.disk_map(*meshes[number], method="newton")
        assert np.abs(chart.map.uv - single.uv).max() <= EQUAL
        assert chart.map.history[-1].energy == pytest.approx(single.history[-1].energy, rel=1e-9)


@pytest.mark.parametrize("fault", ["wound the other way", "unused vertex", "two pieces", "edge of three faces", "flat"])
def test_meshes_that_are_no_disks_are_left_out_of_the_batch(fault):
    meshes = [bumpy(plate(2, 2), k) for k in range(5)]
    V, F = meshes[2]
    if fault == "wound the other way":
        V, F = bumpy(plate(4, 4), 2)
        inside = np.setdiff1d(np.arange(25), cuv.Surface.from_arrays(V, F).require_disk())
        turned = np.flatnonzero(np.isin(F, inside).all(axis=1))[0]  # its edges all have two faces as before
        F[turned] = F[turned, ::-1].copy()
    elif fault == "unused vertex":
        V = np.vstack((V, V[:1]))
    elif fault == "two pieces":
        V, F = np.vstack((V, V + 5.0)), np.vstack((F, F + len(V)))
    elif fault == "edge of three faces":
        V, F = np.vstack((V, V.mean(axis=0) + 1.0)), np.vstack((F, [[*F[0, :2], len(V)]]))
    else:
        V = V * [1.0, 1.0, 0.0]
        V[F[0]] = V[F[0, 0]] + np.outer([0.0, 0.5, 1.0], V[F[0, 1]] - V[F[0, 0]])
    meshes[2] = V, F
    first = [np.cumsum([0, *(len(mesh[part]) for mesh in meshes)]) for part in (0, 1)]
    disks = sound_disks(
        np.concatenate([V for V, _ in meshes]), np.concatenate([F for _, F in meshes]), *first, np.arange(5), 96
    )
    assert disks.number.tolist() == [0, 1, 3, 4]
    assert np.array_equal(disks.loop[: disks.first_boundary[1]], cuv.Surface.from_arrays(*meshes[0]).require_disk())


def test_results_go_from_process_to_process():
    u = cuv.unwrap(*side_by_side([bumpy(plate(3, 3), k) for k in range(12)]))
    again = pickle.loads(pickle.dumps(u))
    assert np.array_equal(again.uv, u.uv) and again.summary == u.summary
    assert again.charts[5].map.history == u.charts[5].map.history
    assert np.array_equal(again.charts[5].distortion.angle_error, u.charts[5].distortion.angle_error)

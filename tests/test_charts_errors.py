"""unwrap: one chart's failure, told in the caller's numbers, and arguments that are refused."""

from __future__ import annotations

import numpy as np
import pytest
from polygon_shapes import CUBE, CUBE_V, grid, side_by_side

from conformal_uv import (
    DegenerateFaceError,
    MeshError,
    NonFiniteError,
    OptionError,
    SolverError,
    TopologyError,
)
from conformal_uv.charts import unwrap


def test_one_failure_among_twelve_and_the_exact_summary():
    V, Q = side_by_side(12)
    V[12 * 7 + 5, 1] = np.nan
    u = unwrap(V, Q)
    assert u.summary == (
        "mapped 11 of 12 charts; chart 7 (faces 42, 43, 44, 45, 46, 47): 1 vertices have a NaN or infinite "
        "coordinate: vertices 89. Give them positions, or leave out their faces."
    )
    chart = u.charts[7]
    assert (chart.status, type(chart.error), chart.error.indices) == ("failed", NonFiniteError, (89,))
    assert chart.map is None and chart.distortion is None
    assert np.flatnonzero(~u.mapped).tolist() == list(range(42, 48))
    assert np.isfinite(u.uv).all() and not u.uv[42 * 4 : 48 * 4].any()
    assert u.uv[: 42 * 4].any(axis=1).all()


def test_vertices_in_no_selected_face_do_not_matter():
    V, Q = side_by_side(2)
    W = np.concatenate((V, [[np.nan, 0, 0], [np.inf, 1, 1]]))
    assert np.array_equal(unwrap(W, Q).uv, unwrap(V, Q).uv)


def test_errors_speak_of_the_callers_faces_and_vertices():
    V, Q = side_by_side(2)
    order = np.array([3, 9, 0, 7, 5, 11, 1, 8, 2, 6, 10, 4])  # both grids' faces interleaved
    V = np.concatenate((np.zeros((100, 3)), V))
    Q = Q[order] + 100
    wrong = Q.copy()
    wrong[4, 1] = wrong[4, 0]
    u = unwrap(V, wrong)
    assert [type(c.error) for c in u.charts] == [DegenerateFaceError, type(None)]
    assert u.charts[0].error.indices == (4,) and "faces 4." in str(u.charts[0].error)
    flat = V.copy()
    flat[Q[5]] = flat[Q[5][0]]
    u = unwrap(flat, Q, laplacian="cotan", selection=np.arange(1, 12))
    error = u.charts[0].error
    assert type(error) is DegenerateFaceError and u.charts[1].status == "mapped"
    assert 5 in error.indices and set(error.indices) <= set(np.flatnonzero(order > 5).tolist())
    assert ", ".join(map(str, error.indices)) in str(error)


def test_faces_without_area_are_mapped_by_default():
    V, Q = grid(3, 3)
    V[5] = V[6]
    u = unwrap(V, Q)
    assert u.mapped.all() and np.isfinite(u.uv).all()


def test_solver_errors_belong_to_their_chart(monkeypatch):
    from conformal_uv.operators import dirichlet

    def failing(matrix, *rest, _real=dirichlet.linear_solver):
        if matrix.n > 2:
            raise SolverError("singular")
        return _real(matrix, *rest)

    monkeypatch.setattr(dirichlet, "linear_solver", failing)
    V, Q = side_by_side(1)
    W, R = grid(4, 4)
    u = unwrap(np.concatenate((V, W)), np.concatenate((Q, R + len(V))))
    assert u.summary.endswith("7, 8, 9, 10, 11, 12, 13, ... (16 in all)): singular")
    assert [c.status for c in u.charts] == ["mapped", "failed"]


def test_many_failures_are_summed_up():
    V = np.concatenate([CUBE_V + [3.0 * k, 0, 0] for k in range(11)])
    Q = np.concatenate([CUBE + 8 * k for k in range(11)])
    u = unwrap(V, Q)
    assert u.summary.startswith("mapped 0 of 11 charts; chart 0 (faces 0, 1, 2, 3, 4, 5): The chart is closed")
    assert u.summary.endswith("; and 3 more")
    assert all(type(c.error) is TopologyError for c in u.charts)


OPTIONS = {
    "method": ({"method": "fast"}, "method"),
    "objective": ({"objective": "area"}, "objective"),
    "pin mode": ({"method": "linear", "pin_mode": "constraint"}, "linear"),
    "tolerance": ({"tolerance": 0.0}, "tolerance"),
    "repair": ({"repair": "yes"}, "repair"),
    "laplacian": ({"laplacian": "mean"}, "laplacian"),
    "backend": ({"backend": "abacus"}, "backend"),
    "holes": ({"holes": "ignore"}, "holes"),
    "closed": ({"closed": "open"}, "closed"),
    "nonmanifold": ({"nonmanifold": "mend"}, "nonmanifold"),
    "orientation": ({"orientation": "cut"}, "orientation"),
    "place": ({"place": "left"}, "place"),
    "margin": ({"margin": 0.5}, "margin"),
    "rotation": ({"rotation": np.nan}, "rotation"),
    "seam": ({"seams": [(0, 1), (0, 5)]}, r"1 seams are not edges of the mesh: \(0, 5\)"),
    "seam out of range": ({"seams": [(0, 99)]}, r"\(0, 99\)"),
    "seam shape": ({"seams": [0, 1]}, "seams"),
    "selection": ({"selection": [0, 6]}, "selection"),
    "mask": ({"selection": [True, False]}, "selection"),
    "nothing": ({"selection": []}, "No face"),
    "center": ({"center": 99}, "center: vertices 99"),
    "center unselected": ({"center": 0, "selection": [5]}, "center: vertices 0"),
    "pins": ({"pins": [0, 1.5, 2]}, "pins"),
    "boundary vertex": ({"boundary_vertex": "first"}, "boundary_vertex"),
    "outer loop": ({"outer_loop": 5}, "outer_loop: vertices 5 are on no boundary"),
    "pins and center": ({"pins": [0, 3, 11], "center": 5}, "leave out center"),
}


@pytest.mark.parametrize("name", OPTIONS)
def test_options_that_are_not_taken(name):
    options, said = OPTIONS[name]
    with pytest.raises(OptionError, match=said):
        unwrap(*grid(3, 2), **options)


def test_a_bad_option_is_told_even_where_no_chart_can_be_mapped():
    with pytest.raises(OptionError, match="method"):
        unwrap(CUBE_V, CUBE, method="fast")


def test_a_seam_between_faces_that_are_not_selected_is_no_error():
    V, Q = grid(3, 2)
    assert unwrap(V, Q, selection=[0], seams=[(2, 6)]).mapped[0]
    with pytest.raises(OptionError, match=r"\(0, 5\)"):  # a diagonal
        unwrap(V, Q, selection=[5], seams=[(0, 5)])


V4 = np.zeros((4, 3))
ARRAYS = {
    "columns": (np.zeros((4, 5)), [[0, 1, 2]], "shape"),
    "words": ([["a", "b", "c"]], [[0, 1, 2]], "numbers"),
    "no vertices given": (None, [[0, 1, 2]], "V is missing"),
    "index": (V4, [[0, 1, 2], [0, 1, 4]], "polygons 1"),
    "negative": (V4, [[0, 1, -1]], "polygons 0"),
    "fractions": (V4, np.array([[0.0, 1.0, 2.5]]), "vertex indices"),
    "short": (V4, [[0, 1, 2], [0, 1], []], "2 polygons have fewer than 3 corners: polygons 1, 2"),
    "empty": (V4, [], "empty"),
    "empty array": (V4, np.empty((0, 3), dtype=int), "empty"),
    "flat": (V4, np.array([0, 1, 2]), "shape"),
    "not lists": (V4, [0, 1, 2], "vertex lists"),
}


@pytest.mark.parametrize("name", ARRAYS)
def test_arrays_that_are_no_mesh(name):
    V, polygons, said = ARRAYS[name]
    with pytest.raises(MeshError, match=said):
        unwrap(V, polygons)


def test_short_polygons_that_are_not_selected_do_not_matter():
    V, Q = grid(1, 1)
    assert unwrap(V, [[0, 1], Q[0].tolist(), []], selection=[1]).mapped.tolist() == [False, True, False]

"""Conformal Live Pins: islands mapped from their pins, and a pin dragged by a script."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
import scenes

import conformal_uv as cuv


@pytest.fixture
def grid():
    """A grid with free UVs, and three pins: two corners and an inner vertex."""
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    scenes.pin(ob, [0, 12, 60])
    return ob


def by_vertex(ob):
    """UVs of the vertices, (n, 2); each has one."""
    uv = np.empty((len(ob.data.vertices), 2), dtype=np.float32)
    uv[[loop.vertex_index for loop in ob.data.loops]] = scenes.uvs(ob)
    return uv.astype(float)


def fresh(ob, pins):
    V, polygons = scenes.arrays(ob)
    mesh = cuv.PolygonMesh(V, np.concatenate(polygons), np.arange(0, 4 * len(polygons) + 1, 4))
    F, _, _ = cuv.triangulate(mesh)
    return cuv.pinned_map(V, F, pins).uv


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_a_dragged_pin_is_a_fresh_solution(grid, mode):
    before = by_vertex(grid)
    mode()
    corner = [0.9, 0.4]
    assert bpy.ops.uv.conformal_live(corner=corner_of_vertex(grid, 12), place=corner) == {"FINISHED"}
    assert bpy.context.mode == ("EDIT_MESH" if mode is scenes.edit else "OBJECT")
    scenes.leave()
    expected = fresh(grid, {0: before[0], 12: corner, 60: before[60]})
    np.testing.assert_allclose(by_vertex(grid), expected, rtol=0, atol=3e-7)
    assert np.abs(by_vertex(grid) - before).max() > 0.05


def corner_of_vertex(ob, vertex):
    """The first corner at a vertex, in either mode."""
    if ob.mode == "EDIT":
        ob.update_from_editmode()
    return [vertex for polygon in ob.data.polygons for vertex in polygon.vertices].index(vertex)


def test_a_vertex_without_a_pin_is_held_by_those_that_have_one(grid):
    before = by_vertex(grid)
    bpy.ops.uv.conformal_live(corner=corner_of_vertex(grid, 5), place=[0.5, 0.1])
    expected = fresh(grid, {0: before[0], 5: [0.5, 0.1], 12: before[12], 60: before[60]})
    np.testing.assert_allclose(by_vertex(grid), expected, rtol=0, atol=3e-7)


def test_without_pins_the_farthest_boundary_vertex_stays(grid):
    scenes.pin(grid, [])
    before = by_vertex(grid)
    bpy.ops.uv.conformal_live(corner=corner_of_vertex(grid, 0), place=[0.3, 0.3])
    after = by_vertex(grid)
    far = np.argmax(np.hypot(*(before - before[0]).T))
    np.testing.assert_array_equal(after[far], before[far])
    np.testing.assert_allclose(after[0], [0.3, 0.3], rtol=0, atol=1e-7)


def test_drags_in_turn_are_replayed(grid):
    before = by_vertex(grid)
    first, second = corner_of_vertex(grid, 12), corner_of_vertex(grid, 0)
    bpy.ops.uv.conformal_live(
        corner=second, place=[0.1, 0.2], object_name="Grid", earlier=json.dumps([["Grid", first, 0.9, 0.4]])
    )
    expected = fresh(grid, {0: [0.1, 0.2], 12: [0.9, 0.4], 60: before[60]})
    np.testing.assert_allclose(by_vertex(grid), expected, rtol=0, atol=3e-7)


def test_without_a_drag_islands_are_unwrapped_from_their_pins(grid):
    before = by_vertex(grid)
    before[12] += [0.1, -0.05]
    uv = before[[loop.vertex_index for loop in grid.data.loops]].astype(np.float32)
    grid.data.uv_layers.active.uv.foreach_set("vector", uv.reshape(-1))
    before = by_vertex(grid)
    assert bpy.ops.uv.conformal_live() == {"FINISHED"}
    expected = fresh(grid, {v: before[v] for v in (0, 12, 60)})
    after = by_vertex(grid)
    np.testing.assert_allclose(after, expected, rtol=0, atol=3e-7)
    np.testing.assert_array_equal(after[[0, 12, 60]], before[[0, 12, 60]])
    bpy.ops.uv.conformal_live()
    np.testing.assert_allclose(by_vertex(grid), after, rtol=0, atol=3e-7)


def test_three_pins_keep_a_disk_a_disk(grid):
    scenes.pin(grid, [])
    bpy.ops.uv.conformal_unwrap(shape="DISK")
    scenes.pin(grid, [0, 12, 129])
    before = (2.0 * by_vertex(grid) - 1.0).view(complex)[:, 0]
    target = before[12] * np.exp(0.3j)
    place = 0.5 + 0.5 * np.array([target.real, target.imag])
    bpy.ops.uv.conformal_live(corner=corner_of_vertex(grid, 12), place=place)
    after = (2.0 * by_vertex(grid) - 1.0).view(complex)[:, 0]
    pins = [0, 12, 129]
    expected = cuv.Moebius.from_three_pairs(before[pins], [before[0], target, before[129]])(before)
    np.testing.assert_allclose(after, expected, rtol=0, atol=3e-6)
    rim = np.abs(before) > 1.0 - 1e-6
    np.testing.assert_allclose(np.abs(after[rim]), 1.0, rtol=0, atol=2e-7)


def test_refusals_leave_everything(grid):
    scenes.pin(grid, [3])
    before = scenes.shadowed(scenes.uvs(grid))
    with pytest.raises(RuntimeError, match="no selected island has two pinned UVs"):
        bpy.ops.uv.conformal_live()
    with pytest.raises(RuntimeError, match="no such UV"):
        bpy.ops.uv.conformal_live(corner=10**6)
    with pytest.raises(RuntimeError, match="no such UV"):
        bpy.ops.uv.conformal_live(corner=0, object_name="Nobody")
    assert scenes.shadowed(scenes.uvs(grid)) == before


def test_a_closed_island_is_told():
    cube = scenes.primitive("cube")
    bpy.ops.object.mode_set(mode="OBJECT")
    vertices = np.array([loop.vertex_index for loop in cube.data.loops])
    uv = np.column_stack((vertices, vertices**2)).astype(np.float32)  # one UV a vertex: welded all around
    cube.data.uv_layers.active.uv.foreach_set("vector", uv.reshape(-1))
    scenes.pin(cube, [0, 1])
    with pytest.raises(RuntimeError, match="closed"):
        bpy.ops.uv.conformal_live(corner=0, place=[0.0, 0.0])
    np.testing.assert_array_equal(scenes.uvs(cube), uv)


def test_factorizations_are_kept_and_forgotten(addon, grid, monkeypatch):
    import sys

    bpy.ops.uv.conformal_live(corner=corner_of_vertex(grid, 12), place=[0.9, 0.4])
    live_pins = sys.modules[f"{addon.__name__}.live_pins"]
    made = []
    real = cuv.PinnedMapper
    monkeypatch.setattr("conformal_uv.charts.pin_drag.PinnedMapper", lambda *a: made.append(a) or real(*a))
    bpy.ops.uv.conformal_live(corner=corner_of_vertex(grid, 12), place=[0.8, 0.4])
    bpy.ops.uv.conformal_live(corner=corner_of_vertex(grid, 0), place=[0.1, 0.2])
    assert made == []
    assert 1 <= len(live_pins._kept) <= live_pins.MOST_KEPT
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert live_pins._kept == {}


def test_undo_and_redo_are_exact(grid):
    bpy.ops.ed.undo_push(message="before")
    before = scenes.shadowed(scenes.uvs(grid))
    bpy.ops.uv.conformal_live("EXEC_DEFAULT", True, corner=corner_of_vertex(grid, 12), place=[0.9, 0.4])
    after = scenes.shadowed(scenes.uvs(bpy.data.objects["Grid"]))
    bpy.ops.ed.undo()
    assert scenes.shadowed(scenes.uvs(bpy.data.objects["Grid"])) == before
    bpy.ops.ed.redo()
    assert scenes.shadowed(scenes.uvs(bpy.data.objects["Grid"])) == after != before

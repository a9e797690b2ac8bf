"""Islands with a free boundary, mapped with their pinned UVs where they are."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import scenes
from test_live_pins import by_vertex, fresh

PINS = [0, 12, 60]  # two corners and an inner vertex of the grid


@pytest.fixture
def grid():
    """A grid with free UVs, then pins, one of which was moved."""
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    uv = by_vertex(ob)
    uv[12] += [0.25, -0.125]
    ob.data.uv_layers.active.uv.foreach_set("vector", uv[corners(ob)].astype(np.float32).reshape(-1))
    scenes.pin(ob, PINS)
    return ob


def corners(ob):
    return [loop.vertex_index for loop in ob.data.loops]


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_an_island_follows_its_pins_and_is_not_packed(grid, addon, mode):
    before = by_vertex(grid)
    mode()
    for options in ({}, {"rotation": 1.0, "margin": 0.2, "tile": 1012}):  # nothing turns or moves it
        assert bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True, **options) == {"FINISHED"}
    scenes.leave()
    after = by_vertex(grid)
    np.testing.assert_array_equal(after[PINS], before[PINS])
    np.testing.assert_allclose(after, fresh(grid, {v: before[v] for v in PINS}), rtol=0, atol=3e-7)
    assert np.abs(after - before).max() > 0.02
    result = addon.last_result.last()
    assert result.complete and result.objects[0].quality.angle_mean < 45.0


def test_one_pin_leaves_an_island_as_it_was(grid, addon):
    scenes.pin(grid, [12])
    before = scenes.shadowed(scenes.uvs(grid))
    assert bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True) == {"FINISHED"}
    assert scenes.shadowed(scenes.uvs(grid)) == before
    assert "pin two or more and turn on Use Pins" in addon.last_result.last().message


def test_other_islands_are_as_without_pins(grid):
    before = by_vertex(grid)
    other = scenes.grid(8, 8, name="Other")
    scenes.select(other)
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    alone = scenes.uvs(other).copy()
    other.data.uv_layers.active.uv.foreach_set("vector", np.zeros(alone.size, dtype=np.float32))
    scenes.select(grid, other)
    bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True, place="PACK")
    np.testing.assert_array_equal(by_vertex(grid)[PINS], before[PINS])
    np.testing.assert_allclose(scenes.uvs(other), alone, rtol=0, atol=1e-6)


def test_angles_are_kept_on_an_oblong_image(grid):
    before = by_vertex(grid)
    material = bpy.data.materials.new("Oblong")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("Oblong", 400, 100)
    material.node_tree.nodes.active = node
    grid.data.materials.append(material)
    bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True, tile=1002)
    after = by_vertex(grid)
    np.testing.assert_array_equal(after[PINS], before[PINS])
    image = np.array([4.0, 1.0])
    expected = fresh(grid, {v: image * before[v] for v in PINS})
    np.testing.assert_allclose(image * after, expected, rtol=0, atol=1e-6)


def test_pins_hold_the_subdivided_surface(grid):
    before = by_vertex(grid)
    bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True)
    coarse = by_vertex(grid)
    grid.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True, use_subsurf_data=True)
    after = by_vertex(grid)
    np.testing.assert_array_equal(after[PINS], before[PINS])
    assert 0.0 < np.abs(after - coarse).max() < 0.1


def test_moved_pins_are_seen_by_the_kept_work(grid):
    bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True)
    before = by_vertex(grid)
    before[0] -= 0.25
    grid.data.uv_layers.active.uv.foreach_set("vector", before[corners(grid)].astype(np.float32).reshape(-1))
    before = by_vertex(grid)
    bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True)
    after = by_vertex(grid)
    np.testing.assert_allclose(after, fresh(grid, {v: before[v] for v in PINS}), rtol=0, atol=3e-7)


def test_both_sides_of_a_seam_have_pins_of_their_own():
    ob = scenes.mesh_object(
        [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]], [[0, 1, 4, 3], [1, 2, 5, 4]]
    )
    scenes.mark_seams(ob, lambda a, b: a.x == b.x == 1)
    uv = np.zeros((8, 2), dtype=np.float32)
    uv[[1, 2, 4, 7]] = [[0, 0], [0, 2], [3, 3], [3, 3.5]]
    ob.data.uv_layers.active.uv.foreach_set("vector", uv.reshape(-1))
    scenes.pin(ob, [1, 4])
    assert bpy.ops.uv.conformal_unwrap(shape="FREE", use_pins=True) == {"FINISHED"}
    found = scenes.uvs(ob)
    np.testing.assert_allclose(found[:4], [[-2, 0], [0, 0], [0, 2], [-2, 2]], rtol=0, atol=1e-6)
    np.testing.assert_allclose(found[4:], [[3, 3], [3.5, 3], [3.5, 3.5], [3, 3.5]], rtol=0, atol=1e-6)

"""Free boundaries and upright islands by their figures, in the UVs as stored and in the operator's own numbers."""

from __future__ import annotations

import bpy
import measured
import numpy as np
import pytest
import scenes

EXACT, STORED = 1e-6, 1e-5  # degrees: in double precision, and in single where that allows


def cross():
    ob = scenes.primitive("cube")
    scenes.mark_seams_of_uvs(ob)
    return ob


def cylinder():
    ob = scenes.primitive("cylinder")
    scenes.mark_seams(ob, lambda a, b: a.z == b.z or (abs(a.x) < 1e-6 and a.y > 0.0))
    return ob


def cone():
    ob = scenes.primitive("cone")
    scenes.mark_seams(ob, lambda a, b: a.z == b.z or max(a.y, b.y) > 0.999)
    return ob


def folded_strip():
    """Folds by multiples of a right angle less the angle of 3:4:5, so that single precision holds it exactly."""
    steps = np.array([[1.0, 0.0], [0.75, 1.0], [0.0, 1.25], [-0.75, 1.0], [1.0, 0.0], [1.25, 0.0]])
    profile = np.concatenate((np.zeros((1, 2)), np.cumsum(steps, axis=0)))
    V = np.array([[x, 0.5 * k, z] for x, z in profile for k in range(5)])
    k = np.arange(len(V)).reshape(-1, 5)
    quads = np.stack((k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]), axis=-1).reshape(-1, 4)
    return scenes.mesh_object(V, quads.tolist(), "Strip")


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
@pytest.mark.parametrize("made", [cross, cylinder, cone, folded_strip])
def test_what_can_be_unrolled_is_unrolled_exactly(addon, made, mode):
    ob = made()
    mode()
    if mode is scenes.edit:
        bpy.ops.mesh.select_all(action="SELECT")
    assert bpy.ops.uv.conformal_unwrap(shape="FREE") == {"FINISHED"}
    scenes.leave()
    quality = addon.last_result.last().objects[0].quality
    assert quality.angle_mean < EXACT and quality.angle_max < EXACT
    assert quality.area_ratio == pytest.approx(1.0, abs=1e-6)  # areas as stored
    assert measured.mean_angle_error(ob) < max(STORED, measured.rounding_of_angles(ob))


def wall():
    """A curved wall, its UVs of no account."""
    angle, height = (axis.ravel() for axis in np.meshgrid(np.linspace(0.3, 1.5, 17), np.linspace(0.0, 1.0, 13)))
    k = np.arange(angle.size).reshape(13, 17)
    quads = np.stack((k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]), axis=-1).reshape(-1, 4)
    return scenes.mesh_object(np.column_stack((np.cos(angle), np.sin(angle), height)), quads.tolist(), "Wall")


def terrain():
    return scenes.grid(30, 24, 0.05, "Terrain")


@pytest.mark.parametrize("shape", ["DISK", "FREE"])
@pytest.mark.parametrize(("made", "up"), [(wall, 2), (terrain, 1)])
def test_walls_stand_and_terrains_lie_as_on_a_map(shape, made, up):
    ob = made()
    bpy.ops.uv.conformal_unwrap(shape=shape)
    assert abs(measured.tilt(ob, up)) < 1.0
    before = scenes.uvs(ob)
    bpy.ops.uv.conformal_unwrap(shape=shape, upright="NONE", rotation=1.0)
    assert abs(measured.tilt(ob, up)) > 1.0
    bpy.ops.uv.conformal_unwrap(shape=shape)
    np.testing.assert_array_equal(scenes.uvs(ob), before)


def suzanne(levels=0):
    """With the seams of its own UV map; perhaps subdivided."""
    ob = scenes.primitive("monkey")
    scenes.mark_seams_of_uvs(ob)
    if levels:
        ob.modifiers.new("Subdivision", "SUBSURF").levels = levels
        bpy.ops.object.modifier_apply(modifier="Subdivision")
    return ob


@pytest.mark.parametrize("shape", ["DISK", "FREE"])
@pytest.mark.parametrize("levels", [0, 1])
def test_suzannes_head_is_upright_and_symmetric(shape, levels):
    ob = suzanne(levels)
    bpy.ops.uv.conformal_unwrap(shape=shape)
    head = measured.largest_island(ob)
    assert abs(measured.tilt(ob, 2, head)) < 1.0
    assert measured.mirror_misfit(ob, head) < 0.002


@pytest.mark.parametrize(("levels", "peer"), [(0, 19.1), (2, 3.98)])  # of Blender 4.3.2, by another choice of seams
def test_suzanne_is_less_distorted_than_by_blenders_conformal(addon, levels, peer):
    ob = suzanne(levels)
    scenes.edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.unwrap(method="CONFORMAL")
    scenes.leave()
    theirs = measured.mean_angle_error(ob)
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    ours = measured.mean_angle_error(ob)
    assert ours <= theirs and ours <= peer
    own = addon.last_result.last().objects[0].quality.angle_mean  # on its own triangles of the quads, which it refines
    bpy.ops.uv.conformal_unwrap(shape="FREE", refine=True)
    assert addon.last_result.last().objects[0].quality.angle_mean < own

"""Conformal Sphere Slide: the shape key and the UVs of a sphere moved by the library's maps of the sphere."""

from __future__ import annotations

import importlib

import bpy
import numpy as np
import pytest
import scenes
import windowless
from mathutils import Euler

import conformal_uv as cuv


@pytest.fixture(params=["EQUIRECTANGULAR", "OCTAHEDRAL"])
def egg(request):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
    ob = bpy.context.object
    ob.scale = (1, 1.3, 1.8)
    bpy.ops.object.transform_apply(scale=True)
    bpy.ops.object.conformal_sphere(uv=request.param)
    ob["layout"] = request.param
    return ob


@pytest.fixture
def operator(addon):
    return windowless.Driven(importlib.import_module(f"{addon.__name__}.live_tools").UV_OT_conformal_sphere_slide)


def positions(ob):
    data = ob.data.shape_keys.key_blocks["Conformal Sphere"].data
    out = np.empty(3 * len(data), dtype=np.float32)
    data.foreach_get("co", out)
    return out.reshape(-1, 3)


def bits(ob):
    return scenes.shadowed(positions(ob)), scenes.shadowed(scenes.uvs(ob))


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_it_is_the_librarys_map_of_the_sphere(egg, mode):
    before = positions(egg).astype(float)
    middle = 0.5 * (before.min(axis=0) + before.max(axis=0))
    radius = np.linalg.norm(before - middle, axis=1).mean()
    angles = (0.3, -0.2, 0.9)
    mode()
    assert bpy.ops.uv.conformal_sphere_slide(toward=(0.3, 0.1, -0.4), rotation=angles) == {"FINISHED"}
    assert bpy.context.mode == ("EDIT_MESH" if mode is scenes.edit else "OBJECT")
    scenes.leave()
    moebius = cuv.SphereMoebius.of([0.3, 0.1, -0.4], np.array(Euler(angles).to_matrix()))
    after = positions(egg).astype(float)
    x = (before - middle) / np.linalg.norm(before - middle, axis=1, keepdims=True)
    # The middle is that of the box of a few thousand points, near that of the sphere.
    np.testing.assert_allclose(after, middle + radius * moebius(x), rtol=0, atol=0.02 * radius)
    fitted = cuv.stored_sphere(mesh_of(egg), after, scenes.uvs(egg))
    assert fitted.octahedron is (egg["layout"] == "OCTAHEDRAL")  # the UVs are those of the new positions
    np.testing.assert_allclose(np.linalg.norm(after - fitted.center, axis=1), fitted.radius, rtol=1e-5)


def mesh_of(ob):
    V, polygons = scenes.arrays(ob)
    return cuv.PolygonMesh(V, np.concatenate(polygons), np.arange(0, 3 * len(polygons) + 1, 3))


def test_the_basis_and_other_maps_stay(egg):
    basis = scenes.shadowed(np.array([tuple(point.co) for point in egg.data.shape_keys.key_blocks["Basis"].data]))
    egg.data.uv_layers.new(name="Second")
    egg.data.uv_layers.active = egg.data.uv_layers[0]
    second = scenes.shadowed(scenes.uvs(egg, "Second"))
    bpy.ops.uv.conformal_sphere_slide(toward=(0.3, 0.1, -0.4))
    assert scenes.shadowed(scenes.uvs(egg, "Second")) == second
    stays = np.array([tuple(point.co) for point in egg.data.shape_keys.key_blocks["Basis"].data])
    assert scenes.shadowed(stays) == basis


def test_other_uvs_stay_and_the_shape_key_moves(egg):
    scenes.uvs(egg)
    other = np.random.default_rng(2).uniform(size=(2 * len(egg.data.loops))).astype(np.float32)
    egg.data.uv_layers.active.uv.foreach_set("vector", other)
    before = bits(egg)
    bpy.ops.uv.conformal_sphere_slide(toward=(0.3, 0.1, -0.4))
    after = bits(egg)
    assert after[1] == before[1] and after[0] != before[0]


def test_refusals(egg):
    before = bits(egg)
    with pytest.raises(RuntimeError, match="not shorter than 1"):
        bpy.ops.uv.conformal_sphere_slide(toward=(0.9, 0.9, 0.0))
    assert bits(egg) == before
    egg.data.shape_keys.key_blocks["Conformal Sphere"].data[7].co *= 1.5
    with pytest.raises(RuntimeError, match="no shape key"):
        bpy.ops.uv.conformal_sphere_slide(toward=(0.3, 0.0, 0.0))
    scenes.grid()
    with pytest.raises(RuntimeError, match="no shape key"):
        bpy.ops.uv.conformal_sphere_slide()


def test_dragged_and_magnified(egg, operator):
    before = bits(egg)
    assert operator.press(at=(0.4, 0.5)) == {"RUNNING_MODAL"}
    operator.move((0.4, 0.5), (0.45, 0.55))
    operator.press("WHEELUPMOUSE", at=(0.45, 0.55))
    operator.move((0.5, 0.6), shift=True)
    assert operator.press(value="RELEASE") == {"FINISHED"}
    after = bits(egg)
    assert after[0] != before[0] and after[1] != before[1]
    assert np.linalg.norm(operator.toward) == pytest.approx(np.tanh(0.1), abs=1e-6)
    key = egg.data.shape_keys.key_blocks["Conformal Sphere"]
    moved, uv = positions(egg), scenes.uvs(egg).copy()
    key.data.foreach_set("co", np.frombuffer(before[0], dtype=np.float32))
    egg.data.uv_layers.active.uv.foreach_set("vector", np.frombuffer(before[1], dtype=np.float32))
    bpy.ops.uv.conformal_sphere_slide(**operator.properties())
    np.testing.assert_allclose(positions(egg), moved, rtol=0, atol=1e-5)
    assert (np.abs(scenes.uvs(egg) - uv).max(axis=1) < 1e-4).mean() > 0.98


def test_numbers_typed(egg, operator):
    operator.press("S", at=(0.5, 0.5))  # from the menu
    for key, character in (("NINE", "9"), ("ZERO", "0"), ("Z", "z"), ("MINUS", "-"), ("PERIOD", "."), ("FIVE", "5")):
        assert operator.press(key, ascii=character) == {"RUNNING_MODAL"}
    assert "Rotation 90.0" in operator.headers[-1] and "Z [-.5|]" in operator.headers[-1]
    assert operator.press("RET") == {"FINISHED"}
    assert operator.toward == pytest.approx([0.0, 0.0, -0.5], abs=1e-6)
    assert tuple(operator.rotation) == pytest.approx((0.0, 0.0, np.pi / 2), abs=1e-6)


def test_typed_numbers_keep_the_rest_and_stay_within_reach(addon):
    slide = importlib.import_module(f"{addon.__name__}.sphere_slide").SphereSlide(False)
    slide.magnify((0.3, 0.6), 0.4)
    toward, _ = slide.moebius.toward_and_rotation()
    slide.put("rotation", -120.0)
    slide.put("y", 0.125)
    after, _ = slide.moebius.toward_and_rotation()
    assert after == pytest.approx([toward[0], 0.125, toward[2]], abs=1e-12)
    assert slide.degrees == pytest.approx(-120.0)
    slide.put("x", 7.0)
    after, _ = slide.moebius.toward_and_rotation()
    assert 0.99 < np.linalg.norm(after) < 1.0


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
@pytest.mark.parametrize("key", ["ESC", "RIGHTMOUSE"])
def test_cancelled_restores_every_bit(egg, operator, mode, key):
    before = bits(egg)
    mode()
    operator.press(at=(0.4, 0.5))
    operator.move((0.4, 0.5), (0.45, 0.55), (2.0, -3.0))
    operator.press("WHEELDOWNMOUSE", at=(0.1, 0.1))
    assert operator.press(key) == {"CANCELLED"}
    assert bpy.context.mode == ("EDIT_MESH" if mode is scenes.edit else "OBJECT")
    scenes.leave()
    assert bits(egg) == before


def test_undo_and_redo_are_exact(egg):
    name = egg.name
    bpy.ops.ed.undo_push(message="before")
    before = bits(egg)
    bpy.ops.uv.conformal_sphere_slide("EXEC_DEFAULT", True, toward=(0.3, 0.1, -0.4))
    after = bits(bpy.data.objects[name])
    bpy.ops.ed.undo()
    assert bits(bpy.data.objects[name]) == before
    bpy.ops.ed.redo()
    assert bits(bpy.data.objects[name]) == after != before

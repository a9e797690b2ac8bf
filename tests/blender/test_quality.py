"""Quality told in words: advice, the most distorted faces, stale numbers, scale, the library's texts."""

from __future__ import annotations

from importlib import import_module

import bpy
import numpy as np
import pytest
import scenes


@pytest.fixture
def part(addon):
    return lambda name: import_module(f"{addon.__name__}.{name}")


def corner_angles(points):
    """Angles of triangles (m, 3, d), degrees, by the arc cosine."""
    sides = np.roll(points, -1, axis=1) - points, np.roll(points, 1, axis=1) - points
    cosine = (sides[0] * sides[1]).sum(axis=2) / np.prod([np.linalg.norm(side, axis=2) for side in sides], axis=0)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))


@pytest.fixture
def sheared():
    """A triangulated grid whose UVs are worse the further right."""
    ob = scenes.grid(10, 8, height=0.3)
    scenes.edit()
    bpy.ops.mesh.quads_convert_to_tris()
    scenes.leave()
    V, faces = scenes.arrays(ob)
    flat = V[np.concatenate(faces)][:, :2]
    uv = np.column_stack((flat[:, 0] + 1.0, (flat[:, 1] + 1.0) * (1.2 + flat[:, 0]) ** 2)).astype(np.float32)
    ob.data.uv_layers[0].uv.foreach_set("vector", uv.reshape(-1))
    error = np.abs(corner_angles(V[np.array(faces)]) - corner_angles(uv.reshape(-1, 3, 2).astype(float))).max(axis=1)
    return ob, error


def chosen(ob):
    scenes.leave()
    return np.array([polygon.select for polygon in ob.data.polygons])


def test_the_most_distorted_faces(sheared):
    ob, error = sheared
    scenes.edit()
    assert bpy.ops.uv.conformal_select_worst(by="SHARE", share=10.0) == {"FINISHED"}
    found = chosen(ob)
    assert found.sum() == np.ceil(0.1 * len(error)) and error[found].min() >= error[~found].max()
    scenes.edit()
    limit = float(np.median(error)) + 0.01
    assert bpy.ops.uv.conformal_select_worst(by="ERROR", error=np.radians(limit)) == {"FINISHED"}
    np.testing.assert_array_equal(chosen(ob), error > limit)


def test_hidden_faces_are_not_among_them(sheared):
    ob, error = sheared
    worst = int(error.argmax())
    ob.data.polygons[worst].hide = True
    scenes.edit()
    bpy.ops.uv.conformal_select_worst(by="ERROR", error=0.0)
    found = chosen(ob)
    assert not found[worst] and found.sum() == len(error) - 1


def test_poor_maps_are_told_and_mended(part, addon):
    advice = part("advice").advice_for
    scenes.primitive("monkey")
    bpy.ops.uv.conformal_unwrap(shape="DISK")
    result = addon.last_result.last()
    told = advice(result)
    assert result.objects[0].quality.angle_mean > part("advice").POOR_ANGLE
    assert told[0].action == "Use Free" and told[0].changes == {"shape": "FREE"}
    assert f"Mean angle error {result.objects[0].quality.angle_mean:.0f}°" in told[0].text
    assert len({piece.action for piece in told}) == len(told)
    bpy.ops.uv.conformal_unwrap(**{**result.options.as_arguments(), **told[0].changes})
    told = advice(addon.last_result.last())
    assert told[0].changes == {} and "seams" in told[0].text and told[0].action


def test_good_maps_need_no_advice(part, addon):
    scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    assert part("advice").advice_for(addon.last_result.last()) == []


def test_islands_that_fail_get_a_button_that_helps(part, addon):
    scenes.grid()
    box = scenes.mesh_object(
        [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)],
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]],
        "Box",
    )
    scenes.select(box, bpy.data.objects["Grid"])
    bpy.ops.uv.conformal_unwrap()
    result = addon.last_result.last()
    told = [piece for piece in part("advice").advice_for(result) if piece.action == "Closed Surfaces: Cut"]
    assert [piece.changes for piece in told] == [{"closed": "CUT"}]
    assert bpy.ops.uv.conformal_unwrap(**{**result.options.as_arguments(), **told[0].changes}) == {"FINISHED"}
    assert addon.last_result.last().complete


def test_numbers_go_stale(addon, part):
    ob = scenes.grid()
    other = scenes.grid(4, 4, name="Other")
    scenes.select(ob)
    bpy.ops.uv.conformal_unwrap()
    bpy.context.view_layer.update()
    assert not addon.last_result.stale()
    other.data.vertices[0].co.z += 1.0
    other.data.update()
    bpy.context.view_layer.update()
    assert not addon.last_result.stale()
    before = ob.data.vertices[0].co.z
    ob.data.vertices[0].co.z += 1.0
    ob.data.update()
    bpy.context.view_layer.update()
    assert addon.last_result.stale()
    ob.data.vertices[0].co.z = before
    part("staleness").undone()  # as after undo
    assert not addon.last_result.stale()
    uv = scenes.uvs(ob)
    uv[0] += 0.1
    ob.data.uv_layers[0].uv.foreach_set("vector", uv.reshape(-1))
    part("staleness").undone()
    assert addon.last_result.stale()
    bpy.ops.uv.conformal_unwrap()
    assert not addon.last_result.stale()
    bpy.data.objects.remove(ob)
    assert addon.last_result.stale()


@pytest.mark.parametrize(
    ("name", "options", "stale"),
    [
        ("uv.conformal_slide", {"center": (0.3, 0.0)}, True),
        ("uv.conformal_pack", {"margin": 0.1}, True),
        ("view3d.conformal_overlay", {}, False),
        ("object.conformal_flatten", {"result": "OBJECT"}, False),
        ("object.conformal_flatten", {"result": "SHAPE_KEY"}, False),
    ],
)
def test_other_tools_make_numbers_stale_where_they_move_uvs(addon, part, name, options, stale):
    scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    prefix, suffix = name.split(".")
    assert getattr(getattr(bpy.ops, prefix), suffix)(**options) == {"FINISHED"}
    bpy.context.view_layer.update()
    assert addon.last_result.stale() == stale
    part("staleness").undone()  # the closer look
    assert addon.last_result.stale() == stale


def test_uvs_of_a_sphere_make_numbers_stale(addon):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
    bpy.ops.uv.conformal_unwrap(closed="CUT")
    for layout, stale in (("NONE", False), ("OCTAHEDRAL", True)):
        assert bpy.ops.object.conformal_sphere(uv=layout) == {"FINISHED"}
        bpy.context.view_layer.update()
        assert addon.last_result.stale() == stale


def test_selecting_faces_makes_nothing_stale(addon, part):
    scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    scenes.edit()
    bpy.context.view_layer.update()
    part("staleness").undone()  # Blender tells of the way into Edit Mode as of a change
    assert not addon.last_result.stale()
    bpy.ops.uv.conformal_select_worst()
    assert not addon.last_result.stale()


def test_panel_tells_what_is_stale(addon, part):
    from test_options import Layout

    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    for stale in (False, True):
        addon.last_result.set_stale(stale)
        layout = Layout()
        part("panel").draw_result(layout, addon.last_result.last(), 200)
        assert ("Changed since then" in " ".join(layout.texts("label"))) == stale
        assert ob.name in layout.texts("label")


@pytest.mark.parametrize(("scale", "told"), [((2, 2, 2), False), ((-1, 1, 1), False), ((1, 1, 1.5), True)])
def test_scale_that_is_not_uniform_is_told(addon, scale, told):
    ob = scenes.grid()
    ob.scale = scale
    bpy.context.view_layer.update()
    bpy.ops.uv.conformal_unwrap()
    remarks = addon.last_result.last().remarks
    assert any(remark.startswith("Grid: the scale is not uniform") for remark in remarks) == told


@pytest.mark.parametrize(
    ("library", "said"),
    [
        ("cut along 1 edges of three or more faces", "cut along 1 edge of three or more faces"),
        ("1 faces repeat a vertex: faces 0. Remove it.", "1 face repeats a vertex: face 0. Remove it."),
        ("2 faces have no area: faces 3, 11.", "2 faces have no area: faces 3, 11."),
        ("11 edges have three faces: edges 1", "11 edges have three faces: edges 1"),
        ("The chart is closed, of genus 0", "The island is closed, of genus 0"),
        ("no chart can use vertices 7, 8", "no island can use vertices 7, 8"),
        ("1 vertices have a NaN coordinate: vertices 4.", "1 vertex has a NaN coordinate: vertex 4."),
    ],
)
def test_one_thing_is_no_several(part, library, said):
    assert part("words").as_blender_says(library) == said

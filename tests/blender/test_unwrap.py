"""What the operator writes: the same as conformal_uv.unwrap, in both modes, on all kinds of meshes."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import scenes

import conformal_uv as cuv

FLOAT32 = 3e-7


def expected(ob, **options):
    """UVs that conformal_uv gives; a single disk put into the unit square by 0.5 + 0.5 uv."""
    margin = options.pop("margin", 0.0025)
    result = cuv.unwrap(*scenes.arrays(ob), seams=scenes.seams(ob), place="disk", **options)
    if len(result.charts) == 1:
        return 0.5 + 0.5 * result.uv
    return cuv.unwrap(*scenes.arrays(ob), seams=scenes.seams(ob), margin=margin, margin_method="fraction", **options).uv


def check(ob, **options):
    np.testing.assert_allclose(scenes.uvs(ob), expected(ob, **options), atol=FLOAT32)


@pytest.mark.parametrize("method", ["LINEAR", "NEWTON", "AUGMENTED_LAGRANGIAN"])
def test_grid_in_object_mode(method):
    ob = scenes.grid()
    assert bpy.ops.uv.conformal_unwrap(method=method) == {"FINISHED"}
    check(ob, method=method.lower().replace("_", "-"))


@pytest.mark.parametrize("method", ["LINEAR", "NEWTON"])
def test_grid_in_edit_mode(method):
    ob = scenes.grid()
    scenes.edit()
    assert bpy.ops.uv.conformal_unwrap(method=method) == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    scenes.leave()
    check(ob, method=method.lower())


def test_boundary_lies_on_the_circle():
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    radius = np.hypot(*(2.0 * scenes.uvs(ob).astype(float) - 1.0).T)
    edges = np.array([abs(v.co.x) > 0.999 or abs(v.co.y) > 0.799 for v in ob.data.vertices])
    rim = edges[[loop.vertex_index for loop in ob.data.loops]]
    np.testing.assert_allclose(radius[rim], 1.0, atol=1e-6)
    assert radius[~rim].max() < 0.999


def test_seams_of_a_cube():
    ob = scenes.primitive("cube")
    for edge in ob.data.edges:
        edge.use_seam = True
    bpy.ops.uv.conformal_unwrap()
    check(ob)
    bpy.ops.uv.conformal_unwrap(margin=0.05)
    check(ob, margin=0.05)


def test_suzanne_cut_down_the_middle():
    ob = scenes.primitive("monkey")
    scenes.mark_seams(ob, lambda a, b: abs(a.x) < 1e-6 and abs(b.x) < 1e-6)
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    check(ob)
    assert len(set(scenes.face_islands(ob))) == 4  # two halves, two eyes


def test_polygons_stay_as_they_are():
    ob = scenes.primitive("circle", vertices=9, fill_type="NGON")
    scenes.edit()
    bpy.ops.mesh.inset(thickness=0.3)
    bpy.ops.mesh.select_all(action="SELECT")
    scenes.leave()
    before = scenes.arrays(ob)[1]
    assert {len(polygon) for polygon in before} == {4, 9}
    bpy.ops.uv.conformal_unwrap()
    assert scenes.arrays(ob)[1] == before
    check(ob)


def test_several_objects_at_once():
    """In Object Mode each fills the square; in Edit Mode they share it."""
    one, other = scenes.grid(name="One"), scenes.grid(7, 5, 0.3, name="Other")
    scenes.select(one, other)
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    check(one)
    check(other)
    scenes.edit()
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    scenes.leave()
    boxes = [(uv.min(axis=0), uv.max(axis=0)) for uv in (scenes.uvs(one), scenes.uvs(other))]
    middles = [low + high for low, high in boxes]
    radii = [0.5 * (high - low).max() for low, high in boxes]
    assert 0.5 * np.hypot(*(middles[0] - middles[1])) > sum(radii)  # disks apart; their boxes may overlap
    assert min(low.min() for low, _ in boxes) >= 0.0 and max(high.max() for _, high in boxes) <= 1.0


def test_objects_that_share_a_mesh(factorizations):
    ob = scenes.grid()
    twin = bpy.data.objects.new("Twin", ob.data)
    bpy.context.scene.collection.objects.link(twin)
    scenes.select(ob, twin)
    bpy.ops.uv.conformal_unwrap()
    assert len(factorizations) == 1
    check(ob)


def test_rotation_turns_about_the_middle():
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    z = (scenes.uvs(ob).astype(float) - 0.5) @ [1.0, 1.0j]
    bpy.ops.uv.conformal_unwrap(rotation=0.7)
    turned = (scenes.uvs(ob).astype(float) - 0.5) @ [1.0, 1.0j]
    np.testing.assert_allclose(turned, np.exp(0.7j) * z, atol=FLOAT32)


def test_active_vertex_comes_to_the_middle():
    ob = scenes.grid()
    scenes.edit()
    import bmesh

    edited = bmesh.from_edit_mesh(ob.data)
    edited.verts.ensure_lookup_table()
    edited.select_history.clear()
    edited.select_history.add(edited.verts[40])
    bpy.ops.uv.conformal_unwrap(center="ACTIVE")
    scenes.leave()
    corner = [loop.vertex_index for loop in ob.data.loops].index(40)
    np.testing.assert_allclose(scenes.uvs(ob)[corner], 0.5, atol=FLOAT32)
    bpy.ops.uv.conformal_unwrap(center="ACTIVE", rotation=1.0)  # read from the mesh in Object Mode too
    np.testing.assert_allclose(scenes.uvs(ob)[corner], 0.5, atol=FLOAT32)


def test_three_pins_go_to_the_cube_roots_of_one():
    ob = scenes.grid()
    pins = [0, 12, 125]
    pinned = np.isin([loop.vertex_index for loop in ob.data.loops], pins)
    ob.data.attributes.new(".pn.UVMap", "BOOLEAN", "CORNER").data.foreach_set("value", pinned)
    bpy.ops.uv.conformal_unwrap(use_pins=True)
    found = scenes.uvs(ob).astype(float)
    corner = [loop.vertex_index for loop in ob.data.loops]
    roots = np.exp(2j * np.pi / 3 * np.arange(3))
    at = [2.0 * (found[corner.index(pin)] @ [1.0, 1.0j]) - (1.0 + 1.0j) for pin in pins]
    np.testing.assert_allclose(at, roots, atol=4 * FLOAT32)
    check(ob, pins=pins)


def test_closed_surface_is_refused_or_cut():
    ob = scenes.primitive("uv_sphere")
    before = scenes.uvs(ob)
    with pytest.raises(RuntimeError, match="closed.*Closed Surfaces to Cut"):
        bpy.ops.uv.conformal_unwrap()
    assert scenes.shadowed(scenes.uvs(ob)) == scenes.shadowed(before)
    assert bpy.ops.uv.conformal_unwrap(closed="CUT") == {"FINISHED"}
    check(ob, closed="cut")


def test_subdivided_surface():
    ob = scenes.grid(6, 4, 0.6)
    scenes.mark_seams(ob, lambda a, b: abs(a.x) < 1e-6 and abs(b.x) < 1e-6)
    ob.modifiers.new("Array", "ARRAY")  # others are left out
    ob.modifiers.new("Subdivision", "SUBSURF").levels = 2
    names = {data.name for data in (*bpy.data.objects, *bpy.data.meshes)}
    fine = ob.copy()
    fine.data = ob.data.copy()
    bpy.context.scene.collection.objects.link(fine)
    scenes.select(fine)
    for name in ("Array", "Subdivision"):
        if name == "Array":
            fine.modifiers.remove(fine.modifiers[name])
        else:
            bpy.ops.object.modifier_apply(modifier=name)
    fine_uv = expected(fine)
    scenes.select(ob)
    for mode in (scenes.leave, scenes.edit):
        mode()
        bpy.ops.uv.conformal_unwrap(use_subsurf_data=True)
        scenes.leave()
        found = scenes.uvs(ob)
        for polygon in ob.data.polygons:
            near = [
                loop
                for loop, vertex in zip(polygon.loop_indices, polygon.vertices, strict=True)
                for part in fine.data.polygons
                for k in part.loop_indices
                if fine.data.loops[k].vertex_index == vertex and np.abs(fine_uv[k] - found[loop]).max() < 1e-6
            ]
            assert set(near) == set(polygon.loop_indices)
    assert {data.name for data in (*bpy.data.objects, *bpy.data.meshes)} - {fine.name, fine.data.name} == names


def test_disks_are_round_on_an_oblong_image():
    ob = scenes.grid()
    material = bpy.data.materials.new("Oblong")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("Oblong", 400, 100)
    material.node_tree.nodes.active = node
    ob.data.materials.append(material)
    bpy.ops.uv.conformal_unwrap()
    size = np.ptp(scenes.uvs(ob), axis=0)
    np.testing.assert_allclose(size * (400, 100), [100, 100], rtol=0.02)
    assert scenes.uvs(ob).min() >= 0.0 and scenes.uvs(ob).max() <= 1.0
    bpy.ops.uv.conformal_unwrap(correct_aspect=False)
    check(ob)


def test_blender_packs_at_relative_sizes():
    small, large = scenes.grid(name="Small"), scenes.grid(name="Large")
    large.data.transform(__import__("mathutils").Matrix.Scale(3.0, 4))
    scenes.select(small, large)
    for mode in (scenes.leave, scenes.edit):
        mode()
        bpy.ops.uv.conformal_unwrap(place="PACK", margin=0.01)
        scenes.leave()
        one, other = scenes.uvs(small), scenes.uvs(large)
        size = [np.ptp(uv, axis=0).max() for uv in (one, other)]
        assert size[1] == pytest.approx(3.0 * size[0], rel=0.01)
        both = np.concatenate((one, other))
        assert both.min() >= -1e-6 and both.max() <= 1.0 + 1e-6
        middle = [(uv.min(axis=0) + uv.max(axis=0)) / 2.0 for uv in (one, other)]
        gap = np.hypot(*(middle[0] - middle[1])) - sum(size) / 2.0
        assert gap > 0.0
        assert {ob.name for ob in bpy.data.objects} == {"Small", "Large"}
        assert set(bpy.context.selected_objects) == {small, large}

"""What the operator must not write: hidden, unselected and failing faces, other UV maps, the selection."""

from __future__ import annotations

from importlib import import_module

import bpy
import numpy as np
import pytest
import scenes


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
@pytest.mark.parametrize("place", ["FIT", "PACK"])
def test_unselected_and_hidden_faces_keep_their_uvs(mode, place):
    ob = scenes.grid()
    out, hidden = list(range(24)), [100, 101, 107]
    select = np.ones(len(ob.data.polygons), dtype=bool)
    select[out] = False
    ob.data.polygons.foreach_set("select", select)
    hide = np.zeros(len(ob.data.polygons), dtype=bool)
    hide[hidden] = True
    ob.data.polygons.foreach_set("hide", hide)
    kept = scenes.corners_of(ob, out + hidden)
    before = scenes.uvs(ob)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    mode()
    assert bpy.ops.uv.conformal_unwrap(place=place) == {"FINISHED"}
    scenes.leave()
    after = scenes.uvs(ob)
    assert scenes.shadowed(after[kept]) == scenes.shadowed(before[kept])
    assert (after[~kept] != before[~kept]).any(axis=1).all()
    assert [polygon.hide for polygon in ob.data.polygons] == hide.tolist()


def test_all_visible_faces_on_request_and_where_none_is_selected_in_object_mode():
    ob = scenes.grid()
    ob.data.polygons.foreach_set("select", np.arange(len(ob.data.polygons)) < 10)
    before = scenes.uvs(ob)
    bpy.ops.uv.conformal_unwrap(faces="ALL")
    assert (scenes.uvs(ob) != before).any(axis=1).all()
    ob.data.polygons.foreach_set("select", np.zeros(len(ob.data.polygons), dtype=bool))
    before = scenes.uvs(ob)
    bpy.ops.uv.conformal_unwrap(rotation=1.0)
    turned = np.abs(before - 0.5).max(axis=1) > 1e-6  # the vertex in the middle stays there
    assert (scenes.uvs(ob) != before).any(axis=1)[turned].all() and (~turned).sum() <= 6


def test_other_uv_maps_stay():
    ob = scenes.grid()
    ob.data.uv_layers.new(name="Second")
    second = scenes.uvs(ob, "Second")
    first = scenes.uvs(ob, "UVMap")
    ob.data.uv_layers.active = ob.data.uv_layers["Second"]
    bpy.ops.uv.conformal_unwrap()
    assert scenes.shadowed(scenes.uvs(ob, "UVMap")) == scenes.shadowed(first)
    assert not np.array_equal(scenes.uvs(ob, "Second"), second)
    second = scenes.uvs(ob, "Second")
    bpy.ops.uv.conformal_unwrap(uv_layer="UVMap", rotation=1.0)
    assert scenes.shadowed(scenes.uvs(ob, "Second")) == scenes.shadowed(second)
    assert ob.data.uv_layers.active.name == "Second"


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_a_missing_uv_map_is_made(mode):
    ob = scenes.grid()
    first = scenes.uvs(ob)
    mode()
    bpy.ops.uv.conformal_unwrap(uv_layer="Disk")
    scenes.leave()
    assert [layer.name for layer in ob.data.uv_layers] == ["UVMap", "Disk"]
    assert ob.data.uv_layers.active.name == "Disk"
    assert scenes.shadowed(scenes.uvs(ob, "UVMap")) == scenes.shadowed(first)
    assert not np.array_equal(scenes.uvs(ob, "Disk"), first)


def test_a_mesh_without_uv_maps_gets_one():
    ob = scenes.grid()
    ob.data.uv_layers.remove(ob.data.uv_layers[0])
    bpy.ops.uv.conformal_unwrap()
    assert [layer.name for layer in ob.data.uv_layers] == ["UVMap"]


def test_the_ninth_uv_map_is_refused():
    ob = scenes.grid()
    for number in range(7):
        ob.data.uv_layers.new(name=f"Map {number}")
    before = [scenes.shadowed(scenes.uvs(ob, layer.name)) for layer in ob.data.uv_layers]
    with pytest.raises(RuntimeError, match="Grid.*Ninth.*eight"):
        bpy.ops.uv.conformal_unwrap(uv_layer="Ninth")
    assert [scenes.shadowed(scenes.uvs(ob, layer.name)) for layer in ob.data.uv_layers] == before


@pytest.mark.parametrize("place", ["FIT", "PACK"])
def test_a_failing_island_keeps_its_uvs_and_is_named(addon, place):
    ob = scenes.grid()
    scenes.select(scenes.primitive("cube"), ob)
    bpy.ops.object.join()
    cube = bpy.context.object
    before = scenes.uvs(cube)
    failing = scenes.corners_of(cube, [f for f, root in enumerate(scenes.face_islands(cube)) if root == 0])
    assert failing.sum() == 24
    assert bpy.ops.uv.conformal_unwrap(place=place, faces="ALL") == {"FINISHED"}
    after = scenes.uvs(cube)
    assert scenes.shadowed(after[failing]) == scenes.shadowed(before[failing])
    assert (after[~failing] != before[~failing]).any(axis=1).all()
    message = addon.last_result.last().message
    assert message.startswith("Unwrapped 1 of 2 islands; Cube, faces 0, 1, 2 ...: ")


def test_failure_leaves_everything_as_it_was():
    ob = scenes.primitive("uv_sphere")
    scenes.edit()
    bpy.ops.mesh.select_all(action="SELECT")
    scenes.leave()
    layers = [layer.name for layer in ob.data.uv_layers]
    before = scenes.shadowed(scenes.uvs(ob))
    for mode in (scenes.leave, scenes.edit):
        mode()
        with pytest.raises(RuntimeError, match="Unwrapped 0 of 1 island; Sphere, faces"):
            bpy.ops.uv.conformal_unwrap(uv_layer="New")
        scenes.leave()
    assert [layer.name for layer in ob.data.uv_layers] == layers
    assert scenes.shadowed(scenes.uvs(ob)) == before


def test_bad_meshes_are_told_not_thrown():
    nan = scenes.grid(name="Nowhere")
    nan.data.vertices[20].co.x = float("nan")
    fin = scenes.mesh_object(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], [[0, 1, 2], [1, 0, 3], [0, 1, 4]], "Fin"
    )
    wire = scenes.mesh_object([[0, 0, 0], [1, 0, 0]], [], "Wire")
    good = scenes.grid(name="Good")
    loose = scenes.mesh_object([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], [[0, 1, 2]], "Loose")
    loose.data.edges.add(1)
    loose.data.edges[-1].vertices = (0, 3)
    loose.data.edges[-1].use_seam = True
    before = scenes.shadowed(scenes.uvs(nan))
    scenes.select(nan, fin, wire, good, loose)
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    assert scenes.shadowed(scenes.uvs(nan)) == before


def test_every_bad_mesh_is_named(addon):
    test_bad_meshes_are_told_not_thrown()
    result = addon.last_result.last()
    assert result.message.startswith("Unwrapped 5 of 6 islands of 5 objects; ")
    for part in ("Nowhere, faces", "NaN", "Wire: the mesh has no faces"):
        assert part in result.message
    assert result.remarks == ["Fin: cut along 1 edge of three or more faces"]  # as Blender's own unwrap does
    assert "pass " not in result.message and '="' not in result.message


@pytest.mark.parametrize("size", [1e-30, 1e30])
def test_packing_meshes_of_extreme_sizes(size):
    one, other = scenes.grid(name="One"), scenes.grid(name="Other")
    for ob in (one, other):
        V = np.array([tuple(vertex.co) for vertex in ob.data.vertices]) * size
        ob.data.vertices.foreach_set("co", V.astype(np.float32).reshape(-1))
    scenes.select(one, other)
    assert bpy.ops.uv.conformal_unwrap(place="PACK") == {"FINISHED"}  # Blender's packer crashes on infinite areas
    for ob in (one, other):
        uv = scenes.uvs(ob)
        assert uv.min() >= -1e-6 and uv.max() <= 1.0 + 1e-6 and np.ptp(uv, axis=0).min() > 0.3


def assert_apart(*objects):
    """Islands, a face each, lie in the unit square without touching."""
    quads = [quad for ob in objects for quad in scenes.uvs(ob).reshape(-1, 4, 2).astype(float)]
    assert min(quad.min() for quad in quads) >= -1e-6 and max(quad.max() for quad in quads) <= 1.0 + 1e-6
    for k, quad in enumerate(quads):
        for other in quads[:k]:
            sides = np.concatenate([np.roll(q, -1, axis=0) - q for q in (quad, other)])
            across = sides @ [[0.0, 1.0], [-1.0, 0.0]]  # convex shapes are apart along a normal of one of their sides
            one, two = quad @ across.T, other @ across.T
            assert ((one.min(axis=0) > two.max(axis=0)) | (two.min(axis=0) > one.max(axis=0))).any()


def separate_faces(location=(0.0, 0.0, 0.0)):
    ob = scenes.primitive("cube", location=location)
    for edge in ob.data.edges:
        edge.use_seam = True
    return ob


def test_objects_in_edit_mode_are_packed_together():
    one, other = separate_faces(), separate_faces((3.0, 0.0, 0.0))
    scenes.select(one, other)
    scenes.edit()
    bpy.ops.mesh.select_all(action="SELECT")
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    scenes.leave()
    assert_apart(one, other)
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}  # in Object Mode each has the square for itself
    assert_apart(one)
    np.testing.assert_array_equal(scenes.uvs(one), scenes.uvs(other))


def test_selection_and_active_object_after_edit_mode():
    edited, other, third = scenes.grid(name="Edited"), scenes.grid(name="Other"), scenes.grid(name="Third")
    scenes.select(edited)
    scenes.edit()
    other.select_set(True)
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    assert set(bpy.context.objects_in_mode) == {edited}
    assert set(bpy.context.selected_objects) == {edited, other}
    assert bpy.context.view_layer.objects.active == edited
    assert third.mode == "OBJECT"


def test_save_and_reload(tmp_path):
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    stored = scenes.shadowed(scenes.uvs(ob))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "grid.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "grid.blend"))
    assert scenes.shadowed(scenes.uvs(bpy.data.objects["Grid"])) == stored


def test_reading_in_edit_mode_makes_no_mesh_of_the_file(addon):
    """For one that comes and goes Blender draws all views again, however long that takes."""
    edit_mode, reading = (import_module(f"{addon.__name__}.{name}") for name in ("edit_mode", "mesh_reading"))
    ob = scenes.grid()
    before, meshes = scenes.uvs(ob), set(bpy.data.meshes)
    scenes.edit()
    with edit_mode.settled_mesh(ob) as mesh:
        assert set(bpy.data.meshes) == meshes and mesh != ob.data
        assert np.array_equal(reading.read_uv(mesh, "UVMap"), before)
    with edit_mode.settled_mesh(ob, in_file=True):
        assert len(bpy.data.meshes) == len(meshes) + 1
    assert set(bpy.data.meshes) == meshes

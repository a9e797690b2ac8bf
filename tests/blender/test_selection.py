"""What is taken: in the UV editor what Blender's own unwrap takes, elsewhere selected faces; nothing that is pinned."""

from __future__ import annotations

from contextlib import contextmanager

import bpy
import numpy as np
import pytest
import scenes


@contextmanager
def uv_editor():
    """A UV editor that operators see as theirs."""
    window = bpy.context.window_manager.windows[0]
    area = max(window.screen.areas, key=lambda area: area.width * area.height)
    area.type, area.ui_type = "IMAGE_EDITOR", "UV"
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        yield


def four_strips():
    """A grid cut into four islands, in Edit Mode with all faces selected; the island of every corner."""
    ob = scenes.grid(12, 8)
    scenes.mark_seams(ob, lambda a, b: a[0] == b[0] and min(abs(a[0] - x) for x in (-0.5, 0.0, 0.5)) < 1e-6)
    middle = np.array([np.mean([ob.data.vertices[v].co.x for v in p.vertices]) for p in ob.data.polygons])
    island = np.floor(2.0 * middle).astype(int) + 2
    scenes.edit()
    bpy.ops.mesh.select_all(action="SELECT")
    return ob, np.repeat(island, 4)


def select_uvs(ob, corners):
    """Select the UVs of these corners and no others."""
    import bmesh

    edited = bmesh.from_edit_mesh(ob.data)
    layer = edited.loops.layers.uv.active
    for loop, chosen in zip((loop for face in edited.faces for loop in face.loops), corners, strict=True):
        if hasattr(loop, "uv_select_vert"):
            loop.uv_select_vert = bool(chosen)
        else:
            loop[layer].select = bool(chosen)
    bmesh.update_edit_mesh(ob.data)


def changed_by(ob, operator, **options):
    """Corners whose UVs an operator of the UV editor changes; they are put back."""
    scenes.leave()
    before = scenes.uvs(ob).copy()
    scenes.edit()
    with uv_editor():
        operator(**options)
    scenes.leave()
    changed = (scenes.uvs(ob) != before).any(axis=1)
    ob.data.uv_layers.active.uv.foreach_set("vector", before.reshape(-1))
    scenes.edit()
    return changed


@pytest.mark.parametrize("sync", [False, True])
@pytest.mark.parametrize("islands", [(0,), (1, 3), (0, 1, 2, 3)])
@pytest.mark.parametrize("faces", ["all", "some"])
def test_the_uv_editor_takes_what_blenders_own_unwrap_takes(sync, islands, faces):
    ob, island = four_strips()
    bpy.context.scene.tool_settings.use_uv_select_sync = sync
    if faces == "some":
        scenes.leave()
        for polygon in ob.data.polygons:
            polygon.select = polygon.index % 12 < 9
        scenes.edit()
    select_uvs(ob, np.isin(island, islands))
    theirs = changed_by(ob, bpy.ops.uv.unwrap, method="CONFORMAL")
    ours = changed_by(ob, bpy.ops.uv.conformal_unwrap, method="LINEAR")
    assert theirs.any()
    np.testing.assert_array_equal(ours, theirs)


def test_nothing_selected_in_the_uv_editor():
    ob, island = four_strips()
    bpy.context.scene.tool_settings.use_uv_select_sync = False
    select_uvs(ob, np.zeros(len(island), dtype=bool))
    with pytest.raises(RuntimeError, match="no UV is selected"):
        changed_by(ob, bpy.ops.uv.conformal_unwrap)
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}  # not in the UV editor: faces count


def test_an_island_selected_in_part_is_left_as_it_was(addon):
    ob, island = four_strips()
    bpy.context.scene.tool_settings.use_uv_select_sync = False
    chosen = np.isin(island, (1, 2))
    chosen[np.flatnonzero(island == 2)[[0, 1]]] = False
    select_uvs(ob, chosen)
    np.testing.assert_array_equal(changed_by(ob, bpy.ops.uv.conformal_unwrap), island == 1)
    message = addon.last_result.last().message
    assert message.startswith("Unwrapped 1 of 2 islands; ") and "select whole islands" in message


def pin(ob, corners):
    name = f".pn.{ob.data.uv_layers.active.name}"
    attribute = ob.data.attributes.get(name) or ob.data.attributes.new(name, "BOOLEAN", "CORNER")
    attribute.data.foreach_set("value", np.asarray(corners, dtype=bool))


@pytest.mark.parametrize("place", ["FIT", "PACK"])
def test_islands_with_pinned_uvs_stay_as_they_are(addon, place):
    ob, island = four_strips()
    scenes.leave()
    pinned = np.zeros(len(island), dtype=bool)
    pinned[np.flatnonzero(island == 2)[5]] = True
    pin(ob, pinned)
    before = scenes.uvs(ob).copy()
    assert bpy.ops.uv.conformal_unwrap(place=place) == {"FINISHED"}
    np.testing.assert_array_equal((scenes.uvs(ob) != before).any(axis=1), island != 2)
    message = addon.last_result.last().message
    assert message.startswith("Unwrapped 3 of 4 islands; ") and "pinned UVs stay" in message
    assert bpy.ops.uv.conformal_unwrap(place=place, use_pins=True) == {"FINISHED"}  # one pin is none of three
    np.testing.assert_array_equal(scenes.uvs(ob)[island == 2], before[island == 2])
    pin(ob, np.zeros(len(island), dtype=bool))
    assert bpy.ops.uv.conformal_unwrap(place=place) == {"FINISHED"}
    assert (scenes.uvs(ob) != before).any(axis=1).all()


def test_where_all_is_pinned_nothing_changes_and_it_is_told(addon):
    ob = scenes.grid()
    pin(ob, np.ones(len(ob.data.loops)))
    before = scenes.uvs(ob).copy()
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    np.testing.assert_array_equal(scenes.uvs(ob), before)
    assert addon.last_result.last().message.startswith("Unwrapped 0 of 1 island; Grid")


def test_no_active_vertex_is_told(addon):
    scenes.grid()
    assert bpy.ops.uv.conformal_unwrap(center="ACTIVE") == {"FINISHED"}
    assert any("no vertex is active" in remark for remark in addon.last_result.last().remarks)


def test_flipped_faces_bow_ties_and_fins_are_mended(addon):
    """Where Blender's own unwrap does something, ours does not refuse."""
    flipped = scenes.grid(name="Flipped")
    flipped.data.flip_normals()
    ob = scenes.mesh_object([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], [[0, 1, 2], [0, 3, 4]], "Bow")
    against = scenes.mesh_object([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 3, 2]], "Against")
    scenes.select(flipped, ob, against)
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}
    result = addon.last_result.last()
    assert result.complete and result.unwrapped == 4
    assert any(remark.startswith("Against: ") for remark in result.remarks)

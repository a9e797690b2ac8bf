"""Conformal Slide: disks of stored UVs moved by Moebius maps, one by itself or all selected."""

from __future__ import annotations

import importlib

import bpy
import numpy as np
import pytest
import scenes

import conformal_uv as cuv


@pytest.fixture
def disk():
    """A grid mapped to the disk that fills the unit square."""
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="DISK")
    return ob


def in_disk(uv):
    return (2.0 * np.ascontiguousarray(uv, dtype=float) - 1.0).view(complex)[:, 0]


def boundary(ob):
    """Corners of the grid's boundary, (k,) bool."""
    edges = np.array([edge.vertices[:] for edge in ob.data.edges])
    sides = [key for polygon in ob.data.polygons for key in polygon.edge_keys]
    keys, count = np.unique(np.sort(np.array(sides), axis=1), axis=0, return_counts=True)
    assert len(keys) == len(edges)
    return np.isin([loop.vertex_index for loop in ob.data.loops], keys[count == 1])


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_it_is_the_librarys_moebius_map(disk, mode):
    before = in_disk(scenes.uvs(disk))
    mode()
    assert bpy.ops.uv.conformal_slide(center=(0.4, -0.3), rotation=0.7) == {"FINISHED"}
    assert bpy.context.mode == ("EDIT_MESH" if mode is scenes.edit else "OBJECT")
    scenes.leave()
    after = in_disk(scenes.uvs(disk))
    # UVs are single precision: 6e-8 in [0.5, 1), twice that in the disk, stretched by (1 + 0.5) / (1 - 0.5).
    np.testing.assert_allclose(after, cuv.Moebius.of_disk(0.4 - 0.3j, 0.7)(before), rtol=0, atol=1e-6)
    np.testing.assert_allclose(np.abs(after[boundary(disk)]), 1.0, rtol=0, atol=2e-7)
    assert np.abs(after - before).max() > 0.5


def test_the_way_back(disk):
    before = scenes.uvs(disk)
    bpy.ops.uv.conformal_slide(center=(0.4, -0.3))
    bpy.ops.uv.conformal_slide(center=(-0.4, 0.3))
    np.testing.assert_allclose(scenes.uvs(disk), before, rtol=0, atol=2e-6)


def test_nothing_is_written_where_nothing_is_asked(disk):
    before = scenes.shadowed(scenes.uvs(disk))
    assert bpy.ops.uv.conformal_slide() == {"FINISHED"}
    assert scenes.shadowed(scenes.uvs(disk)) == before


def test_other_maps_are_refused(disk):
    bpy.ops.uv.conformal_unwrap(shape="RECTANGLE")
    before = scenes.shadowed(scenes.uvs(disk))
    with pytest.raises(RuntimeError, match="no island of the active UV map is a disk"):
        bpy.ops.uv.conformal_slide(center=(0.1, 0.0))
    assert scenes.shadowed(scenes.uvs(disk)) == before


def test_only_selected_disks_or_the_one_named(disk):
    other = scenes.grid(name="Other")
    bpy.ops.uv.conformal_unwrap(shape="DISK")
    scenes.select(disk, other)
    scenes.edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="no disk is selected"):
        bpy.ops.uv.conformal_slide(center=(0.1, 0.0))
    bpy.ops.uv.conformal_slide(center=(0.1, 0.0), object_name="Other", face=5)
    scenes.leave()
    one, two = scenes.uvs(disk), scenes.uvs(other)
    assert scenes.shadowed(one) != scenes.shadowed(two)
    disk.data.polygons[0].select = True
    scenes.edit()
    bpy.ops.uv.conformal_slide(center=(0.1, 0.0))
    scenes.leave()
    assert scenes.shadowed(scenes.uvs(disk)) == scenes.shadowed(two)
    assert scenes.shadowed(scenes.uvs(other)) == scenes.shadowed(two)


def test_hidden_faces_part_islands_and_stay(disk):
    hide = np.zeros(len(disk.data.polygons), dtype=bool)
    hide[:3] = True
    disk.data.polygons.foreach_set("hide", hide)
    before = scenes.shadowed(scenes.uvs(disk))
    with pytest.raises(RuntimeError, match="no island"):  # what is left is no disk any more
        bpy.ops.uv.conformal_slide(center=(0.1, 0.0))
    assert scenes.shadowed(scenes.uvs(disk)) == before


def test_a_disk_on_an_image_that_is_not_square(disk):
    scenes.leave()
    image = bpy.data.images.new("Wide", 256, 64)
    material = bpy.data.materials.new("Wide")
    material.use_nodes = True  # the only way before 5.0
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
    disk.data.materials.append(material)
    bpy.ops.uv.conformal_unwrap(shape="DISK")
    before = (scenes.uvs(disk).astype(float) - 0.5) * [8.0, 2.0]
    bpy.ops.uv.conformal_slide(center=(0.2, 0.1))
    after = (scenes.uvs(disk).astype(float) - 0.5) * [8.0, 2.0]
    expected = cuv.Moebius.of_disk(0.2 + 0.1j)(before.view(complex)[:, 0])
    np.testing.assert_allclose(after.view(complex)[:, 0], expected, rtol=0, atol=3e-6)


def test_folds_are_told(disk, capfd):
    bpy.ops.uv.conformal_slide(center=(0.1, 0.0))
    assert "flipped" not in capfd.readouterr().out
    bpy.ops.uv.conformal_slide(center=(0.9995, 0.0))
    assert "flipped or collapsed now" in capfd.readouterr().out


def test_undo_and_redo_are_exact(disk):
    bpy.ops.ed.undo_push(message="before")
    before = scenes.shadowed(scenes.uvs(disk))
    bpy.ops.uv.conformal_slide("EXEC_DEFAULT", True, center=(0.4, -0.3))
    after = scenes.shadowed(scenes.uvs(bpy.data.objects["Grid"]))
    bpy.ops.ed.undo()
    assert scenes.shadowed(scenes.uvs(bpy.data.objects["Grid"])) == before
    bpy.ops.ed.redo()
    assert scenes.shadowed(scenes.uvs(bpy.data.objects["Grid"])) == after != before


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
@pytest.mark.parametrize("restored", [True, False])
def test_live_uvs_put_everything_back(addon, disk, mode, restored):
    live_uvs = importlib.import_module(f"{addon.__name__}.live_uvs")
    odd = scenes.uvs(disk)
    odd[3] = [np.nan, -0.0]
    disk.data.uv_layers.active.uv.foreach_set("vector", odd.reshape(-1))
    select = np.arange(len(disk.data.polygons)) % 3 == 0
    disk.data.polygons.foreach_set("select", select)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    before = scenes.shadowed(scenes.uvs(disk))
    mode()
    live = live_uvs.LiveUVs(bpy.context, [disk])
    assert bpy.context.mode == "OBJECT"
    for step in range(3):
        live.values[disk][:] = step
        live.show(disk)
        assert (scenes.uvs(disk) == step).all()
    (live.restore if restored else live.keep)()
    assert bpy.context.mode == ("EDIT_MESH" if mode is scenes.edit else "OBJECT")
    scenes.leave()
    assert (scenes.shadowed(scenes.uvs(disk)) == before) == restored
    assert [polygon.select for polygon in disk.data.polygons] == select.tolist()


@pytest.fixture
def slide(addon):
    return importlib.import_module(f"{addon.__name__}.slide").Slide()


def test_what_is_dragged_follows_the_mouse(slide):
    grip = 0.3 + 0.2j
    lies_there = complex(slide.moebius.inverse()(grip))
    slide.grip_at(grip)
    for step in (0.1j, -0.5, 0.05 - 0.02j):
        slide.drag(step)
        grip += step
        assert abs(complex(slide.moebius(lies_there)) - grip) < 1e-12
    again = cuv.Moebius.of_disk(slide.center, slide.rotation)
    assert abs(complex(again(lies_there)) - grip) < 1e-12  # what the redo panel makes of it


def test_a_drag_does_not_depend_on_its_way(slide):
    slide.grip_at(0.2)
    for step in (0.5j, 3.0, -2.9, -0.4j):  # out of the disk and back
        slide.drag(step)
    assert abs(slide.center - complex(cuv.Moebius.disk_translation(0.2, 0.3 + 0.1j)(0.0))) < 1e-12


def test_wheel_and_numbers_between_drags(slide):
    slide.grip_at(0.0)
    slide.drag(0.3)
    slide.turn(4.0)
    assert slide.center == pytest.approx(0.3) and slide.rotation == pytest.approx(4.0)
    slide.drag(0.1j)
    assert abs(slide.grip - (0.3 + 0.1j)) < 1e-12
    assert slide.rotation == pytest.approx(4.0, abs=0.2)  # goes on counting beyond half a turn
    slide.put("rotation", 30.0)
    slide.put("x", 0.25)
    slide.put("y", -0.5)
    assert slide.center == 0.25 - 0.5j and slide.rotation == pytest.approx(np.pi / 6)
    slide.put("x", 7.0)
    assert abs(slide.center) < 1.0


def test_typed_numbers(addon):
    typed = importlib.import_module(f"{addon.__name__}.typed_numbers").TypedNumbers(("rotation", "x", "y"))
    for key, character in (("ONE", "1"), ("TWO", "2"), ("PERIOD", "."), ("FIVE", "5"), ("MINUS", "-")):
        assert typed.take(key, character)
    assert typed.value == -12.5 and typed.shown("rotation", 0.0) == "[-12.5|]" and typed.shown("x", 0.5) == "0.500"
    assert typed.take("MINUS", "-") and typed.take("BACK_SPACE", "") and typed.value == 12.0
    assert typed.take("TAB", "") and typed.field == "x" and typed.value is None
    assert typed.take("Y", "y") and typed.field == "y"
    assert typed.take("COMMA", ",") and typed.value is None and typed.take("FOUR", "4") and typed.value == 0.4
    assert typed.take("R", "r") and typed.field == "rotation"
    assert not typed.take("Q", "q") and not typed.take("LEFTMOUSE", "")


def test_menu_tools_and_keys_come_and_go(addon):
    tools = importlib.import_module(f"{addon.__name__}.live_tools")
    names = [operator.bl_idname for operator in tools.OPERATORS]
    assert names == ["uv.conformal_slide", "uv.conformal_live", "uv.conformal_sphere_slide"]
    for tool in tools.TOOLS:
        with open(f"{tool.bl_icon}.dat", "rb") as stored:
            assert stored.read(4) == b"VCO\0"

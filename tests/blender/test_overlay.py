"""The overlay: numbers and colours on the mesh, and all as before once it is off."""

from __future__ import annotations

import bpy
import measured
import numpy as np
import pytest
import scenes


def values(ob, name, field="value", width=1):
    data = ob.data.attributes[name].data
    found = np.empty(width * len(data), dtype=np.float32)
    data.foreach_get(field, found)
    return found if width == 1 else found.reshape(-1, width)


@pytest.fixture
def stretched():
    """A flat grid whose UVs are its x, y with the right half three times as wide."""
    ob = scenes.grid(10, 4, 0.0)
    P = measured.positions(ob)
    uv = np.column_stack((np.where(P[:, 0] > 0.0, 3.0, 1.0) * P[:, 0], P[:, 1])).astype(np.float32)
    ob.data.uv_layers.active.uv.foreach_set("vector", uv.reshape(-1))
    return ob


def right_half(ob):
    return np.array([polygon.center.x > 0.0 for polygon in ob.data.polygons])


def test_numbers_are_those_of_the_map(stretched):
    before = set(stretched.data.attributes.keys())
    assert bpy.ops.view3d.conformal_overlay(quantity="AREA", most_area=4.0) == {"FINISHED"}
    right = right_half(stretched)
    scale, angle = values(stretched, "conformal_area_scale"), values(stretched, "conformal_angle_error")
    np.testing.assert_allclose(scale[right], 1.5, rtol=1e-4)  # 3 and 1 over a mean of 2
    np.testing.assert_allclose(scale[~right], 0.5, rtol=1e-4)
    assert angle[~right].max() < 1e-3 and angle[right].min() > 10.0
    corners = measured.triangles(stretched)
    uv = scenes.uvs(stretched).astype(float)
    error = np.abs(measured.angles(uv, corners) - measured.angles(measured.positions(stretched), corners)).mean()
    assert angle.mean() == pytest.approx(error, rel=1e-3)
    assert stretched.data.color_attributes.active_color.name == "conformal_distortion"
    assert set(stretched.data.attributes.keys()) - before == {
        "conformal_area_scale",
        "conformal_angle_error",
        "conformal_distortion",
    }


def test_colours_tell_more_from_less(stretched):
    bpy.ops.view3d.conformal_overlay(quantity="AREA")
    corner = np.repeat(right_half(stretched), 4)
    color = values(stretched, "conformal_distortion", "color_srgb", 4)
    red, blue = color[:, 0], color[:, 2]
    assert (red[corner] > blue[corner] + 0.1).all() and (blue[~corner] > red[~corner] + 0.1).all()
    bpy.ops.view3d.conformal_overlay(quantity="ANGLE")
    color = values(stretched, "conformal_distortion", "color_srgb", 4)
    np.testing.assert_allclose(
        color[~corner], np.tile([0x44 / 255, 1 / 255, 0x54 / 255, 1], ((~corner).sum(), 1)), atol=0.01
    )
    assert (color[corner, 1] > 0.4).all() and (color[:, 3] == 1.0).all()
    bpy.ops.view3d.conformal_overlay(quantity="ANGLE", most_angle=1.0)
    color = values(stretched, "conformal_distortion", "color_srgb", 4)
    np.testing.assert_allclose(color[corner, :3], np.tile([0xFD, 0xE7, 0x25], (corner.sum(), 1)) / 255, atol=0.01)


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_off_leaves_everything_as_it_was(stretched, mode):
    mesh = stretched.data
    mesh.color_attributes.new("Painted", "BYTE_COLOR", "CORNER")
    mesh.color_attributes.new("Other", "BYTE_COLOR", "CORNER")
    mesh.color_attributes.active_color = mesh.color_attributes["Painted"]
    names, uv = list(mesh.attributes.keys()), scenes.shadowed(scenes.uvs(stretched))
    mode()
    for quantity in ("ANGLE", "AREA", "NONE"):
        assert bpy.ops.view3d.conformal_overlay(quantity=quantity) == {"FINISHED"}
    assert stretched.mode == ("EDIT" if mode is scenes.edit else "OBJECT")
    scenes.leave()
    found = list(mesh.attributes.keys())
    assert {name for name in found if name[0] != "."} == {name for name in names if name[0] != "."}
    assert mesh.color_attributes.active_color.name == "Painted" and not mesh.keys()
    assert scenes.shadowed(scenes.uvs(stretched)) == uv


def test_views_show_it_and_what_they_showed_before(addon, stretched):
    """In bpy there is a window without a picture; its screens have 3D views all the same."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    views = [area.spaces.active.shading for area in bpy.context.screen.areas if area.type == "VIEW_3D"]
    if not views:
        pytest.skip("no 3D view here")
    views[0].color_type = "RANDOM"
    scenes.grid()
    bpy.ops.view3d.conformal_overlay(quantity="ANGLE")
    bpy.ops.view3d.conformal_overlay(quantity="AREA")
    assert views[0].color_type == "VERTEX"
    bpy.ops.view3d.conformal_overlay(quantity="NONE")
    assert views[0].color_type == "RANDOM"


def test_nothing_to_show_is_told(stretched):
    stretched.data.uv_layers.remove(stretched.data.uv_layers[0])
    with pytest.raises(RuntimeError, match="No selected mesh has faces and a UV map"):
        bpy.ops.view3d.conformal_overlay()
    stretched.select_set(False)
    with pytest.raises(RuntimeError, match="Select a mesh object"):
        bpy.ops.view3d.conformal_overlay()

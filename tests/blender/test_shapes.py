"""Shapes of islands: the same as conformal_uv.unwrap gives, their menus, corners, packing and kept work."""

from __future__ import annotations

import bpy
import measured
import numpy as np
import pytest
import scenes

import conformal_uv as cuv

FLOAT32 = 3e-7
CORNERS = [3, 12, 120, 126]  # of a grid of 12 x 9 quads, on its boundary and not where it turns most


def expected(ob, **options):
    """A chart alone, in the middle of the square that its box fills."""
    return 0.5 + 0.5 * cuv.unwrap(*scenes.arrays(ob), seams=scenes.seams(ob), place="disk", **options).uv


def check(ob, **options):
    np.testing.assert_allclose(scenes.uvs(ob), expected(ob, **options), atol=FLOAT32)


def corners_of_rectangle(ob):
    """The vertices at the corners of the box around the UVs."""
    uv = scenes.uvs(ob).astype(float)
    low, high = uv.min(axis=0), uv.max(axis=0)
    at = [np.hypot(*(uv - low - (high - low) * corner).T) for corner in ((0, 0), (1, 0), (1, 1), (0, 1))]
    assert max(distance.min() for distance in at) < 1e-6
    return {ob.data.loops[int(np.argmin(distance))].vertex_index for distance in at}


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
@pytest.mark.parametrize("shape", ["DISK", "FREE", "RECTANGLE"])
def test_shapes_are_the_librarys(shape, mode):
    ob = scenes.grid()
    mode()
    for options in ({}, {"upright": "Y"}, {"upright": "NONE", "rotation": 0.3}):
        assert bpy.ops.uv.conformal_unwrap(shape=shape, **options) == {"FINISHED"}
        scenes.leave()
        check(ob, shape=shape.lower(), **{"upright": options.get("upright", "Z").lower()} | without(options))
        mode()


def without(options):
    return {name: value for name, value in options.items() if name != "upright"}


def test_refine_and_the_choice_of_corners():
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="FREE", refine=True)
    check(ob, shape="free", refine=True)
    bpy.ops.uv.conformal_unwrap(shape="RECTANGLE", corner_choice="AREA")
    check(ob, shape="rectangle", corner_choice="area")


def test_choices_are_the_librarys():
    from conformal_uv.options import CornerChoice, Method, Shape, Upright

    properties = bpy.ops.uv.conformal_unwrap.get_rna_type().properties
    for name, kind in (("shape", Shape), ("upright", Upright), ("corner_choice", CornerChoice), ("method", Method)):
        assert {item.identifier for item in properties[name].enum_items} == {choice.name for choice in kind}
        assert all(item.description for item in properties[name].enum_items)
    assert properties["shape"].default == "DISK" and properties["upright"].default == "Z"


class Layout:
    """What draws into a menu or panel uses of a layout; tells properties, and operators with their shapes."""

    def __init__(self):
        self.told, self.shape = [], None

    def operator(self, name, text="", **_):
        entry = Layout()
        self.told.append((name, text, entry))
        return entry

    def prop(self, owner, name):
        self.told.append(name)

    def column(self, **_):
        return self

    def separator(self, **_):
        pass


class Shown:
    def __init__(self, **values):
        self.layout = Layout()
        self.__dict__.update(values)


def test_menus_name_the_shapes(addon):
    for draw in (addon.menus.draw, addon.menus.draw_for_objects):
        menu = Shown()
        draw(menu, bpy.context)
        told = [(text, entry.shape) for name, text, entry in menu.layout.told if name == "uv.conformal_unwrap"]
        assert told[:2] == [("Conformal Unwrap", "FREE"), ("Conformal Disk Unwrap", "DISK")]
        assert told[2:] == [("Conformal Rectangle Unwrap", "RECTANGLE")]


@pytest.mark.parametrize(
    ("shape", "own"),
    [
        ("DISK", {"method", "center", "use_pins"}),
        ("FREE", {"refine", "use_pins"}),
        ("RECTANGLE", {"corner_choice", "use_pins"}),
    ],
)
def test_the_redo_panel_shows_what_means_something(addon, shape, own):
    shown = Shown(shape=shape, margin_method="FRACTION")
    addon.operators.UV_OT_conformal_unwrap.draw(shown, bpy.context)
    special = {"method", "center", "use_pins", "refine", "corner_choice"}
    assert shown.layout.told[0] == "shape"
    assert set(shown.layout.told) & special == own
    assert {"upright", "rotation", "place", "margin", "faces", "closed", "uv_layer"} <= set(shown.layout.told)
    assert "image_size" not in shown.layout.told
    shown = Shown(shape=shape, margin_method="PIXELS")
    addon.operators.UV_OT_conformal_unwrap.draw(shown, bpy.context)
    assert "image_size" in shown.layout.told


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_other_shapes_ask_the_same_factorization(addon, factorizations, monkeypatch, mode):
    import conformal_uv.charts.unwrapper as unwrapper

    split = []
    whole = unwrapper.split_into_charts
    monkeypatch.setattr(unwrapper, "split_into_charts", lambda *given: split.append(given) or whole(*given))
    scenes.grid()
    mode()
    for shape in ("DISK", "FREE", "DISK"):
        bpy.ops.uv.conformal_unwrap(shape=shape)
        bpy.ops.uv.conformal_unwrap(shape=shape, upright="NONE")
    bpy.ops.uv.conformal_unwrap(shape="FREE", refine=True)
    assert len(factorizations) == 1 and len(split) == 1
    bpy.ops.uv.conformal_unwrap(shape="RECTANGLE")  # its sides are free: two problems of its own, solved once
    assert len(factorizations) == 3
    for options in ({"shape": "FREE"}, {"shape": "DISK"}, {"shape": "RECTANGLE"}):
        bpy.ops.uv.conformal_unwrap(**options)
    assert len(factorizations) == 3 and len(split) == 1


def test_what_means_nothing_for_a_shape_changes_nothing(addon, monkeypatch):
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    before = scenes.shadowed(scenes.uvs(ob))
    monkeypatch.setattr(cuv.Unwrapper, "unwrap", None)  # the kept result answers
    for options in ({"method": "NEWTON"}, {"center": "ACTIVE"}, {"use_pins": True}, {"corner_choice": "AREA"}):
        assert bpy.ops.uv.conformal_unwrap(shape="FREE", **options) == {"FINISHED"}
        assert scenes.shadowed(scenes.uvs(ob)) == before
        assert addon.last_result.last().remarks == []


def test_four_pins_are_the_corners(addon):
    ob = scenes.grid()
    scenes.pin(ob, CORNERS)
    before = scenes.shadowed(scenes.uvs(ob))
    assert bpy.ops.uv.conformal_unwrap(shape="RECTANGLE") == {"FINISHED"}  # pinned, and not to be used
    assert scenes.shadowed(scenes.uvs(ob)) == before
    assert "pin four on the boundary" in addon.last_result.last().message
    assert bpy.ops.uv.conformal_unwrap(shape="RECTANGLE", use_pins=True) == {"FINISHED"}
    assert corners_of_rectangle(ob) == set(CORNERS)
    assert not any("pin" in remark for remark in addon.last_result.last().remarks)
    assert abs(measured.tilt(ob, 1)) < 46.0  # upright, by quarters
    before = scenes.shadowed(scenes.uvs(ob))
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    assert scenes.shadowed(scenes.uvs(ob)) == before  # pinned, and not to be used
    assert "pin two or more and turn on Use Pins" in addon.last_result.last().message


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_four_selected_vertices_are_the_corners(addon, mode):
    ob = scenes.grid()
    scenes.select_vertices(ob, CORNERS)
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    mode()
    assert bpy.ops.uv.conformal_unwrap(shape="RECTANGLE", use_pins=True) == {"FINISHED"}
    scenes.leave()
    assert corners_of_rectangle(ob) == set(CORNERS)
    assert not any("pin" in remark for remark in addon.last_result.last().remarks)


def test_where_corners_are_not_given_it_is_told(addon):
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="RECTANGLE", use_pins=True)
    assert "Grid: no pin and no selected vertex gives corners" in addon.last_result.last().remarks[0]
    assert corners_of_rectangle(ob) == {0, 12, 117, 129}
    scenes.select_vertices(ob, CORNERS[:3])
    bpy.ops.uv.conformal_unwrap(shape="RECTANGLE", use_pins=True)
    (remark,) = addon.last_result.last().remarks
    assert remark == "Grid: not pinned: of its pins 3, 12, 120, 3 are on its boundary, not four"
    assert corners_of_rectangle(ob) == {0, 12, 117, 129}


def test_vertices_alone_in_edit_mode(addon):
    """Without the option nothing is done, and what helps is told."""
    ob = scenes.grid()
    scenes.select_vertices(ob, CORNERS)
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    scenes.edit()
    with pytest.raises(RuntimeError, match="no visible face is selected; turn on Use Pins"):
        bpy.ops.uv.conformal_unwrap(shape="RECTANGLE")
    assert addon.last_result.last().tried  # the redo panel opens
    with pytest.raises(RuntimeError, match="no visible face is selected$|no visible face is selected\n"):
        bpy.ops.uv.conformal_unwrap(shape="FREE")
    assert not addon.last_result.last().tried


@pytest.mark.parametrize("place", ["FIT", "PACK"])
@pytest.mark.parametrize("shape", ["DISK", "FREE", "RECTANGLE"])
def test_islands_alone_and_together(addon, shape, place):
    """One fills the square by its box; several keep their areas in proportion and lie apart."""
    small, large = scenes.grid(name="Small"), scenes.grid(7, 12, name="Large")
    large.data.transform(__import__("mathutils").Matrix.Scale(2.0, 4))
    scenes.select(small)
    bpy.ops.uv.conformal_unwrap(shape=shape, place=place, margin=0.0)
    assert np.ptp(scenes.uvs(small), axis=0).max() == pytest.approx(1.0, abs=0.01)
    scenes.select(small, large)
    scenes.edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.conformal_unwrap(shape=shape, place=place, margin=0.01)
    scenes.leave()
    shares = [area(scenes.uvs(ob).astype(float), ob) / surface(ob) for ob in (small, large)]
    assert shares[0] == pytest.approx(shares[1], rel=0.01)
    both = np.concatenate([scenes.uvs(ob) for ob in (small, large)])
    assert both.min() >= -1e-6 and both.max() <= 1.0 + 1e-6
    assert nearest(small, large) > 0.005
    told = [dict(addon.panel.rows(ob))["Texture covered"] for ob in addon.last_result.last().objects]
    covered = [area(scenes.uvs(ob).astype(float), ob) for ob in (small, large)]
    assert told == [f"{100.0 * part:.0f} %" for part in covered] and sum(covered) > 0.4
    found = [ob["coverage"] for ob in addon.last_result.last().as_dict()["objects"]]
    assert found == pytest.approx(covered, abs=1e-6)


def area(points, ob):
    """Of a mesh's triangles with these points (k, 2) at its corners."""
    P = points[measured.triangles(ob)]
    return 0.5 * float(np.abs(np.linalg.det(P[:, 1:] - P[:, :1])).sum())


def surface(ob):
    P = measured.positions(ob)[measured.triangles(ob)]
    return 0.5 * float(np.linalg.norm(np.cross(P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]), axis=1).sum())


def nearest(one, other):
    """Between UVs of two objects."""
    return float(np.linalg.norm(scenes.uvs(one)[:, None] - scenes.uvs(other)[None], axis=2).min())


def test_free_islands_fit_into_each_others_bays(addon):
    """L-shaped plates of three unit squares: two of them in a box of 2 x 3, and by boxes in no less than 2 x 4."""
    for name in ("One", "Other"):
        V = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0], [1, 2, 0], [0, 2, 0], [1, 0, 0], [0, 1, 0]]
        ob = scenes.mesh_object(V, [[0, 6, 3, 7], [6, 1, 2, 3], [7, 3, 4, 5]], name)
    ob.data.transform(__import__("mathutils").Matrix.Rotation(np.pi, 4, "Z"))
    scenes.select(*bpy.data.objects)
    for place in ("FIT", "PACK"):
        scenes.edit()
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.conformal_unwrap(shape="FREE", place=place, upright="NONE", margin=0.002)
        scenes.leave()
        covered = sum(area(scenes.uvs(ob).astype(float), ob) for ob in bpy.data.objects)
        assert covered > 6.0 / 16.0 + 0.05, place

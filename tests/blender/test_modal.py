"""The live tools under the mouse: drags, wheel, typed numbers, Esc; driven without a window."""

from __future__ import annotations

import importlib

import bpy
import numpy as np
import pytest
import scenes
import windowless

MIDDLE = (0.5, 0.5)


@pytest.fixture(params=[scenes.leave, scenes.edit], ids=["object", "edit"])
def mode(request):
    return request.param


@pytest.fixture
def tools(addon, monkeypatch):
    overlay = importlib.import_module(f"{addon.__name__}.uv_overlay")
    monkeypatch.setattr(overlay, "UVOverlay", windowless.Overlay)
    monkeypatch.setattr(overlay, "line_pairs", lambda sides: sides)
    windowless.Overlay.drawn.clear()
    return importlib.import_module(f"{addon.__name__}.live_tools")


@pytest.fixture
def slide(tools, mode):
    scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="DISK")
    mode()
    return windowless.Driven(tools.UV_OT_conformal_slide)


@pytest.fixture
def live(tools, mode):
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    scenes.pin(ob, [0, 12, 129])
    mode()
    return windowless.Driven(tools.UV_OT_conformal_live)


def stored():
    """UVs, and the mode that it was."""
    ob, mode = bpy.data.objects["Grid"], bpy.context.mode
    scenes.leave()
    uv = scenes.uvs(ob)
    if mode == "EDIT_MESH":
        scenes.edit()
    return uv


def assert_ended(operator, mode):
    assert bpy.context.mode == ("EDIT_MESH" if mode is scenes.edit else "OBJECT")
    assert [overlay.removed for overlay in windowless.Overlay.drawn] == [True]
    assert operator.headers[-1] is None


def again(name, operator, before):
    """UVs that the operator's execute makes of the properties left by its modal."""
    scenes.leave()
    bpy.data.objects["Grid"].data.uv_layers.active.uv.foreach_set("vector", before.reshape(-1))
    assert getattr(bpy.ops.uv, name)(**operator.properties()) == {"FINISHED"}
    return scenes.uvs(bpy.data.objects["Grid"])


def test_a_slide_confirmed_is_what_execute_does(slide, mode):
    before = stored()
    assert slide.press(at=MIDDLE) == {"RUNNING_MODAL"}
    slide.move(MIDDLE, (0.6, 0.5), (0.65, 0.55))
    assert bpy.context.mode == "OBJECT"
    assert slide.press(at=(0.65, 0.55), value="RELEASE") == {"FINISHED"}
    np.testing.assert_allclose(slide.center, (0.3, 0.1), atol=1e-6)
    assert slide.rotation == pytest.approx(0.0, abs=1e-6)
    after = stored()
    assert_ended(slide, mode)
    # Properties are single precision as UVs are.
    np.testing.assert_allclose(again("conformal_slide", slide, before), after, rtol=0, atol=1e-6)
    assert np.abs(after - before).max() > 0.1


@pytest.mark.parametrize("key", ["ESC", "RIGHTMOUSE"])
def test_a_slide_cancelled_restores_every_bit(slide, mode, key):
    before = scenes.shadowed(stored())
    slide.press(at=(0.3, 0.4))
    slide.move((0.3, 0.4), (0.6, 0.5), (2.0, 2.0))
    slide.press("WHEELUPMOUSE")
    assert slide.press(key) == {"CANCELLED"}
    assert scenes.shadowed(stored()) == before
    assert_ended(slide, mode)
    assert slide.told == ["Cancelled; nothing was changed"]


def test_wheel_shift_and_typed_numbers(slide):
    slide.press("S", at=MIDDLE)  # by a key: no button is held
    slide.press("WHEELUPMOUSE")
    slide.press("WHEELDOWNMOUSE", shift=True)
    slide.move(MIDDLE)
    slide.move((0.7, 0.5), shift=True)
    assert "Rotation 4.5°   X 0.040" in slide.headers[-1]
    for key, character in (("R", "r"), ("THREE", "3"), ("ZERO", "0"), ("TAB", ""), ("PERIOD", "."), ("TWO", "2")):
        assert slide.press(key, ascii=character) == {"RUNNING_MODAL"}
    assert "Rotation 30.0°   X [.2|]" in slide.headers[-1]
    assert slide.press(value="RELEASE") == {"RUNNING_MODAL"}
    assert slide.press("RET") == {"FINISHED"}
    assert slide.center[0] == pytest.approx(0.2) and slide.rotation == pytest.approx(np.pi / 6)


def test_the_view_moves_while_a_tool_runs(slide):
    slide.press("S", at=MIDDLE)
    assert slide.press("MIDDLEMOUSE") == {"PASS_THROUGH"}
    assert slide.press("WHEELUPMOUSE", ctrl=True) == {"PASS_THROUGH"}
    assert slide.press("Z", ascii="z") == {"RUNNING_MODAL"}
    slide.press("ESC")


def test_nothing_to_slide_is_told(tools, slide):
    scenes.leave()
    bpy.ops.uv.conformal_unwrap(shape="RECTANGLE")
    for key in ("LEFTMOUSE", "S"):
        assert slide.press(key, at=MIDDLE) == {"CANCELLED"}
        assert "no island of the active UV map is a disk" in slide.told.pop()
    sphere = windowless.Driven(tools.UV_OT_conformal_sphere_slide)
    assert sphere.press(at=MIDDLE) == {"CANCELLED"}
    assert "is a disk" in sphere.told[0] and "no shape key" in sphere.told[0]


def test_drags_of_pins_are_what_execute_does(live, mode):
    before = stored()
    pins = before[[0, 11 * 4 + 1]].astype(float)  # the first corner, and one at the first row's end
    assert live.press("L", at=MIDDLE) == {"RUNNING_MODAL"}  # from the menu
    for pin in pins:
        live.press(at=pin + 0.004)
        live.move(pin, pin + [0.05, -0.08], pin + [0.1, 0.1])
        assert live.press(value="RELEASE") == {"RUNNING_MODAL"}
    live.move((0.9, 0.9))  # no pin is held
    assert "Free, 3 pins" in live.headers[-1]
    assert live.press("RET") == {"FINISHED"}
    after = stored()
    assert_ended(live, mode)
    np.testing.assert_allclose(after[[0, 45]], pins + 0.1, rtol=0, atol=1e-6)
    np.testing.assert_allclose(again("conformal_live", live, before), after, rtol=0, atol=1e-6)


@pytest.mark.parametrize("key", ["ESC", "RIGHTMOUSE"])
def test_drags_cancelled_restore_every_bit(live, mode, key):
    before = stored()
    assert live.press(at=before[0]) == {"RUNNING_MODAL"}
    live.move(before[0], (0.4, 0.4))
    assert live.press(key) == {"CANCELLED"}
    assert scenes.shadowed(stored()) == scenes.shadowed(before)
    assert_ended(live, mode)


def test_by_the_tool_one_drag_is_one_step(live):
    before = stored()
    assert live.press(at=before[0]) == {"RUNNING_MODAL"}
    live.move(before[0], (0.4, 0.4))
    assert live.press(value="RELEASE") == {"FINISHED"}
    assert live.told == ["Mapped 1 island from pins"] or "flipped" in live.told[0]


def test_a_click_changes_nothing(live, mode):
    before = stored()
    live.press(at=before[0])
    assert live.press(value="RELEASE") == {"CANCELLED"}
    assert scenes.shadowed(stored()) == scenes.shadowed(before)
    assert_ended(live, mode)


def test_a_press_far_from_handles_is_told(live, mode):
    if mode is scenes.edit:
        bpy.ops.mesh.select_all(action="DESELECT")
    before = stored()
    assert live.press(at=MIDDLE) == {"CANCELLED"}
    assert "to drag" in live.told[0]
    assert scenes.shadowed(stored()) == scenes.shadowed(before)


def test_the_tool_slides_what_there_is_whichever_operator_is_asked_first(tools, slide):
    sphere = windowless.Driven(tools.UV_OT_conformal_sphere_slide)
    assert sphere.press(at=MIDDLE) == {"PASS_THROUGH"}  # a disk is there
    sphere._running = False
    assert sphere.told == []
    scenes.leave()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
    bpy.ops.object.conformal_sphere(uv="EQUIRECTANGULAR")
    scenes.select(bpy.context.object)
    assert slide.press(at=MIDDLE) == {"PASS_THROUGH"}
    slide._running = False
    assert slide.told == []
    assert sphere.press(at=MIDDLE) == {"RUNNING_MODAL"}
    sphere.press("ESC")

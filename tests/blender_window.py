"""The add-on in a window of Blender's: what invoke and modal do, driven by simulated events.

    blender --factory-startup --enable-event-simulate --python tests/blender_window.py -- REPORT.json

Every function named case_... is a generator that yields where Blender's main loop is to go on, and asserts what must
hold. The report says for each "" or its traceback. tests/test_blender_window.py runs this.
"""

from __future__ import annotations

import json
import os
import sys
import time
import traceback
from importlib import import_module
from pathlib import Path

import bpy
import numpy as np

REPOSITORY = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(REPOSITORY), str(REPOSITORY / "tests" / "blender")]

import scenes  # noqa: E402

MODULE = os.environ.get("CONFORMAL_UV_BLENDER_MODULE", "blender_addon")
TURN = 0.05  # seconds between two steps of a case
PATIENCE = 120.0
LARGE = (330, 310)  # faces enough for a thread


def part(name):
    """A module of the add-on."""
    return import_module(f"{MODULE}.{name}")


def window():
    return bpy.context.window_manager.windows[0]


def view():
    """Area and region of the 3D view, as a context to override."""
    area = max((a for a in window().screen.areas if a.type == "VIEW_3D"), key=lambda a: a.width * a.height)
    region = next(r for r in area.regions if r.type == "WINDOW")
    return {"window": window(), "screen": window().screen, "area": area, "region": region}


def invoke(operator, **options):
    with bpy.context.temp_override(**view()):
        return operator("INVOKE_DEFAULT", True, **options)


def middle():
    region = view()["region"]
    return region.x + region.width // 2, region.y + region.height // 2


def press(key, **modifiers):
    x, y = middle()
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type=key, value=value, x=x, y=y, **modifiers)


def until(done, what):
    """Go on until something holds."""
    begun = time.monotonic()
    while not done():
        assert time.monotonic() - begun < PATIENCE, f"waited in vain: {what}"
        yield


def turns(count=8):
    for _ in range(count):
        yield


def fresh(columns, rows):
    """A new file with a grid alone, and one undo step before everything."""
    bpy.ops.wm.read_homefile()
    yield
    for ob in list(bpy.data.objects):
        bpy.data.objects.remove(ob)
    ob = scenes.grid(columns, rows)
    undo_step()
    yield from turns()
    return ob


def undo_step():
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo_push(message="Before")


def grid_now():
    """The grid: undo may have made a new object of it."""
    return bpy.data.objects["Grid"]


def bytes_now(name="Grid"):
    """UVs, positions and shape keys of an object, and which attributes it has, in any mode."""
    ob = bpy.data.objects[name]
    with part("edit_mode").settled_mesh(ob) as mesh:
        uv = np.empty(2 * len(mesh.loops), dtype=np.float32)
        mesh.uv_layers.active.uv.foreach_get("vector", uv)
        positions = [np.empty(3 * len(mesh.vertices), dtype=np.float32)]
        mesh.vertices.foreach_get("co", positions[0])
        for key in mesh.shape_keys.key_blocks if mesh.shape_keys else ():
            positions.append(np.empty_like(positions[0]))
            key.data.foreach_get("co", positions[-1])
        names = sorted(data.name for data in mesh.attributes if not data.name.startswith("."))
    return scenes.shadowed(np.concatenate([uv, *positions])), names


def uv_editor():
    """Area and region of a UV editor that shows the unit square, made of the editor of properties."""
    areas = list(window().screen.areas)
    area = next((a for a in areas if a.ui_type == "UV"), None)
    if area is None:
        area = next(a for a in areas if a.type == "PROPERTIES")
        area.ui_type = "UV"
    region = next(r for r in area.regions if r.type == "WINDOW")
    return {"window": window(), "screen": window().screen, "area": area, "region": region}


def at(u, v):
    """Where a UV is in the window."""
    region = uv_editor()["region"]
    x, y = region.view2d.view_to_region(u, v, clip=False)
    return {"x": region.x + x, "y": region.y + y}


def in_uv_editor(operator, *given, **options):
    with bpy.context.temp_override(**uv_editor()):
        return operator(*given, **options)


def shown_uvs():
    """The UV editor with the unit square in it."""
    uv_editor()
    yield from turns()
    in_uv_editor(bpy.ops.image.view_all, fit_view=True)
    yield from turns()


def there_and_back(before, name="Grid"):
    """Undo and redo by their keys, each to the bit."""
    after = bytes_now(name)
    assert after != before
    press("Z", ctrl=True)
    yield from until(lambda: name in bpy.data.objects and bytes_now(name) == before, "undo")
    press("Z", ctrl=True, shift=True)
    yield from until(lambda: bytes_now(name) == after, "redo")


def working():
    return part("worker").under_way()


def case_preferences_give_the_first_options():
    yield from fresh(6, 5)
    yield
    assert part("operators").chosen_options(bpy.context).shape == "FREE"


def case_one_undo_step_there_and_back():
    yield from fresh(12, 9)
    before = bytes_now()
    yield
    assert invoke(bpy.ops.uv.conformal_unwrap, shape="DISK") == {"FINISHED"}
    yield from turns()
    after = bytes_now()
    assert after != before
    press("Z", ctrl=True)
    yield from until(lambda: bytes_now() == before, "undo")
    press("Z", ctrl=True, shift=True)
    yield from until(lambda: bytes_now() == after, "redo")


def case_numbers_go_stale_and_come_back():
    yield from fresh(12, 9)
    result = part("last_result")
    yield
    invoke(bpy.ops.uv.conformal_unwrap, shape="FREE")
    yield from turns()
    assert result.measured() and not result.stale()
    with bpy.context.temp_override(**view()):
        bpy.ops.object.mode_set(mode="EDIT")
        yield from turns(20)
        assert not result.stale()
        bpy.ops.transform.translate("EXEC_DEFAULT", True, value=(0.5, 0.0, 0.0))
    yield from turns()
    assert result.stale()
    press("Z", ctrl=True)
    yield from until(lambda: not result.stale(), "the numbers of before")
    press("Z", ctrl=True)
    press("Z", ctrl=True)
    yield from until(result.stale, "the unwrap itself undone")


def case_a_view_turns_while_a_thread_solves():
    yield from fresh(*LARGE)
    before = bytes_now()
    assert invoke(bpy.ops.uv.conformal_unwrap, shape="DISK", method="NEWTON") == {"RUNNING_MODAL"}
    assert working()
    try:
        bpy.ops.uv.conformal_unwrap()
    except RuntimeError as error:
        assert "under way" in str(error)
    else:
        raise AssertionError("a second one was begun")
    x, y = middle()
    rotation = view()["area"].spaces.active.region_3d.view_rotation.copy()
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    window().event_simulate(type="MIDDLEMOUSE", value="PRESS", x=x, y=y)
    yield
    for step in range(1, 3):
        window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x + 40 * step, y=y + 20 * step)
        yield
    window().event_simulate(type="MIDDLEMOUSE", value="RELEASE", x=x + 80, y=y + 40)
    yield
    turned = view()["area"].spaces.active.region_3d.view_rotation.rotation_difference(rotation).angle
    assert working(), "the thread was faster than the drag"
    assert turned > 0.05, "the view did not turn"
    assert bytes_now() == before
    yield from until(lambda: not working(), "the thread")
    yield from turns()
    assert bytes_now() != before
    yield from until(part("last_result").measured, "numbers")
    assert part("last_result").last().objects[0].quality.angle_mean < 5.0


def case_escape_leaves_all_as_it_was():
    yield from fresh(*LARGE)
    before = bytes_now()
    for operator in (bpy.ops.uv.conformal_unwrap, bpy.ops.object.conformal_sphere):
        assert invoke(operator) == {"RUNNING_MODAL"}
        yield
        press("ESC")
        yield from until(lambda: not working(), "Esc")
        yield from turns()
        assert bytes_now() == before and grid_now().data.shape_keys is None


def case_nothing_is_written_where_the_mesh_was_changed_meanwhile():
    ob = yield from fresh(*LARGE)
    assert invoke(bpy.ops.uv.conformal_unwrap) == {"RUNNING_MODAL"}
    yield
    ob.data.vertices[0].co.z += 1.0
    before = bytes_now()
    yield from until(lambda: not working(), "the thread")
    yield from turns()
    assert bytes_now() == before


def case_undo_while_a_thread_solves():
    yield from fresh(*LARGE)
    bpy.ops.mesh.primitive_cube_add()
    undo_step()
    scenes.select(grid_now())
    yield from turns()
    assert invoke(bpy.ops.uv.conformal_unwrap) == {"RUNNING_MODAL"}
    yield
    press("Z", ctrl=True)
    yield from until(lambda: not working(), "the thread")
    yield from turns()
    assert len(grid_now().data.polygons) == LARGE[0] * LARGE[1]


def case_a_sphere_by_a_thread():
    yield from fresh(4, 4)
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6)
    ob = bpy.context.object
    yield from turns()
    assert invoke(bpy.ops.object.conformal_sphere, method="LINEAR") == {"RUNNING_MODAL"}
    assert ob.data.shape_keys is None
    yield from until(lambda: not working(), "the thread")
    yield from turns()
    key = ob.data.shape_keys.key_blocks["Conformal Sphere"]
    xyz = np.empty(3 * len(key.data), dtype=np.float32)
    key.data.foreach_get("co", xyz)
    lengths = np.linalg.norm(xyz.reshape(-1, 3) - xyz.reshape(-1, 3).mean(axis=0), axis=1)
    assert lengths.std() < 0.01 * lengths.mean()


def case_the_dialog_unwraps_with_the_sidebars_options():
    yield from fresh(12, 9)
    before = bytes_now()
    chosen = part("operators").chosen_options(bpy.context)
    chosen.shape = "RECTANGLE"
    x, y = middle()
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield from turns()
    assert invoke(bpy.ops.uv.conformal_unwrap_options) == {"RUNNING_MODAL"}
    yield from turns()
    press("ESC")
    yield from turns()
    assert bytes_now() == before
    with bpy.context.temp_override(**view()):  # what the dialog's button does
        assert bpy.ops.uv.conformal_unwrap_options("EXEC_DEFAULT", True) == {"FINISHED"}
    yield from turns()
    assert bytes_now() != before
    uv = scenes.uvs(grid_now())
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * (uv.max(axis=0) - uv.min(axis=0)) + uv.min(axis=0)
    nearest = np.linalg.norm(uv[None] - corners[:, None], axis=2).min(axis=1)
    assert nearest.max() < 1e-5, "a rectangle has corners"


def dragged(operator, path, key=None, release=True, name="Grid"):
    """A tool of the UV editor run over a path of UVs, by a press of the left button, ended by it or by a key."""
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS")):
        window().event_simulate(type=kind, value=value, **at(*path[0]))
    yield from turns()
    before = bytes_now(name)
    assert in_uv_editor(operator, "INVOKE_DEFAULT", True) == {"RUNNING_MODAL"}
    yield
    for place in path:
        window().event_simulate(type="MOUSEMOVE", value="NOTHING", **at(*place))
        yield
    yield from turns()
    assert bytes_now(name) != before, "nothing follows the mouse"
    window().event_simulate(type=key or "LEFTMOUSE", value="PRESS", **at(*path[-1]))
    yield
    window().event_simulate(type=key or "LEFTMOUSE", value="RELEASE", **at(*path[-1]))
    yield from until(lambda: not window().modal_operators, "the end of the tool")
    yield from turns()


def in_mode(mode):
    with bpy.context.temp_override(**view()):
        bpy.ops.object.mode_set(mode=mode)


def slide_in(mode):
    yield from fresh(12, 9)
    invoke(bpy.ops.uv.conformal_unwrap, shape="DISK")
    yield from turns()
    in_mode(mode)
    yield from shown_uvs()
    undo_step()
    yield from turns()
    before, slide = bytes_now(), bpy.ops.uv.conformal_slide
    yield from dragged(slide, [(0.5, 0.5), (0.55, 0.5), (0.7, 0.6)], key="ESC")
    assert bytes_now() == before and not part("last_result").stale()
    yield from dragged(slide, [(0.5, 0.5), (0.55, 0.5), (0.7, 0.6)], key="RET")
    assert bpy.context.mode == ("EDIT_MESH" if mode == "EDIT" else "OBJECT")
    yield from until(part("last_result").stale, "the result's UVs are others now")
    yield from there_and_back(before)


def case_slide_in_object_mode():
    yield from slide_in("OBJECT")


def case_slide_in_edit_mode():
    yield from slide_in("EDIT")


def case_live_pins():
    ob = yield from fresh(12, 9)
    invoke(bpy.ops.uv.conformal_unwrap, shape="FREE")
    scenes.pin(ob, [0, 12])
    yield from turns()
    yield from shown_uvs()
    undo_step()
    uv = scenes.uvs(ob)[[loop.vertex_index for loop in ob.data.loops].index(12)].tolist()
    path = [uv, (uv[0] - 0.05, uv[1] + 0.05), (uv[0] - 0.2, uv[1] + 0.2)]
    before = bytes_now()
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", **at(*uv))
    yield from turns()
    assert in_uv_editor(bpy.ops.uv.conformal_live, "INVOKE_DEFAULT", True) == {"RUNNING_MODAL"}
    yield from turns()
    window().event_simulate(type="LEFTMOUSE", value="PRESS", **at(*uv))
    yield
    for place in path:
        window().event_simulate(type="MOUSEMOVE", value="NOTHING", **at(*place))
        yield
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", **at(*path[-1]))
    yield
    window().event_simulate(type="RET", value="PRESS", **at(*path[-1]))
    yield from until(lambda: not window().modal_operators, "the end of the tool")
    window().event_simulate(type="RET", value="RELEASE", **at(*path[-1]))
    yield from turns()
    yield from there_and_back(before)


def case_a_sphere_slides():
    yield from fresh(4, 4)
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
    invoke(bpy.ops.object.conformal_sphere, uv="EQUIRECTANGULAR")
    name = bpy.context.object.name
    yield from turns()
    yield from shown_uvs()
    undo_step()
    before = bytes_now(name)
    yield from dragged(bpy.ops.uv.conformal_sphere_slide, [(0.5, 0.5), (0.55, 0.5), (0.6, 0.6)], key="RET", name=name)
    yield from there_and_back(before, name)


def case_packing_overlay_and_flattening_there_and_back():
    yield from fresh(12, 9)
    invoke(bpy.ops.uv.conformal_unwrap, shape="FREE")
    yield from turns()
    for operator, options in (
        (bpy.ops.uv.conformal_pack, {"margin": 0.1}),
        (bpy.ops.view3d.conformal_overlay, {}),
        (bpy.ops.object.conformal_flatten, {"result": "SHAPE_KEY"}),
    ):
        before = bytes_now()
        assert invoke(operator, **options) == {"FINISHED"}
        yield from turns()
        yield from there_and_back(before)
    assert invoke(bpy.ops.object.conformal_flatten, result="OBJECT") == {"FINISHED"}
    yield from turns()
    assert "Grid Flat" in bpy.data.objects
    press("Z", ctrl=True)
    yield from until(lambda: "Grid Flat" not in bpy.data.objects, "undo")


def run(cases, report):
    """All cases one after the other, a step at a time from Blender's main loop."""
    results, names, current = {}, list(cases), []

    def step():
        try:
            if not current:
                if not names:
                    report.write_text(json.dumps(results, indent=1), encoding="utf-8")
                    os._exit(0)
                current.append((names[0], cases[names.pop(0)]()))
            next(current[0][1])
        except StopIteration:
            results[current.pop()[0]] = ""
        except Exception:
            results[current.pop()[0]] = traceback.format_exc()
        return TURN

    bpy.app.timers.register(step, first_interval=1.0, persistent=True)


def main():
    report = Path(sys.argv[sys.argv.index("--") + 1])
    bpy.context.preferences.view.show_splash = False
    import_module("addon_utils").enable(MODULE, default_set=True)
    wanted = os.environ.get("CONFORMAL_UV_CASES", "case_")
    run({name: case for name, case in globals().items() if name.startswith("case_") and wanted in name}, report)


if __name__ == "__main__":
    main()

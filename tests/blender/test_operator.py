"""Poll, menus, registration, redo, the thread and the panel."""

from __future__ import annotations

import json
import time
from threading import Event

import bpy
import numpy as np
import pytest
import scenes


def test_poll_says_what_to_do():
    with pytest.raises(RuntimeError, match="Select a mesh object"):
        bpy.ops.uv.conformal_unwrap()
    scenes.grid()
    bpy.ops.object.mode_set(mode="SCULPT")
    with pytest.raises(RuntimeError, match="Go to Object Mode or to Edit Mode"):
        bpy.ops.uv.conformal_unwrap()
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(RuntimeError, match="Go to Edit Mode"):
        bpy.ops.uv.conformal_select_folded()


def test_nothing_selected_in_edit_mode():
    scenes.grid()
    scenes.edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="Grid: no visible face is selected"):
        bpy.ops.uv.conformal_unwrap()


def test_an_active_vertex_outside_the_selection_is_refused():
    ob = scenes.mesh_object([[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 2, 0]], [[0, 1, 2]])
    scenes.edit()
    import bmesh

    edited = bmesh.from_edit_mesh(ob.data)
    edited.verts.ensure_lookup_table()
    edited.select_history.clear()
    edited.select_history.add(edited.verts[3])
    with pytest.raises(RuntimeError, match="Mesh: active vertex 3 belongs to no selected face"):
        bpy.ops.uv.conformal_unwrap(center="ACTIVE")


def test_operator_is_registered_with_undo():
    operator = bpy.types.UV_OT_conformal_unwrap
    assert operator.bl_label == "Conformal Unwrap"
    assert {"REGISTER", "UNDO"} <= operator.bl_options


def test_properties_are_named_as_blenders_own():
    own = set(bpy.ops.uv.unwrap.get_rna_type().properties.keys())
    ours = set(bpy.ops.uv.conformal_unwrap.get_rna_type().properties.keys())
    assert {"method", "fill_holes", "correct_aspect", "use_subsurf_data", "margin"} <= own & ours


def entries(menu):
    """The unwrap's functions among those that draw more into a menu."""
    return [draw for draw in getattr(menu.draw, "_draw_funcs", []) if draw.__module__.endswith(".menus")]


def test_menus_have_one_entry_each():
    assert len(entries(bpy.types.IMAGE_MT_uvs_unwrap)) == 1
    assert len(entries(bpy.types.VIEW3D_MT_uv_map)) == (1 if bpy.app.version < (4, 3) else 0)
    assert len(entries(bpy.types.VIEW3D_MT_object)) == 1


def test_registration_is_symmetric(addon):
    if addon.__name__ != "blender_addon":
        pytest.skip("the installed extension is registered by Blender")
    scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    addon.unregister()
    try:
        assert not hasattr(bpy.types, "UV_OT_conformal_unwrap")
        assert not hasattr(bpy.types, "UV_PT_conformal_unwrap")
        assert not entries(bpy.types.IMAGE_MT_uvs_unwrap) and not entries(bpy.types.VIEW3D_MT_object)
        assert addon.forget not in bpy.app.handlers.load_post
    finally:
        addon.register()
    assert bpy.ops.uv.conformal_unwrap() == {"FINISHED"}


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_redo_factorizes_nothing(factorizations, mode):
    scenes.grid()
    mode()
    bpy.ops.uv.conformal_unwrap()
    assert len(factorizations) == 1
    for change in (
        {"rotation": 0.4},
        {"place": "PACK"},
        {"place": "FIT", "margin": 0.1},
        {"center": "ACTIVE"},
        {"method": "LINEAR"},
        {"correct_aspect": False},
        {"uv_layer": "Other"},
    ):
        assert bpy.ops.uv.conformal_unwrap(**change) == {"FINISHED"}
    assert len(factorizations) == 1


def test_a_changed_mesh_is_factorized_anew(factorizations):
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    ob.data.vertices[30].co.z += 0.1
    bpy.ops.uv.conformal_unwrap()
    scenes.mark_seams(ob, lambda a, b: abs(a.x) < 1e-6 and abs(b.x) < 1e-6)
    bpy.ops.uv.conformal_unwrap()
    assert len(factorizations) == 4


def test_work_is_forgotten_with_the_file(addon, factorizations):
    for _ in range(2):
        scenes.grid()
        bpy.ops.uv.conformal_unwrap()
        assert addon.last_result.last() is not None
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        assert addon.last_result.last() is None
    assert len(factorizations) == 2


class Window:
    """What the worker uses of a window; background Blender has none."""

    def __init__(self):
        self.window_manager, self.workspace, self.area, self.window = self, self, self, None
        self.texts, self.headers, self.timers = [], [], 0

    def __getattr__(self, name):
        return getattr(bpy.context, name)

    def progress_begin(self, low, high):
        pass

    def progress_update(self, value):
        pass

    def progress_end(self):
        pass

    def event_timer_add(self, seconds, window):
        self.timers += 1
        return self

    def event_timer_remove(self, timer):
        self.timers -= 1

    def status_text_set(self, text):
        self.texts.append(text)

    def header_text_set(self, text):
        self.headers.append(text)


def started(addon, window):
    """A thread at the unwrap of the active object, and what takes its work over."""
    from importlib import import_module

    kept_work, properties, tasks, unwrap_objects, worker = (
        import_module(f"{addon.__name__}.{name}")
        for name in ("kept_work", "properties", "tasks", "unwrap_objects", "worker")
    )
    options, fork = properties.Options(), kept_work.KEPT.fork()
    read = tasks.gather(window, [bpy.context.object], options)
    work = worker.Worker(
        "Conformal Unwrap",
        lambda callback: unwrap_objects.solve(read, options, fork, callback=callback, backend=worker.BACKEND),
    )
    assert not worker.under_way()
    work.start(window)
    assert worker.under_way()
    return work, lambda: kept_work.KEPT.adopt(fork)


def waited(work):
    for _ in range(1000):
        if not work.running:
            return
        time.sleep(0.01)
    pytest.fail("the thread does not end")


def test_thread_leaves_its_work_for_execute(addon, factorizations):
    ob, window = scenes.grid(60, 50), Window()
    before = scenes.shadowed(scenes.uvs(ob))
    work, take_over = started(addon, window)
    waited(work)
    assert scenes.shadowed(scenes.uvs(ob)) == before
    work.finish(window)
    take_over()
    assert window.timers == 0 and window.texts[-1] is None and "Esc" in window.texts[0]
    assert window.headers == window.texts
    assert len(factorizations) == 1
    bpy.ops.uv.conformal_unwrap()
    assert len(factorizations) == 1
    assert scenes.shadowed(scenes.uvs(ob)) != before


def test_cancel_stops_the_thread_and_changes_nothing(addon, monkeypatch, factorizations):
    import conformal_uv.operators.dirichlet as dirichlet

    cancelled, counting = Event(), dirichlet.linear_solver

    def waiting(*arguments, **keywords):
        assert cancelled.wait(10.0)
        return counting(*arguments, **keywords)

    ob, window = scenes.grid(60, 50), Window()
    before = scenes.shadowed(scenes.uvs(ob))
    with monkeypatch.context() as patched:
        patched.setattr(dirichlet, "linear_solver", waiting)
        work, _ = started(addon, window)
        work.cancel(window)
        cancelled.set()
        waited(work)
    assert window.timers == 0 and window.texts[-1] is None
    assert work.fraction < 0.6  # it stopped at the first report after the factorization, if it came so far
    assert scenes.shadowed(scenes.uvs(ob)) == before
    count = len(factorizations)
    bpy.ops.uv.conformal_unwrap()
    assert len(factorizations) == count + 1


def test_select_flipped_and_collapsed():
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    uv = scenes.uvs(ob)
    uv[scenes.corners_of(ob, [17])] = 0.25
    uv[scenes.corners_of(ob, [40])] = uv[scenes.corners_of(ob, [40])][::-1]
    ob.data.uv_layers[0].uv.foreach_set("vector", uv.reshape(-1))
    scenes.edit()
    assert bpy.ops.uv.conformal_select_folded() == {"FINISHED"}
    scenes.leave()
    assert [p.index for p in ob.data.polygons if p.select] == [17, 40]


def test_panel_numbers(addon):
    scenes.grid()
    bpy.ops.uv.conformal_unwrap()
    result = addon.last_result.last()
    told = dict(addon.panel.rows(result.objects[0]))
    assert told["Islands"] == "1 of 1" and told["Flipped faces"] == "0"
    quality = result.objects[0].quality
    assert 0.0 < quality.angle_mean < quality.angle_max < 180.0
    assert quality.area_ratio > 1.0 and np.isfinite(result.seconds)
    assert json.loads(json.dumps(result.as_dict()))["objects"][0]["angle_mean"] == quality.angle_mean

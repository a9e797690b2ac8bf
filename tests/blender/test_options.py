"""Options before the first run: panels, presets, preferences, shortcuts, the manual's address."""

from __future__ import annotations

from importlib import import_module

import bpy
import pytest
import scenes


@pytest.fixture
def part(addon):
    return lambda name: import_module(f"{addon.__name__}.{name}")


class Layout:
    """Notes what is drawn: (kind, name or text)."""

    def __init__(self):
        self.drawn, self.buttons = [], []

    def __getattr__(self, name):
        def draw(*given, **named):
            told = named.get("text", given[1] if name == "prop" else given[0] if given else "")
            self.drawn.append((name, told))
            if name != "operator":
                return self
            self.buttons.append(Button())
            return self.buttons[-1]

        return draw

    def texts(self, kind):
        return [told for name, told in self.drawn if name == kind]


class Button:
    """Properties that a button gives its operator."""


@pytest.mark.parametrize("shape", ["FREE", "DISK", "RECTANGLE"])
def test_everywhere_the_same_options_are_drawn(part, shape):
    layout, chosen = Layout(), part("properties").Options(shape=shape, margin_method="PIXELS")
    part("options_layout").draw_options(layout, chosen)
    known = bpy.ops.uv.conformal_unwrap.get_rna_type().properties
    shown = layout.texts("prop")
    assert shown[0] == "shape" and len(set(shown)) == len(shown) and all(name in known for name in shown)
    every = {name for names in part("properties").SHOWN.values() for name in names} | set(shown)
    left = {name for name in known.keys() if not known[name].is_hidden and name != "rna_type"} - every
    assert not left  # an option that no panel shows
    layout = Layout()
    part("options_layout").draw_options(layout, part("properties").Options(shape=shape))
    assert set(shown) - set(layout.texts("prop")) == {"image_size"}  # margins of pixels alone have an image


def test_panels_have_the_order_of_the_menus(part):
    shapes = [identifier for identifier, _, _ in part("choices").SHAPES]
    assert shapes == [identifier for identifier, _ in part("choices").UNWRAPS]
    layout = Layout()
    part("operators").draw_unwraps(layout)
    assert layout.texts("operator")[0] == "Conformal Unwrap"
    assert [button.shape for button in layout.buttons] == shapes


def test_panels_are_in_both_editors():
    for prefix, space in (("UV", "IMAGE_EDITOR"), ("VIEW3D", "VIEW_3D")):
        for name in ("unwrap", "options", "result"):
            panel = getattr(bpy.types, f"{prefix}_PT_conformal_{name}")
            assert (panel.bl_space_type, panel.bl_region_type, panel.bl_category) == (space, "UI", "Conformal UV")


def test_what_is_searched_for_has_one_name(part):
    names = [text for _, text in part("choices").UNWRAPS]
    names += [getattr(bpy.types, name).bl_label for name in dir(bpy.types) if "_OT_conformal_" in name]
    assert len(set(names)) == len(names) - 1  # the free shape's entry is the operator itself


def described_twice(prop):
    return prop.is_hidden or prop.identifier == "rna_type" or prop.description.count("\n") == 1


def test_tooltips_say_what_and_when(part):
    for name in dir(bpy.types):
        if "_OT_conformal_" in name:
            operator = getattr(bpy.types, name)
            assert operator.bl_description.count("\n") == 1, name
            prefix, suffix = operator.bl_idname.split(".")
            for prop in getattr(getattr(bpy.ops, prefix), suffix).get_rna_type().properties:
                assert described_twice(prop), f"{name}.{prop.identifier}"
    for tool in part("live_tools").TOOLS:
        assert tool.bl_description.count("\n") == 1, tool
    described = bpy.types.UV_OT_conformal_unwrap.description(bpy.context, Button_of("DISK"))
    assert described.count("\n") == 1 and "round" in described


def Button_of(shape):  # noqa: N802 - a button's properties
    button = Button()
    button.shape = shape
    return button


def test_defaults_of_the_preferences_are_the_next_options(part):
    preferences, chosen = part("preferences"), part("operators").chosen_options(bpy.context)
    before = {name: getattr(chosen, name) for name in preferences.NAMES}
    defaults, others = (
        Button(),
        {
            "shape": "RECTANGLE",
            "method": "NEWTON",
            "place": "PACK",
            "margin": 0.25,
            "margin_method": "PIXELS",
            "image_size": 2048,
            "pack_rotation": "ANY",
            "pack_shape": "BOX",
        },
    )
    vars(defaults).update(others)
    preferences.start_with(defaults, bpy.context)
    assert {name: getattr(chosen, name) for name in others} == others
    declared = preferences.ConformalUnwrapPreferences.__annotations__
    assert set(declared) == set(preferences.NAMES) == set(others)
    assert declared["shape"].keywords["default"] == "FREE"
    ob = scenes.grid()
    bpy.ops.uv.conformal_unwrap()  # a script has the documented defaults all the same
    uv = scenes.uvs(ob)
    assert abs(((uv - 0.5) ** 2).sum(axis=1).max() - 0.25) < 1e-6  # a disk
    for name, value in before.items():
        setattr(chosen, name, value)


def test_presets_come_back(part, tmp_path, monkeypatch):
    presets, chosen = part("presets"), part("operators").chosen_options(bpy.context)
    monkeypatch.setattr(bpy.utils, "user_resource", lambda *_, **__: str(tmp_path))
    chosen.shape, chosen.rotation, chosen.uv_layer = "RECTANGLE", 0.5, 'It\'s "one"\n'
    assert bpy.ops.uv.conformal_preset_add(name="My own") == {"FINISHED"}
    (file,) = tmp_path.iterdir()
    assert file.name == "My_own.py" and presets.SUBFOLDER == "operator/uv.conformal_unwrap"
    chosen.shape, chosen.rotation, chosen.uv_layer = "DISK", 0.0, ""
    code = file.read_text(encoding="utf-8")
    assert "op = bpy.context.active_operator" in code  # as in presets of Blender's own
    exec(code.replace("bpy.context.active_operator", "chosen"), {"chosen": chosen})
    assert (chosen.shape, chosen.rotation, chosen.uv_layer) == ("RECTANGLE", 0.5, 'It\'s "one"\n')
    assert bpy.ops.uv.conformal_preset_add(name="  ") == {"CANCELLED"}
    assert bpy.ops.uv.conformal_preset_add(name="My own", remove_name=True) == {"FINISHED"}
    assert not list(tmp_path.iterdir())
    chosen.shape, chosen.rotation, chosen.uv_layer = "FREE", 0.0, ""


def test_shortcuts_are_offered_switched_off(part):
    for name, _, operator, properties, key, modifiers in part("keymaps").OFFERED:
        prefix, suffix = operator.split(".")
        known = getattr(getattr(bpy.ops, prefix), suffix).get_rna_type().properties
        assert name in {"UV Editor", "Mesh"} and set(properties) <= set(known.keys())
        assert (key == "NONE") == (not modifiers)  # a bare key is taken already
    keyconfig = bpy.context.window_manager.keyconfigs.addon
    if keyconfig is not None:
        made = [item for _, item in part("keymaps")._made]
        assert len(made) == len(part("keymaps").OFFERED) and not any(item.active for item in made)


def test_the_manuals_address_is_the_manifests(part, tmp_path, monkeypatch):
    manual, file = part("manual"), tmp_path / "blender_manifest.toml"
    assert manual.website(file) == ""
    file.write_text('id = "conformal_uv"\nwebsite = "https://example.org/conformal/"\n', encoding="utf-8")
    assert manual.website(file) == "https://example.org/conformal/"
    monkeypatch.setattr(manual, "website", lambda: "https://example.org/conformal/")
    manual.register()
    try:
        assert manual.pages in bpy.utils._manual_map
        base, pages = manual.pages()
        assert base == "https://example.org/conformal/" and all(page.startswith("docs/blender.md") for _, page in pages)
    finally:
        manual.unregister()
    assert manual.pages not in bpy.utils._manual_map

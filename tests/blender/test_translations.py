"""Every text of the add-on has its translation, and values keep their places in it."""

from __future__ import annotations

import ast
import string
from importlib import import_module
from pathlib import Path

import bpy
import pytest

LOOKED_UP = {"told": 1, "shown": 1, "counted": 2}  # functions of words.py: where their first texts end
DRAWN = {"label", "operator", "popover", "prop", "menu"}  # Blender looks up what these are given as text
OUTSIDE = {"command.py", "words.py"}  # the shell's own; the functions themselves


@pytest.fixture
def folder(addon) -> Path:
    return Path(addon.__file__).parent


def constants(node, names):
    """The texts that an argument may be: itself, one of two, or a constant of its module, of a dict's values."""
    if isinstance(node, ast.Constant):
        return [node.value]
    if isinstance(node, ast.IfExp):
        return constants(node.body, names) + constants(node.orelse, names)
    if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name):
        node = node.value
    value = names.get(node.id) if isinstance(node, ast.Name) else None
    return [value] if isinstance(value, str) else list(value.values()) if isinstance(value, dict) else []


def texts_in_code(addon, path: Path) -> set[str]:
    names = dict(vars(import_module(f"{addon.__name__}.{path.stem}" if path.stem != "__init__" else addon.__name__)))
    found: set[str] = set()
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    for node in nodes:  # what functions import when they are called
        if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module:
            module = vars(import_module(f"{addon.__name__}.{node.module}"))
            names |= {alias.asname or alias.name: module.get(alias.name) for alias in node.names}
    for call in (node for node in nodes if isinstance(node, ast.Call)):
        name = call.func.id if isinstance(call.func, ast.Name) else getattr(call.func, "attr", "")
        if name == "counted":
            given = call.args[1:3]
        elif name in LOOKED_UP:
            given = call.args[:1]
        else:
            given = [word.value for word in call.keywords if word.arg == "text" and name in DRAWN]
        for argument in given:
            found |= {text for text in constants(argument, names) if isinstance(text, str) and text}
    return found


def classes(addon):
    for cls in (getattr(bpy.types, name) for name in dir(bpy.types)):
        if getattr(cls, "__module__", "").startswith(f"{addon.__name__}."):
            yield cls


def texts_of_classes(addon) -> set[str]:
    found: set[str] = set()
    for cls in classes(addon):
        found |= {getattr(cls, name, None) for name in ("bl_label", "bl_description", "bl_category")}
        for base in cls.__mro__:
            for declared in getattr(base, "__annotations__", {}).values():
                found |= texts_of_property(getattr(declared, "keywords", {}))
    return {text for text in found if text}


def texts_of_property(keywords) -> set[str]:
    if "HIDDEN" in keywords.get("options", ()):
        return set()
    items = {text for item in keywords.get("items", ()) for text in item[1:3]}
    return {keywords.get("name"), keywords.get("description")} | items


def all_texts(addon, folder) -> set[str]:
    files = [path for path in folder.glob("*.py") if path.name not in OUTSIDE]
    choices, menus, tools = (import_module(f"{addon.__name__}.{name}") for name in ("choices", "menus", "live_tools"))
    entries = {text for _, text in (*choices.UNWRAPS, *menus.OVERLAYS)}
    entries |= {text for tool in tools.TOOLS for text in (tool.bl_label, tool.bl_description)}
    return texts_of_classes(addon).union(entries, *(texts_in_code(addon, path) for path in files))


def test_german_is_complete(addon, folder):
    german = import_module(f"{addon.__name__}.german").GERMAN
    texts = all_texts(addon, folder)
    assert {"Conformal Unwrap", "Fill Holes", "Measuring ...", "Unwrapped {done} of {count} islands"} <= texts
    missing = sorted(text for text in texts if text not in german)
    assert not missing, "\n".join(map(repr, missing))
    left_over = sorted(set(german) - texts)
    assert not left_over, "\n".join(map(repr, left_over))


def test_values_keep_their_names(addon):
    german = import_module(f"{addon.__name__}.german").GERMAN
    for text, translated in german.items():
        assert fields(text) == fields(translated), text
        assert text.count("\n") == translated.count("\n"), text


def fields(text):
    return {(name, form) for _, name, form, _ in string.Formatter().parse(text) if name}


def test_reports_are_looked_up(folder):
    """No report gives a literal or an f-string with words of its own."""
    for path in folder.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "report" and len(node.args) == 2:
                literal = [part for part in ast.walk(node.args[1]) if isinstance(part, ast.JoinedStr)]
                words = [part.value for joined in literal for part in joined.values if isinstance(part, ast.Constant)]
                assert not isinstance(node.args[1], ast.Constant), f"{path.name}:{node.lineno}"
                assert not any(any(map(str.isalpha, word)) for word in words), f"{path.name}:{node.lineno}"


def test_blender_finds_them(addon):
    find = bpy.app.translations
    for language in ("de_DE", "de"):
        try:
            bpy.context.preferences.view.language = language
            break
        except TypeError:  # this Blender has no translations, or calls it otherwise
            continue
    else:
        pytest.skip("Blender without languages")
    try:
        assert find.pgettext("Conformal Unwrap", "Operator") == "Konformes Abwickeln"
        assert (
            import_module(f"{addon.__name__}.words").counted(1, "{count} face is selected", "")
            == "1 Fläche ist ausgewählt"
        )
    finally:
        bpy.context.preferences.view.language = "en_US"

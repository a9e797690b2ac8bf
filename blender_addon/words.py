"""Texts in the user's language: looked up first, and only then filled in."""

from __future__ import annotations

import re

from bpy.app.translations import pgettext_iface, pgettext_rpt

ISLANDS = re.compile(r"\b([Cc])hart(s?)\b")
ONE = re.compile(r"\b1 (faces|edges|vertices|triangles|islands|holes)( are| have| repeat| join| name| lie)?\b")
ALONE = re.compile(r"\b(faces|vertices) (\d+)(?=[.;:)]|$)")
SINGULAR = {
    "faces": "face",
    "edges": "edge",
    "vertices": "vertex",
    "triangles": "triangle",
    "islands": "island",
    "holes": "hole",
}
VERBS = {" are": " is", " have": " has", " repeat": " repeats", " join": " joins", " name": " names", " lie": " lies"}


def told(text: str, **values: object) -> str:
    """A report, its values put in for their names in braces."""
    return pgettext_rpt(text).format(**values)


def shown(text: str, **values: object) -> str:
    """A label, likewise."""
    return pgettext_iface(text).format(**values)


def on_button(text: str) -> str:
    """The name of what a button does, as Blender looks it up."""
    return pgettext_iface(text, "Operator")


def counted(count: int, one: str, many: str, **values: object) -> str:
    """A report with a number in it, `{count}`, in its singular or its plural."""
    return told(one if count == 1 else many, count=count, **values)


def as_blender_says(text: str) -> str:
    """A sentence of the library, whose charts are islands here, and one of a thing no plural."""
    text = ISLANDS.sub(lambda found: ("I" if found[1] == "C" else "i") + "sland" + found[2], text)
    text = ALONE.sub(lambda found: f"{SINGULAR[found[1]]} {found[2]}", text)
    return ONE.sub(lambda found: f"1 {SINGULAR[found[1]]}{VERBS.get(found[2], '')}", text)

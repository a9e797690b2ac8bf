"""The add-on's texts in other languages; what the library says of a mesh stays in English."""

import bpy

from .german import GERMAN

CONTEXTS = ("*", "Operator")  # Blender looks names of operators up in the second


def _of(texts):
    return {(context, text): translated for text, translated in texts.items() for context in CONTEXTS}


LANGUAGES = {"de_DE": _of(GERMAN), "de": _of(GERMAN)}  # the one up to Blender 4.5, the other from then on


def register():
    bpy.app.translations.register(__package__, LANGUAGES)


def unregister():
    bpy.app.translations.unregister(__package__)

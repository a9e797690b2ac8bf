"""The add-on's texts in other languages."""

import bpy

LANGUAGES = {}


def register():
    bpy.app.translations.register(__package__, LANGUAGES)


def unregister():
    bpy.app.translations.unregister(__package__)

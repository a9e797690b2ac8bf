"""Online Manual in the context menus of the operators: the address that the manifest names as its website.

Without such an address nothing is registered: the extension's files hold no pages that a browser shows.
"""

import tomllib
from pathlib import Path

import bpy

MANIFEST = Path(__file__).with_name("blender_manifest.toml")
PAGES = (  # operator, as Blender asks for it, and where the manual tells of it
    ("bpy.ops.uv.conformal_unwrap*", "docs/blender.md#use"),
    ("bpy.ops.uv.conformal_select_*", "docs/blender.md#quality"),
    ("bpy.ops.object.conformal_sphere*", "docs/blender.md#spheres"),
    ("bpy.ops.uv.conformal_pack*", "docs/blender.md#packing"),
    ("bpy.ops.uv.conformal_*", "docs/blender.md"),
)

_registered = []


def website(manifest=MANIFEST):
    """The address in the manifest, empty where there is none."""
    if not manifest.is_file():
        return ""
    return tomllib.loads(manifest.read_text(encoding="utf-8")).get("website", "")


def pages():
    """What bpy.utils.register_manual_map takes: where all pages are, and each operator's."""
    return f"{website().rstrip('/')}/", PAGES


def register():
    if website():
        bpy.utils.register_manual_map(pages)
        _registered.append(pages)


def unregister():
    while _registered:
        bpy.utils.unregister_manual_map(_registered.pop())

"""Conformal maps as filters of pymeshlab.

``register()`` puts them on ``pymeshlab.MeshSet``; the functions here do the same without it. Nothing is imported
from pymeshlab before one of them is asked for.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .checker import write_checker
    from .disk import compute_texcoord_parametrization_conformal_disk
    from .exceptions import ConformalFilterException
    from .free import compute_texcoord_parametrization_conformal_free
    from .rectangle import compute_texcoord_parametrization_conformal_rectangle
    from .registration import register, unregister
    from .saving import save_textured_mesh
    from .sphere import compute_coord_conformal_sphere

__all__ = [
    "ConformalFilterException",
    "compute_coord_conformal_sphere",
    "compute_texcoord_parametrization_conformal_disk",
    "compute_texcoord_parametrization_conformal_free",
    "compute_texcoord_parametrization_conformal_rectangle",
    "register",
    "save_textured_mesh",
    "unregister",
    "write_checker",
]

_HOME = {
    "ConformalFilterException": "exceptions",
    "compute_coord_conformal_sphere": "sphere",
    "compute_texcoord_parametrization_conformal_disk": "disk",
    "compute_texcoord_parametrization_conformal_free": "free",
    "compute_texcoord_parametrization_conformal_rectangle": "rectangle",
    "register": "registration",
    "save_textured_mesh": "saving",
    "unregister": "registration",
    "write_checker": "checker",
}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])

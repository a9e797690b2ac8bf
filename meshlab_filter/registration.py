"""The filters as methods of pymeshlab.MeshSet, bound as pymeshlab binds its own."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from .disk import compute_texcoord_parametrization_conformal_disk
from .exceptions import ConformalFilterException
from .free import compute_texcoord_parametrization_conformal_free
from .library import pymeshlab
from .rectangle import compute_texcoord_parametrization_conformal_rectangle
from .sphere import compute_coord_conformal_sphere

__all__ = ["register", "unregister"]

FILTERS = (
    compute_texcoord_parametrization_conformal_disk,
    compute_texcoord_parametrization_conformal_free,
    compute_texcoord_parametrization_conformal_rectangle,
    compute_coord_conformal_sphere,
)


def register() -> None:
    """Put the filters on pymeshlab.MeshSet; again does no harm.

    ``MeshSet.apply_filter`` and filter scripts know only MeshLab's own plugins and do not find them.
    """
    for function in FILTERS:
        setattr(pymeshlab.MeshSet, function.__name__, _bound(function))


def unregister() -> None:
    """Take them off again."""
    for function in FILTERS:
        if function.__name__ in vars(pymeshlab.MeshSet):
            delattr(pymeshlab.MeshSet, function.__name__)


def _bound(function: Callable[..., dict[str, float]]) -> Callable[..., dict[str, float]]:
    """A method that takes keywords only and answers unknown ones as pymeshlab does."""
    signature = inspect.signature(function)
    known = [name for name, p in signature.parameters.items() if p.kind is p.KEYWORD_ONLY]

    def filter_function(self: Any, **kwargs: Any) -> dict[str, float]:
        for name in kwargs:
            if name not in known:
                raise ConformalFilterException(
                    f"Parameter {name} not found for filter {function.__name__}. It takes {', '.join(known)}."
                )
        return function(self, **kwargs)

    filter_function.__name__ = function.__name__
    filter_function.__qualname__ = f"MeshSet.{function.__name__}"
    filter_function.__module__ = function.__module__
    filter_function.__doc__ = function.__doc__
    own = [p.replace(name="self", annotation=p.empty) if p.name == "ms" else p for p in signature.parameters.values()]
    filter_function.__signature__ = signature.replace(parameters=own)  # type: ignore[attr-defined]
    return filter_function

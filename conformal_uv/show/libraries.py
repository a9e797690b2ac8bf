"""Libraries that are only needed to show something, imported when it is shown."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..errors import MissingDependencyError

__all__ = ["library"]


def library(name: str, wanted_by: str, install: str) -> Any:
    """The module.

    Raises
    ------
    MissingDependencyError
        It is not installed; `install` is what pip is to be given.
    """
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise MissingDependencyError(f"{wanted_by} needs {name}: pip install {install}.") from error

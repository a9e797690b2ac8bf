"""Numbers from numpy into a mesh, through pymeshlab's filters by function.

The only door into an existing mesh are custom attributes, which those filters read as variables. pymeshlab can
neither change nor remove an attribute, so they stay, under names that begin with ``conformal_uv_``; no file format
saves them unasked.
"""

from __future__ import annotations

from itertools import count
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .exceptions import ConformalFilterException
from .library import pymeshlab

__all__ = ["check_function_filters", "face_variable", "vertex_variable"]


def check_function_filters(ms: Any) -> None:
    """Raise ConformalFilterException where no filter by function works on the current mesh; change nothing.

    A custom attribute whose name is no variable name, such as "a.b", breaks them all. Selecting what is selected
    shows it and leaves the mesh alone.
    """
    try:
        ms.compute_selection_by_condition_per_vertex(condselect="vsel")
        ms.compute_selection_by_condition_per_face(condselect="fsel")
    except (RuntimeError, pymeshlab.PyMeshLabException) as error:
        raise ConformalFilterException(
            "pymeshlab's filters by function fail on this mesh, and only they can write texture coordinates. It has "
            "a custom attribute whose name is not letters, digits and underscores; load the mesh without it."
        ) from error


def vertex_variable(mesh: Any, name: str, values: NDArray[np.float64]) -> str:
    """A variable of filters by function with these values (n,)."""
    return _variable(mesh, "vertex", name, values)


def face_variable(mesh: Any, name: str, values: NDArray[np.float64]) -> str:
    """A variable of filters by function with these values (m,)."""
    return _variable(mesh, "face", name, values)


def _variable(mesh: Any, element: str, name: str, values: NDArray[np.float64]) -> str:
    """The first attribute of this name, numbered, that has these values or is new."""
    add = getattr(mesh, f"add_{element}_custom_scalar_attribute")
    read = getattr(mesh, f"{element}_custom_scalar_attribute_array")
    for number in count():
        attribute = f"conformal_uv_{name}" + (f"_{number}" if number else "")
        try:
            kept = read(attribute)
        except pymeshlab.PyMeshLabException:
            kept = None
        if kept is None:
            try:
                add(np.ascontiguousarray(values, dtype=np.float64), attribute)
            except pymeshlab.PyMeshLabException:  # an attribute of another type has the name
                continue
            return attribute
        if np.array_equal(kept, values):
            return attribute
    raise AssertionError("unreachable")

"""Numbers from numpy into a mesh, through pymeshlab's filters by function.

The only door into an existing mesh are custom attributes, which those filters read as variables. pymeshlab can
neither change nor remove an attribute, so they stay, under names that begin with ``conformal_uv_``; no file format
saves them unasked.
"""

from __future__ import annotations

import contextlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .exceptions import ConformalFilterException
from .library import pymeshlab

__all__ = ["check_function_filters", "face_variable", "vertex_variable"]

MOST = 10000  # attributes of one name


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
    for number in range(MOST):
        attribute = f"conformal_uv_{name}" + (f"_{number}" if number else "")
        kept = _values(mesh, element, attribute)
        if kept is None:
            with contextlib.suppress(pymeshlab.PyMeshLabException):
                add = getattr(mesh, f"add_{element}_custom_scalar_attribute")
                add(np.ascontiguousarray(values, dtype=np.float64), attribute)
            # an attribute of another type that has the name stays, and no new one comes to be
            kept = _values(mesh, element, attribute)
        if kept is not None and np.array_equal(kept, values):
            return attribute
    raise ConformalFilterException(f"The mesh has {MOST} custom attributes conformal_uv_{name}; load it anew.")


def _values(mesh: Any, element: str, attribute: str) -> NDArray[np.float64] | None:
    try:
        return np.asarray(getattr(mesh, f"{element}_custom_scalar_attribute_array")(attribute))
    except pymeshlab.PyMeshLabException:
        return None

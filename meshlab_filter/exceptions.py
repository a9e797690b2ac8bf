"""What the filters raise: pymeshlab's exception, with the message and the cause of conformal_uv's."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator

from conformal_uv import ConformalUVError

from .library import pymeshlab

__all__ = ["ConformalFilterException", "pymeshlab_errors"]


class ConformalFilterException(pymeshlab.PyMeshLabException):  # noqa: N818  # named as pymeshlab names its own
    """The filter failed; the MeshSet is as it was. ``__cause__`` is the error of conformal_uv, where it is one.

    Attributes
    ----------
    indices : tuple of int
        The vertices or faces the message speaks of, empty where none can be named.
    """

    def __init__(self, message: str, indices: Iterable[int] = ()) -> None:
        super().__init__(message)
        self.indices = tuple(indices)


@contextlib.contextmanager
def pymeshlab_errors(filter_name: str) -> Iterator[None]:
    """Raise errors of conformal_uv, and those of pymeshlab that are no PyMeshLabException, as one."""
    try:
        yield
    except ConformalUVError as error:
        message = f"Failed to apply filter: {filter_name}\nDetails: {type(error).__name__}: {error}"
        raise ConformalFilterException(message, error.indices) from error
    except pymeshlab.MissingCompactnessException as error:
        raise ConformalFilterException(
            f"Failed to apply filter: {filter_name}\n"
            "Details: the mesh has deleted elements; call current_mesh().compact() first."
        ) from error

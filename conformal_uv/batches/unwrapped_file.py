"""A polygon mesh from a file unwrapped, and its texture coordinates as the file stores them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..charts import Unwrapped, unwrap
from ..errors import Remedy
from ..files import MeshFile, read_seams

__all__ = ["stored_uv", "unwrapped_file"]


def unwrapped_file(
    mesh_file: MeshFile,
    *,
    seams: str | None = None,
    words: Callable[[Remedy], str] | None = None,
    **options: Any,
) -> Unwrapped:
    """The mesh unwrapped, one chart of it at least.

    Parameters
    ----------
    seams : str, optional
        A file of seams, or "uv"; see `read_seams`.
    words : callable, optional
        How remedies are told where no chart can be mapped; see `ConformalUVError.told`.
    options
        Those of `unwrap`.

    Raises
    ------
    ConformalUVError
        Nothing could be mapped.
    """
    result = unwrap(None, mesh_file.mesh, seams=read_seams(seams, mesh_file), **options)
    failure = result.failure(words)
    if failure is not None:
        raise failure
    return result


def stored_uv(result: Unwrapped, sizes: NDArray[np.int64]) -> NDArray[np.float64]:
    """Texture coordinates of all corners; NaN, which leaves a file's own ones, where nothing was mapped."""
    uv = result.uv.copy()
    uv[~np.repeat(result.mapped, sizes)] = np.nan
    return uv

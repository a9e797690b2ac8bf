"""What the rows of every PLY element share: their refusal, and the types of their numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FileFormatError
from ..checks import DAMAGED
from .header import PlyElement, PlyProperty

__all__ = ["Ints", "damaged_row", "kept_type"]

Ints = NDArray[np.int64]


def damaged_row(path: Path, element: PlyElement, row: int, what: str) -> FileFormatError:
    """The refusal of a row."""
    return FileFormatError(f"{path}, element {element.name!r}, row {row}: {what}; {DAMAGED}")


def kept_type(p: PlyProperty) -> type[Any]:
    """What a property's numbers are held in: of floating point as declared, whole ones in 64 bits."""
    return {"f4": np.float32, "f8": np.float64}.get(p.type, np.int64)

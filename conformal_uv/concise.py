"""What an object with arrays says of itself in one line."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any

import numpy as np

__all__ = ["Concise"]

SHORT = 4  # items that are said one by one


class Concise:
    """A dataclass (with ``repr=False``) whose arrays are said by type and shape."""

    def __repr__(self) -> str:
        """The class with its fields, such as ``uv=float64 (500, 2)``."""
        shown = [field.name for field in fields(self) if field.repr]  # type: ignore[arg-type]
        return f"{type(self).__name__}({', '.join(f'{name}={_said(getattr(self, name))}' for name in shown)})"


def _said(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape}"
    if isinstance(value, Enum):
        return repr(value.value)
    if isinstance(value, Concise):
        return type(value).__name__
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, tuple | list) and (len(value) > SHORT or any(map(is_dataclass, value))):
        return f"{len(value)} items"
    if isinstance(value, tuple | list) and any(isinstance(item, tuple | list | np.ndarray) for item in value):
        return f"{len(value)} items"
    if isinstance(value, tuple):
        return f"({', '.join(map(_said, value))})"
    return repr(value)

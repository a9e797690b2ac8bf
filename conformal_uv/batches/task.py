"""One mesh of a batch, as it is handed to a worker."""

from __future__ import annotations

from dataclasses import dataclass

from .plan import Plan
from .row import BatchRow

__all__ = ["Task"]


@dataclass(frozen=True)
class Task:
    """A mesh file, where its map goes, and how it is made.

    Attributes
    ----------
    source, target : str
        Absolute paths.
    plan : Plan
    vertices, memory : int
        Of the mesh, and bytes that a process takes for it; about, and rather too many.
    before : BatchRow, optional
        What an earlier run told of this input.
    """

    source: str
    target: str
    plan: Plan
    vertices: int = 0
    memory: int = 0
    before: BatchRow | None = None

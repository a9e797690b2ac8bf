"""Long arrays a block at a time: what is worked out in between stays in the processor's cache.

Blocks are shared out among threads. They are the same however many there are, and so is what comes out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

from ..threads import side_by_side

__all__ = ["BLOCK", "blocks", "by_blocks"]

Result = TypeVar("Result")

BLOCK = 1 << 14  # faces; a dozen numbers for each fit into a cache of a megabyte or two


def blocks(count: int) -> Iterator[slice]:
    """Slices that cover 0 .. count - 1 in order."""
    return (slice(start, min(start + BLOCK, count)) for start in range(0, count, BLOCK))


def by_blocks(work: Callable[[slice], Result], count: int) -> list[Result]:
    """What `work` gives for each block, in their order; blocks are worked on side by side."""
    return side_by_side(work, blocks(count))

"""Long arrays a block at a time: what is worked out in between stays in the processor's cache."""

from __future__ import annotations

from collections.abc import Iterator

__all__ = ["BLOCK", "blocks"]

BLOCK = 1 << 14  # faces; a dozen numbers for each fit into a cache of a megabyte or two


def blocks(count: int) -> Iterator[slice]:
    """Slices that cover 0 .. count - 1 in order."""
    return (slice(start, min(start + BLOCK, count)) for start in range(0, count, BLOCK))

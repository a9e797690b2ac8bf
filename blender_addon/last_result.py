"""The result that the panel shows."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .results import UnwrapResult

_kept: list[UnwrapResult] = []


def keep(result: UnwrapResult) -> None:
    """Show this one from now on."""
    _kept[:] = [result]


def last() -> UnwrapResult | None:
    """The last result, None before the first."""
    return _kept[0] if _kept else None


def forget() -> None:
    """Show none."""
    _kept.clear()

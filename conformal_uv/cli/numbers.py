"""Options that are several numbers."""

from __future__ import annotations

import typer

__all__ = ["four_numbers", "three_numbers"]


def three_numbers(text: str | None) -> list[int] | None:
    """``a,b,c`` as three integers; wrong usage otherwise."""
    return _numbers(text, 3, "three vertex numbers, such as 0,31,62")


def four_numbers(text: str | None) -> list[int] | None:
    """``a,b,c,d`` as four integers; wrong usage otherwise."""
    return _numbers(text, 4, "four vertex numbers, such as 0,31,62,93")


def _numbers(text: str | None, count: int, what: str) -> list[int] | None:
    if text is None:
        return None
    try:
        found = [int(part) for part in text.split(",")]
    except ValueError as error:
        raise typer.BadParameter(f"{text!r} is not {what}") from error
    if len(found) != count:
        raise typer.BadParameter(f"{text!r} is not {what}")
    return found

"""Options that are several numbers."""

from __future__ import annotations

import typer

__all__ = ["three_numbers"]


def three_numbers(text: str | None) -> list[int] | None:
    """``a,b,c`` as three integers; wrong usage otherwise."""
    if text is None:
        return None
    try:
        a, b, c = (int(part) for part in text.split(","))
    except ValueError as error:
        raise typer.BadParameter(f"{text!r} is not three vertex numbers, such as 0,31,62") from error
    return [a, b, c]

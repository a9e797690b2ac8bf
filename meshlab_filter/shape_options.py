"""Options of the script that mean something for one shape only."""

from __future__ import annotations

from typing import Any

from conformal_uv import OptionError
from conformal_uv.options import Shape

__all__ = ["shape_options"]

OWN = {
    Shape.DISK: {"method", "center"},
    Shape.FREE: {"refine"},
    Shape.RECTANGLE: {"corners", "corner_choice"},
}


def shape_options(shape: Shape, *, corners: str | None, **given: Any) -> dict[str, Any]:
    """What was given of these, as `unwrap` takes it; None and False are what was not.

    Raises
    ------
    OptionError
        An option of another shape, or corners that are not four numbers.
    """
    named = {"corners": corners, **given}
    found = {name: value for name, value in named.items() if value is not None and value is not False}
    for name in sorted(found.keys() - OWN[shape]):
        (owner,) = (other for other, own in OWN.items() if name in own)
        raise OptionError(f"--{name.replace('_', '-')} is for --shape {owner}; this is {shape}.")
    if corners is not None:
        found["pins"] = _four_numbers(found.pop("corners"))
    return found


def _four_numbers(text: str) -> list[int]:
    try:
        a, b, c, d = (int(part) for part in text.split(","))
    except ValueError as error:
        raise OptionError(f"--corners {text}: not four vertex numbers, such as 0,31,62,93.") from error
    return [a, b, c, d]

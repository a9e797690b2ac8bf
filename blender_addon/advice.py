"""What a poor map asks for, in words, and the options that would mend it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .choices import LABELS
from .words import counted, shown, told

if TYPE_CHECKING:
    from .properties import Options
    from .results import ObjectResult, UnwrapResult

POOR_ANGLE = 10.0  # degrees, in the mean
POOR_AREA = 1000.0  # largest over smallest change of area


@dataclass(frozen=True)
class Advice:
    """One thing to do.

    Attributes
    ----------
    text : str
    action : str
        What a button says that does it, empty where there is none.
    changes : dict
        Options to unwrap with instead; without any, the button selects the worst faces.
    """

    text: str
    action: str = ""
    changes: dict[str, Any] = field(default_factory=dict)


def advice_for(result: UnwrapResult) -> list[Advice]:
    """What to do about islands that failed and numbers that are poor; each thing once, for its first reason."""
    once: dict[object, Advice] = {}
    for piece in (piece for ob in result.objects for piece in _advice(ob, result.options)):
        once.setdefault((piece.action or piece.text, repr(piece.changes)), piece)
    return list(once.values())


def _advice(ob: ObjectResult, options: Options) -> list[Advice]:
    found = [
        Advice(told("Islands that failed can be unwrapped with another option"), _named(changes), changes)
        for changes in _distinct([failure.changes for failure in ob.failures])
    ]
    quality = ob.quality
    if quality is not None and quality.angle_mean > POOR_ANGLE:
        found.append(_poor_angles(quality.angle_mean, options))
    elif quality is not None and (quality.area_ratio or 0.0) > POOR_AREA:
        found.append(_poor_areas(quality.area_ratio, options))
    if ob.flipped and not options.repair:
        text = counted(ob.flipped, "{count} face is inverted", "{count} faces are inverted")
        found.append(Advice(text, told("Repair Folds"), {"repair": True}))
    if ob.lost_to_float32 and options.shape != "FREE":
        text = counted(
            ob.lost_to_float32,
            "{count} face is too small to be stored; it crowds on the boundary",
            "{count} faces are too small to be stored; they crowd on the boundary",
        )
        found.append(Advice(text, told("Use Free"), {"shape": "FREE"}))
    return found


def _poor_angles(mean: float, options: Options) -> Advice:
    if options.shape != "FREE":
        text = told("Mean angle error {angle:.0f}°: let islands keep their own outline, or cut them", angle=mean)
        return Advice(text, told("Use Free"), {"shape": "FREE"})
    text = told("Mean angle error {angle:.0f}°: mark seams across the worst faces, then unwrap again", angle=mean)
    return Advice(text, told("Select the Worst Faces"))


def _poor_areas(ratio: float, options: Options) -> Advice:
    if options.shape != "FREE":
        text = told(
            "Areas change up to {ratio:.3g} times: let islands keep their own outline, or cut them", ratio=ratio
        )
        return Advice(text, told("Use Free"), {"shape": "FREE"})
    return Advice(told("Areas change up to {ratio:.3g} times: cut long limbs off by seams", ratio=ratio))


def _named(changes: dict[str, Any]) -> str:
    names = {"fill_holes": shown("Fill Holes")}
    for option, (label, values) in LABELS.items():
        if option in changes:
            names[option] = f"{shown(label)}: {shown(values[changes[option]])}"
    return ", ".join(names[option] for option in changes)


def _distinct(dicts: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return list({tuple(sorted(one.items())): one for one in dicts if one}.values())

"""What came of an unwrap: numbers for the panel and the report file, one line for the status bar."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field, fields
from functools import cached_property
from math import isfinite
from typing import Any

import numpy as np

from conformal_uv import ConformalUVError, DistortionNumbers, Remedy, UnwrapNumbers, unwrap_numbers

from .choices import CLOSED, METHODS
from .tasks import Task

NOT_TOLD = {"measure", "tried", "left"}  # in JSON
MOST_FACES, MOST_FAILURES = 3, 4  # named in a message


@dataclass(frozen=True)
class Failure:
    """An island that kept its UVs: its faces and why."""

    faces: list[int]
    why: str


@dataclass(frozen=True)
class ObjectResult:
    """What came of one object."""

    name: str
    uv_layer: str
    refusal: str = ""
    tried: bool = True
    left: int = 0
    islands: int = 0
    failures: list[Failure] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    flipped: int = 0
    lost_to_float32: int = 0
    measure: Callable[[], UnwrapNumbers | None] = field(default=lambda: None, repr=False)

    @cached_property
    def numbers(self) -> UnwrapNumbers | None:
        """Of all unwrapped islands, measured when first asked for; None where nothing was solved."""
        return self.measure()

    @property
    def quality(self) -> DistortionNumbers | None:
        """Distortion over all unwrapped islands; None where there are none."""
        return self.numbers.distortion if self.numbers else None

    @property
    def coverage(self) -> float | None:
        """Share of the unit square that they fill; None where there are none, or one reaches out of it."""
        return self.numbers.coverage if self.numbers else None

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        told = {item.name: getattr(self, item.name) for item in fields(self) if item.name not in NOT_TOLD}
        told["failures"] = [asdict(failure) for failure in self.failures]
        quality = asdict(self.quality) if self.quality else {}
        finite = {name: value for name, value in quality.items() if value is None or isfinite(value)}
        return {**told, **finite, "coverage": self.coverage}


@dataclass(frozen=True)
class UnwrapResult:
    """What came of all objects."""

    objects: list[ObjectResult]
    seconds: float
    notes: list[str] = field(default_factory=list)

    @property
    def islands(self) -> int:
        """Islands found."""
        return sum(ob.islands for ob in self.objects)

    @property
    def unwrapped(self) -> int:
        """Islands with new UVs."""
        return self.islands - sum(len(ob.failures) for ob in self.objects)

    @property
    def tried(self) -> bool:
        """Whether there was a surface, for which other options may do."""
        return any(ob.tried for ob in self.objects)

    @property
    def left(self) -> int:
        """Islands left as they were on purpose: pinned, or not selected as a whole."""
        return sum(ob.left for ob in self.objects)

    @property
    def complete(self) -> bool:
        """Whether everything asked for was done."""
        return bool(self.unwrapped) and not any(ob.refusal or ob.failures for ob in self.objects)

    @property
    def message(self) -> str:
        """One line: how many islands, and why not the others."""
        told = [f"{ob.name}: {ob.refusal}" for ob in self.objects if ob.refusal]
        for ob in self.objects:
            told += [f"{ob.name}, faces {_some(failure.faces)}: {failure.why}" for failure in ob.failures]
        if len(told) > MOST_FAILURES:
            told[MOST_FAILURES:] = [f"and {len(told) - MOST_FAILURES} more"]
        count = f"Unwrapped {self.unwrapped} of {self.islands} island{'s' * (self.islands != 1)}"
        if len(self.objects) > 1:
            count += f" of {len(self.objects)} objects"
        return "; ".join([count, *told])

    @property
    def remarks(self) -> list[str]:
        """What was mended, left unused or lost, object by object."""
        told = self.notes + [f"{ob.name}: {note}" for ob in self.objects for note in dict.fromkeys(ob.notes)]
        told += [f"{ob.name}: {ob.flipped} faces are inverted" for ob in self.objects if ob.flipped]
        told += [
            f"{ob.name}: {ob.lost_to_float32} triangles are too small for the single precision of UVs; "
            "cut the island with seams"
            for ob in self.objects
            if ob.lost_to_float32
        ]
        return told

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "summary": self.message,
            "islands": self.islands,
            "unwrapped": self.unwrapped,
            "seconds": self.seconds,
            "notes": self.notes,
            "objects": [ob.as_dict() for ob in self.objects],
        }


def object_result(task: Task, stored: np.ndarray | None, corner: np.ndarray) -> ObjectResult:
    """What came of an object.

    Parameters
    ----------
    stored : (k, 2), optional
        UVs of its surface's corners; None where none were written.
    corner : (2,)
        Of the tile that they were packed into.
    """
    if task.solved is None:
        tried = task.surface is not None or task.mendable
        return ObjectResult(task.ob.name, task.layer, refusal=task.refusal, tried=tried, notes=task.notes)
    charts, written = task.solved.charts, task.written
    done = np.flatnonzero(written)
    failures = [
        Failure(
            task.own_faces(charts[number].faces).tolist(),
            task.left.get(number) or in_words_of_the_panel(charts.errors[number]),
        )
        for number in np.flatnonzero(~written).tolist()
    ]
    lost = task.solved.lost_to_float32(stored)[written].sum() if stored is not None else 0
    return ObjectResult(
        task.ob.name,
        task.layer,
        islands=len(charts),
        failures=failures,
        left=len(task.left),
        notes=task.notes + charts.notes(done) + _unconverged(int((~charts.converged[done]).sum())),
        flipped=len(charts.flipped(done)),
        lost_to_float32=int(lost),
        measure=lambda: unwrap_numbers(task.solved, uv=None if stored is None else stored - corner, chosen=written),
    )


def _unconverged(count: int) -> list[str]:
    return [f"{count} islands stopped before the method's tolerance"] if count else []


def _some(faces: list[int]) -> str:
    text = ", ".join(str(face) for face in faces[:MOST_FACES])
    return text if len(faces) <= MOST_FACES else f"{text} ..."


LABELS = {
    "closed": ("Closed Surfaces", {identifier: name for identifier, name, _ in CLOSED}),
    "method": ("Method", {identifier: name for identifier, name, _ in METHODS}),
}


def in_words_of_the_panel(error: ConformalUVError) -> str:
    """The error, with those remedies that the panel or the menus have, as they are called there."""
    return error.told(_as_in_the_panel)


def _as_in_the_panel(remedy: Remedy) -> str:
    if remedy.option == "holes":
        return "turn on Fill Holes"
    if remedy.option == "sphere_map":
        return "use Object > Conformal Sphere Map"
    label, names = LABELS.get(remedy.option, ("", {}))
    name = names.get(remedy.value.upper().replace("-", "_"))
    return f"set {label} to {name}" if name else ""

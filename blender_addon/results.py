"""What came of an unwrap: numbers for the panel and the report file, one line for the status bar."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field, fields
from functools import cached_property
from math import isfinite
from typing import Any

import numpy as np

from conformal_uv import ConformalUVError, DistortionNumbers, Remedy, UnwrapNumbers, unwrap_numbers

from .choices import LABELS
from .properties import Options
from .tasks import Task
from .words import as_blender_says, counted, shown, told

NOT_TOLD = {"measure", "tried", "left", "mesh", "fingerprint"}  # in JSON
MOST_FACES, MOST_FAILURES = 3, 4  # named in a message


@dataclass(frozen=True)
class Failure:
    """An island that kept its UVs: its faces, why, and names and values of options that would do."""

    faces: list[int]
    why: str
    changes: dict[str, Any] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {"faces": self.faces, "why": self.why}


@dataclass(frozen=True)
class ObjectResult:
    """What came of one object.

    Attributes
    ----------
    mesh : int
        Its mesh's number in this session of Blender.
    fingerprint : bytes
        Of the mesh and its UVs as they were written; empty where nothing was.
    """

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
    mesh: int = 0
    fingerprint: bytes = b""
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
        told["failures"] = [failure.as_dict() for failure in self.failures]
        quality = asdict(self.quality) if self.quality else {}
        finite = {name: value for name, value in quality.items() if value is None or isfinite(value)}
        return {**told, **finite, "coverage": self.coverage}


@dataclass(frozen=True)
class UnwrapResult:
    """What came of all objects."""

    objects: list[ObjectResult]
    seconds: float
    options: Options = Options()

    def measure(self) -> None:
        """Measure all numbers, within Python and numpy alone, so that a thread may."""
        for ob in self.objects:
            ob.numbers  # noqa: B018 - kept by the property

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
        why = [f"{ob.name}: {ob.refusal}" for ob in self.objects if ob.refusal]
        for ob in self.objects:
            why += [told_failure(ob.name, failure) for failure in ob.failures]
        if len(why) > MOST_FAILURES:
            why[MOST_FAILURES:] = [told("and {count} more", count=len(why) - MOST_FAILURES)]
        done, several = {"done": self.unwrapped}, len(self.objects) > 1
        if several:
            text = counted(
                self.islands,
                "Unwrapped {done} of {count} island of {objects} objects",
                "Unwrapped {done} of {count} islands of {objects} objects",
                objects=len(self.objects),
                **done,
            )
        else:
            text = counted(
                self.islands, "Unwrapped {done} of {count} island", "Unwrapped {done} of {count} islands", **done
            )
        return "; ".join([text, *why])

    @property
    def remarks(self) -> list[str]:
        """What was mended, left unused or lost, object by object."""
        said = [f"{ob.name}: {note}" for ob in self.objects for note in dict.fromkeys(ob.notes)]
        for ob in self.objects:
            if ob.flipped:
                inverted = counted(ob.flipped, "{count} face is inverted", "{count} faces are inverted")
                said.append(f"{ob.name}: {inverted}")
            if ob.lost_to_float32:
                said.append(f"{ob.name}: {lost_faces(ob.lost_to_float32)}")
        return said

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "summary": self.message,
            "islands": self.islands,
            "unwrapped": self.unwrapped,
            "seconds": self.seconds,
            "objects": [ob.as_dict() for ob in self.objects],
        }


def told_failure(name: str, failure: Failure) -> str:
    """An island of an object that kept its UVs."""
    return counted(
        len(failure.faces),
        "{object}, face {faces}: {why}",
        "{object}, faces {faces}: {why}",
        object=name,
        faces=_some(failure.faces),
        why=failure.why,
    )


def lost_faces(count: int) -> str:
    """Triangles whose UVs have no area as stored."""
    return counted(
        count,
        "{count} triangle is too small for the single precision of UVs; cut the island with seams",
        "{count} triangles are too small for the single precision of UVs; cut the island with seams",
    )


def object_result(task: Task, stored: np.ndarray | None, corner: np.ndarray, fingerprint: bytes) -> ObjectResult:
    """What came of an object.

    Parameters
    ----------
    stored : (k, 2), optional
        UVs of its surface's corners; None where none were written.
    corner : (2,)
        Of the tile that they were packed into.
    fingerprint : bytes
        Of the mesh as it was left.
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
            {} if number in task.left else changes_of(charts.errors[number]),
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
        notes=task.notes
        + [as_blender_says(note) for note in charts.notes(done)]
        + _unconverged(int((~charts.converged[done]).sum())),
        flipped=len(charts.flipped(done)),
        lost_to_float32=int(lost),
        mesh=task.ob.data.session_uid,
        fingerprint=fingerprint,
        measure=lambda: unwrap_numbers(task.solved, uv=None if stored is None else stored - corner, chosen=written),
    )


def _unconverged(count: int) -> list[str]:
    if not count:
        return []
    return [
        counted(
            count,
            "{count} island stopped before the method's tolerance",
            "{count} islands stopped before the method's tolerance",
        )
    ]


def _some(faces: list[int]) -> str:
    text = ", ".join(str(face) for face in faces[:MOST_FACES])
    return text if len(faces) <= MOST_FACES else f"{text} ..."


def in_words_of_the_panel(error: ConformalUVError) -> str:
    """The error, with those remedies that the panel or the menus have, as they are called there."""
    return as_blender_says(error.told(_as_in_the_panel))


def changes_of(error: ConformalUVError) -> dict[str, Any]:
    """Names and values of the operator's options that would do, all of them remedies of the error."""
    changes: dict[str, Any] = {}
    for remedy in (way for way in error.ways if isinstance(way, Remedy)):
        if remedy.option == "holes":
            changes["fill_holes"] = True
        elif _choice(remedy):
            changes[remedy.option] = _identifier(remedy)
    return changes


def _as_in_the_panel(remedy: Remedy) -> str:
    if remedy.option == "holes":
        return told("turn on Fill Holes")
    if remedy.option == "sphere_map":
        return told("use Object > Conformal Sphere Map")
    name = _choice(remedy)
    return told("set {option} to {value}", option=shown(LABELS[remedy.option][0]), value=shown(name)) if name else ""


def _choice(remedy: Remedy) -> str:
    """What the panel calls the value, empty where it has none."""
    _, names = LABELS.get(remedy.option, ("", {}))
    return names.get(_identifier(remedy), "")


def _identifier(remedy: Remedy) -> str:
    return remedy.value.upper().replace("-", "_")

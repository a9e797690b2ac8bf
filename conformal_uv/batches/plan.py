"""What is done with each mesh of a batch: the map and its options, checked before any work."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np

from ..errors import OptionError
from ..files import WRITABLE
from ..linear import choose_backend
from ..options import (
    DiskOptions,
    Laplacian,
    MapKind,
    PlaceOptions,
    ShapeOptions,
    SphereLayout,
    SphereOptions,
    SplitOptions,
)

__all__ = ["Plan"]

VERTICES = ("pins", "center", "boundary_vertex")
CHARTS = (DiskOptions, ShapeOptions, SplitOptions, PlaceOptions)
FILE = {"split", "format"}
NOT_ONES = {"shape", "outer_loop"}  # the map says it; vertices of one mesh alone


@dataclass(frozen=True)
class Plan:
    """A map and its options.

    Attributes
    ----------
    kind : MapKind
    options : str
        Those given, as JSON with its names in order: what tells whether a mesh was mapped in the same way before.
    flags : bool
        Errors advise options of the command, instead of the library's arguments.
    """

    kind: MapKind
    options: str
    flags: bool = False

    @classmethod
    def of(cls, kind: str, options: Mapping[str, Any], *, flags: bool = False) -> Self:
        """The plan of these options, those of the map's function and of writing; None is not given.

        Raises
        ------
        OptionError
            A name or a value that the map does not take.
        MissingDependencyError
            A backend that is not installed.
        """
        chosen = MapKind.of("map", kind)
        given = {name: _plain(name, value) for name, value in options.items() if value is not None}
        if chosen is MapKind.RECTANGLE and "corners" in given:
            given["pins"] = given.pop("corners")
        if given.get("seams") not in (None, "uv"):
            given["seams"] = os.path.abspath(given["seams"])  # a worker may run elsewhere
        _check(chosen, given)
        return cls(chosen, json.dumps(given, sort_keys=True), flags)

    def changed(self, options: Mapping[str, Any]) -> Plan:
        """The plan with some options of one mesh; a ``map`` among them takes the place of this one's."""
        changes = dict(options)
        kind = changes.pop("map", None) or self.kind
        return Plan.of(kind, {**self.given, **changes}, flags=self.flags) if options else self

    @property
    def given(self) -> dict[str, Any]:
        """The options that were given, by their names."""
        return json.loads(self.options)


def _check(kind: MapKind, given: dict[str, Any]) -> None:
    """Complain of what could not be taken, without a mesh."""
    sphere = kind is MapKind.SPHERE
    checked = (SphereOptions,) if sphere else CHARTS
    known = {field.name for one in checked for field in fields(one)} - NOT_ONES
    beside = FILE | ({"uv", "backend"} if sphere else {"seams", "backend", "laplacian", *VERTICES})
    unknown = sorted(given.keys() - known - beside)
    if unknown:
        listed = ", ".join(sorted(known | beside))
        raise OptionError(f"{', '.join(unknown)}: no option of the map {kind}; choose among {listed}.")
    for one in checked:
        own = {field.name for field in fields(one)} - NOT_ONES - (set() if sphere else set(VERTICES))
        one(**{name: given[name] for name in own & given.keys()})
    choose_backend(given.get("backend", "auto"))
    if sphere:
        SphereLayout.of("uv", given.get("uv", SphereLayout.NONE))
    else:
        Laplacian.of("laplacian", given.get("laplacian", Laplacian.AUTO))
        _check_vertices(kind, given)
    _check_file(given)


def _check_vertices(kind: MapKind, given: dict[str, Any]) -> None:
    for name in VERTICES:
        value = given.get(name)
        if value is not None and not all(type(one) is int for one in (value if isinstance(value, list) else [value])):
            raise OptionError(f"{name} is {value!r}; pass vertex indices.")
    if kind is MapKind.DISK:  # more pins than three are for several charts
        named = {name: given.get(name) for name in VERTICES if not isinstance(given.get(name), list)}
        pins = given.get("pins")
        DiskOptions(pins=tuple(pins) if isinstance(pins, list) and len(pins) == 3 else None, **_without(named, "pins"))


def _without(named: dict[str, Any], name: str) -> dict[str, Any]:
    return {key: value for key, value in named.items() if key != name}


def _check_file(given: dict[str, Any]) -> None:
    if not isinstance(given.get("split", False), bool):
        raise OptionError(f"split is {given['split']!r}; pass True or False.")
    format = given.get("format")
    if format is not None and f".{format}" not in WRITABLE:
        raise OptionError(f"format is {format!r}; choose {', '.join(one[1:] for one in WRITABLE)}.")


def _plain(name: str, value: Any) -> Any:
    """The value as JSON keeps it."""
    if isinstance(value, set | frozenset):
        raise OptionError(f"{name} is a set; pass a list, whose order is kept.")
    try:
        return json.loads(json.dumps(value, default=_from_numpy))
    except (TypeError, ValueError) as error:
        raise OptionError(f"{name} is {value!r}; pass a name, a number or a list of numbers.") from error


def _from_numpy(value: Any) -> Any:
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return os.fspath(value)

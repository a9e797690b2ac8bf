"""The options of the commands that map, all together, for a command that makes any of their maps.

They are read off these commands, so that an option of one of them is one here too. None stands for what is not given.
"""

from __future__ import annotations

import copy
import inspect
from collections.abc import Callable
from enum import StrEnum
from typing import Annotated, Any, get_args, get_type_hints

from ..errors import OptionError
from ..options import MapKind
from .disk import disk
from .free import free
from .numbers import four_numbers, three_numbers
from .rectangle import rectangle
from .sphere import sphere

__all__ = ["given_options", "map_parameters", "with_map_options"]

COMMANDS: dict[MapKind, Callable[..., None]] = {
    MapKind.DISK: disk,
    MapKind.FREE: free,
    MapKind.RECTANGLE: rectangle,
    MapKind.SPHERE: sphere,
}
OF_ONE_FILE = {"source", "target", "format", "json_file", "plot", "quiet"}
NUMBERS = {"pins": three_numbers, "corners": four_numbers, "landmarks": three_numbers}
PANEL = "Options of the maps"


def map_parameters() -> list[inspect.Parameter]:
    """A parameter for each option, which says in its help of which maps it is one where it is not one of all."""
    found: dict[str, list[tuple[MapKind, Any]]] = {}
    for kind, command in COMMANDS.items():
        for name, hint in get_type_hints(command, include_extras=True).items():
            if name not in OF_ONE_FILE | {"return"}:
                found.setdefault(name, []).append((kind, hint))
    return [_parameter(name, takers) for name, takers in found.items()]


def given_options(kind: MapKind, values: dict[str, Any]) -> dict[str, Any]:
    """The options that are given, as the map's function takes them.

    Raises
    ------
    OptionError
        One is no option of this map.
    """
    own = inspect.signature(COMMANDS[kind]).parameters
    given = {name: value for name, value in values.items() if value is not None}
    wrong = [f"--{name.replace('_', '-')}" for name in given if name not in own]
    if wrong:
        raise OptionError(f"{', '.join(wrong)}: no option of --map {kind}.")
    return {name: NUMBERS[name](value) if name in NUMBERS else value for name, value in given.items()}


def _parameter(name: str, takers: list[tuple[MapKind, Any]]) -> inspect.Parameter:
    kinds = [get_args(hint)[0] for _, hint in takers]
    info = copy.copy(get_args(takers[0][1])[1])
    info.rich_help_panel = PANEL
    if len(takers) < len(COMMANDS):
        info.help = f"{info.help} Of {', '.join(kind for kind, _ in takers)}."
    different = list(dict.fromkeys(kinds))
    kind = different[0] if len(different) == 1 else _either(name, different)
    return inspect.Parameter(
        name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[kind | None, info]
    )


def _either(name: str, choices: list[type[StrEnum]]) -> Any:
    """All names of several choices; the map says no to those that it does not take."""
    values = list(dict.fromkeys(str(member) for one in choices for member in one))
    return StrEnum(name, {value: value for value in values})


def with_map_options(command: Callable[..., None]) -> Callable[..., None]:
    """The command with a parameter for each option, of which it gets the values by name."""
    signature = inspect.signature(command, eval_str=True)
    own = [one for one in signature.parameters.values() if one.kind is not inspect.Parameter.VAR_KEYWORD]
    every = [*own, *map_parameters()]
    command.__signature__ = signature.replace(parameters=every)  # type: ignore[attr-defined]
    command.__annotations__ = {one.name: one.annotation for one in every}
    return command

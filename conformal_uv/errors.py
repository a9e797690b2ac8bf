"""The typed errors: every refusal says what came in, where, and what to do about it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import islice

__all__ = [
    "CancelledError",
    "ConformalUVError",
    "DegenerateFaceError",
    "DisconnectedError",
    "DuplicateFaceError",
    "FileFormatError",
    "MeshError",
    "MissingDependencyError",
    "NonFiniteError",
    "NonManifoldError",
    "OptionError",
    "OrientationError",
    "Remedy",
    "SolverError",
    "TopologyError",
    "UnreferencedVertexError",
    "listed",
]


@dataclass(frozen=True)
class Remedy:
    """A value of an option that would do; or, without a value, a function that does it instead.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> cuv.Remedy("closed", "cut").as_argument(), cuv.Remedy("closed", "cut").as_flag()
    ('pass closed="cut"', 'use --closed cut')
    """

    option: str
    value: str = ""

    def as_argument(self) -> str:
        """As one says it to a caller of the library."""
        return f'pass {self.option}="{self.value}"' if self.value else f"use {self.option}()"

    def as_flag(self) -> str:
        """As one says it to somebody at a shell."""
        return f"use --{self.option.replace('_', '-')} {self.value}" if self.value else ""


class ConformalUVError(Exception):
    """Base of every error raised on purpose by this package.

    Attributes
    ----------
    indices : tuple of int
        The vertices or faces the message speaks of (all of them), empty where none can be named.
    message : str
        What came in, and where.
    ways : tuple of str and Remedy
        What to do about it, one or the other; empty where the message says it.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> try:
    ...     cuv.disk_map([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 1]])
    ... except cuv.ConformalUVError as error:
    ...     print(type(error).__name__, error.indices, error)
    DegenerateFaceError (0,) 1 faces repeat a vertex: faces 0. Remove them.
    """

    def __init__(self, message: str, indices: Iterable[int] = (), ways: Sequence[str | Remedy] = ()) -> None:
        self.message, self.ways = message, tuple(ways)
        self.indices = tuple(int(i) for i in indices)
        super().__init__(self.told())

    def told(self, words: Callable[[Remedy], str] | None = None) -> str:
        """The message with what to do.

        Parameters
        ----------
        words : callable, optional
            How a remedy is said where this is shown ("set Closed Surfaces to Cut"), empty for one that is not at
            hand there; by default as an argument of the library.
        """
        say = words or Remedy.as_argument
        said = [text for text in (way if isinstance(way, str) else say(way) for way in self.ways) if text]
        if not said:
            return self.message
        sentence = ", or ".join([", ".join(said[:-1]), said[-1]] if len(said) > 1 else said)
        return f"{self.message} {sentence[0].upper()}{sentence[1:]}."

    def renumbered(self, faces: Sequence[int], vertices: Sequence[int]) -> ConformalUVError:
        """The same error for one who numbers faces and vertices otherwise.

        Parameters
        ----------
        faces, vertices : sequences of int
            The other number of each face and vertex; several faces may have one.
        """
        text, own = self.message, listed(self.indices)
        for kind, name in (("faces", faces), ("vertices", vertices)):
            if self.indices and f"{kind} {own}" in text:
                other = sorted({int(name[index]) for index in self.indices})
                text = text.replace(f"{kind} {own}", f"{kind} {listed(other)}")
                text = text.replace(f"{len(self.indices)} {kind}", f"{len(other)} {kind}")
                return type(self)(text, other, self.ways)
        return self


class MeshError(ConformalUVError, ValueError):
    """The mesh can not be mapped as it is."""


class NonFiniteError(MeshError):
    """A vertex has a coordinate that is NaN or infinite."""


class DegenerateFaceError(MeshError):
    """A face repeats a vertex or has no area."""


class DuplicateFaceError(MeshError):
    """Two faces have the same three vertices."""


class NonManifoldError(MeshError):
    """An edge has three or more faces, or the faces at a vertex do not form one fan."""


class OrientationError(MeshError):
    """Neighbouring faces are wound in opposite senses, or the surface has only one side."""


class UnreferencedVertexError(MeshError):
    """Vertices that belong to no face."""


class DisconnectedError(MeshError):
    """The mesh is in several pieces."""


class TopologyError(MeshError):
    """The surface is not of the type that the map needs (closed, several boundary loops, handles)."""


class OptionError(ConformalUVError, ValueError):
    """An option has a value that it does not take, or that does not fit this mesh."""


class FileFormatError(ConformalUVError, ValueError):
    """A file can not be read or written as a mesh."""


class SolverError(ConformalUVError, RuntimeError):
    """The numerical solution failed."""


class MissingDependencyError(ConformalUVError, ImportError):
    """An optional library that this function needs is not installed."""


class CancelledError(ConformalUVError):
    """The callback asked to stop; nothing was changed."""


def listed(indices: Iterable[int], most: int = 8) -> str:
    """The first few of many indices as text: ``3, 5, 8, ... (120 in all)``."""
    values = [int(i) for i in indices]
    text = ", ".join(str(i) for i in islice(values, most))
    return text if len(values) <= most else f"{text}, ... ({len(values)} in all)"

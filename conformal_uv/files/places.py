"""Where output goes: a regular file, which is replaced; or a stream or device, which is written into."""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Mapping
from pathlib import Path

from ..errors import FileFormatError, OptionError

__all__ = ["STANDARD_STREAM", "check_distinct", "check_place", "descriptor_of", "is_standard_output", "is_stream"]

STANDARD_STREAM = "-"
DESCRIPTOR = re.compile(r"/(?:dev/fd|proc/(?:self|\d+)/fd)/(\d+)")
NAMED = {"/dev/stdin": 0, "/dev/stdout": 1, "/dev/stderr": 2}
MOST_LINKS = 40

Place = str | os.PathLike[str]


def descriptor_of(path: Place) -> int | None:
    """The open descriptor that a path stands for: ``-``, /dev/stdout, /dev/fd/3, or a link to such."""
    name = os.fspath(path)
    if name == STANDARD_STREAM:
        return 1
    name = os.path.abspath(name)
    for _ in range(MOST_LINKS):
        if name in NAMED:
            return NAMED[name]
        found = DESCRIPTOR.fullmatch(name)
        if found:
            return int(found[1])
        try:
            link = os.readlink(name)
        except (OSError, ValueError, AttributeError):
            return None
        name = os.path.normpath(os.path.join(os.path.dirname(name), link))
    return None


def is_standard_output(path: Place | None) -> bool:
    """Whether writing there is writing to standard output."""
    return path is not None and descriptor_of(path) == 1


def is_stream(path: Place) -> bool:
    """Whether there is something that must be written into and not replaced: a descriptor, device, FIFO or socket."""
    if descriptor_of(path) is not None:
        return True
    try:
        return not (stat.S_ISREG(mode := os.stat(path).st_mode) or stat.S_ISDIR(mode))
    except (OSError, ValueError):
        return False


def check_place(path: Place) -> None:
    """Refuse, before any work is done, a place where nothing can be written.

    Raises
    ------
    FileFormatError
        The folder does not exist or is write-protected, or the file is a folder or write-protected.
    """
    if descriptor_of(path) is not None:
        return
    target = Path(os.path.realpath(path))
    if not target.parent.is_dir():
        raise FileFormatError(f"{path}: the folder {target.parent} does not exist; create it first")
    if target.is_dir():
        raise FileFormatError(f"{path}: this is a folder; give the name of a file")
    if not is_stream(path) and not os.access(target.parent, os.W_OK):
        raise FileFormatError(f"{path}: the folder {target.parent} is write-protected; choose another")
    if target.exists() and not os.access(target, os.W_OK):
        raise FileFormatError(f"{path}: the file is write-protected; choose another name")


def check_distinct(source: Place | None, outputs: Mapping[str, Place | None], *, in_place: str = "OUT") -> None:
    """Refuse two outputs with one path, and an output that would replace the input.

    Parameters
    ----------
    source : path-like, optional
        The input.
    outputs : dict of str to path-like
        By the name that the user knows them by; None where there is none.
    in_place : str
        The output that may be the input.

    Raises
    ------
    OptionError
        Naming the two.
    """
    given = [(name, path) for name, path in outputs.items() if path is not None]
    for k, (name, path) in enumerate(given):
        for other, there in given[:k]:
            if _one_place(path, there):
                raise OptionError(f"{other} and {name} are both {path}; give them different names.")
        read = source is not None and os.fspath(source) != STANDARD_STREAM
        if read and name != in_place and _one_place(path, source or ""):
            raise OptionError(f"{name} is the input, {path}; it would be replaced. Give it another name.")


def _one_place(one: Place, other: Place) -> bool:
    first, second = descriptor_of(one), descriptor_of(other)
    if first is not None or second is not None:
        return first == second
    if is_stream(one) or is_stream(other):
        return False  # such as /dev/null, which takes everything
    try:
        if os.path.samefile(one, other):
            return True
    except (OSError, ValueError):
        pass
    return os.path.normcase(os.path.realpath(one)) == os.path.normcase(os.path.realpath(other))

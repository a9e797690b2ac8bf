"""Replace a file in one step: after a failure the old one is still there, whole."""

from __future__ import annotations

import contextlib
import io
import os
import re
import secrets
import sys
from collections.abc import Iterator
from typing import BinaryIO

from ..errors import FileFormatError
from .places import descriptor_of, is_stream

__all__ = ["TEMPORARY", "replaced_file"]

TEMPORARY = re.compile(r"\.[0-9a-f]{16}\.tmp")  # names of files that are to replace others


@contextlib.contextmanager
def replaced_file(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """A binary stream whose content becomes ``path`` when the block ends without an error.

    The content goes to a temporary file beside the target, is flushed to the disk and renamed over it. A file
    that is replaced keeps its permissions, a new one gets those of the umask; a symbolic link is followed. What is no
    regular file (``-`` and /dev/stdout, a device, a FIFO) is written into, at the end of the block.

    Raises
    ------
    FileFormatError
        The file can not be written. The target is then as it was, and so it is after any other error.
    """
    if is_stream(path):
        yield from _written_into(path)
        return
    target = os.path.realpath(path)
    temporary = os.path.join(os.path.dirname(target), f".{secrets.token_hex(8)}.tmp")
    try:
        # Created with 0o666 so that the umask applies; tempfile would make it private to the user.
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
        descriptor = os.open(temporary, flags, 0o666)
        try:
            with os.fdopen(descriptor, "wb") as stream:
                yield stream
                stream.flush()
                os.fsync(stream.fileno())
            with contextlib.suppress(FileNotFoundError):
                os.chmod(temporary, os.stat(target).st_mode & 0o7777)
            os.replace(temporary, target)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(temporary)
            raise
    except OSError as error:
        reason = error.strerror or str(error)
        raise FileFormatError(f"{path}: can not be written: {reason}; the file is left as it was") from error


def _written_into(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """A stream in memory, whose content goes to a descriptor, device or FIFO in the end."""
    content = io.BytesIO()
    yield content
    descriptor = descriptor_of(path)
    try:
        if descriptor == 1:
            sys.stdout.flush()
        # A descriptor is not opened anew by its name: that would begin at the start of a file behind it.
        with open(path if descriptor is None else os.dup(descriptor), "wb", buffering=0) as stream:
            left = memoryview(content.getbuffer())
            while len(left):
                left = left[stream.write(left) :]
    except BrokenPipeError:
        raise
    except OSError as error:
        raise FileFormatError(f"{path}: can not be written: {error.strerror or error}") from error

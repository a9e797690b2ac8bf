"""Text as a terminal may see it, and warnings on it."""

from __future__ import annotations

import logging
import sys
import unicodedata

__all__ = ["WarningsOnStderr", "plain"]

UNSEEN = {"Cc", "Cf", "Zl", "Zp", "Cs"}  # controls, formatting (bidirectional overrides), line breaks, surrogates


def plain(text: str) -> str:
    """The text with what could command a terminal written out, such as \\x1b; blanks and line ends are kept."""
    return "".join(
        char if char in " \n\t" or unicodedata.category(char) not in UNSEEN else ascii(char)[1:-1] for char in text
    )


class WarningsOnStderr(logging.Handler):
    """Warnings of the library as lines on stderr; nothing at all where `quiet`."""

    def __init__(self, *, quiet: bool) -> None:
        super().__init__(logging.WARNING)
        self._quiet = quiet

    def emit(self, record: logging.LogRecord) -> None:
        if not self._quiet:
            sys.stderr.write(f"warning: {plain(record.getMessage())}\n")

"""The corners of OBJ elements, ``a``, ``a/t``, ``a//n`` or ``a/t/n``: their indices and where they stand."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from conformal_uv.files.text_lines import BLANK, TextLines

__all__ = ["Elements", "scan_elements"]

Ints = NDArray[np.int64]

SLASH, MINUS, ZERO = b"/-0"
DIGITS = 18
WELL_FORMED = re.compile(rb"\s*\w+(\s+-?\d{1,18}(/|//|/-?\d{1,18}/?|/(-?\d{1,18})?/-?\d{1,18})?)*\s*")


@dataclass(frozen=True, eq=False)
class Elements:
    """Corners of faces and lines, in file order.

    Attributes
    ----------
    line : (e,) int64
        The line of each element.
    sizes : (e,) int64
        Its number of corners.
    vertex, texture : (c,) int64
        Indices as written (from 1, or negative); texture is 0 where there is none.
    vertex_end, texture_end : (c,) int64
        Where the vertex index and the texture index end in the file (both the same, or after an empty one's
        slash, where there is none).
    """

    line: Ints
    sizes: Ints
    vertex: Ints
    texture: Ints
    vertex_end: Ints
    texture_end: Ints


def scan_elements(lines: TextLines, chosen: Ints) -> Elements:
    """The corners of the chosen (ascending) lines, each a keyword followed by corners.

    Raises
    ------
    FileFormatError
        A word is not a corner.
    """
    sizes = lines.counts[chosen] - 1
    text, places = _only(lines, chosen)
    digit = (text - ZERO) < 10
    edges = np.flatnonzero(digit[1:] != digit[:-1]) + 1
    starts, ends = edges[::2], edges[1::2]
    negative = text[starts - 1] == MINUS
    head = starts - negative
    before, second = text[head - 1], text[head - 2]
    opens = before <= BLANK
    texture = _after(opens) & (before == SLASH) & digit[head - 2]
    normal = _after(texture) & (before == SLASH) & digit[head - 2]
    normal |= _after(opens) & (before == SLASH) & (second == SLASH) & digit[head - 3]
    known = [digit, negative, texture, normal, normal & (second == SLASH)]
    inked = sum(int(np.count_nonzero(part)) for part in known)
    sound = (opens | texture | normal).all() and inked == np.count_nonzero(text > BLANK)
    if not sound or opens.sum() != sizes.sum() or (ends - starts).max(initial=0) > DIGITS:
        raise _malformed(lines, chosen)
    at = np.flatnonzero(texture)
    corner = np.cumsum(opens)[at] - 1
    vertex_end = places(ends[opens])
    texture_end = vertex_end + (lines.text[vertex_end] == SLASH)
    texture_end[corner] = places(ends[at])
    indices = np.zeros(len(vertex_end), np.int64)
    indices[corner] = _integers(text, starts[at], ends[at], negative[at])
    vertex = _integers(text, starts[opens], ends[opens], negative[opens])
    return Elements(chosen, sizes, vertex, indices, vertex_end, texture_end)


def _only(lines: TextLines, chosen: Ints) -> tuple[NDArray[np.uint8], Callable[[Ints], Ints]]:
    """The text of the chosen lines but for their keywords, run together and padded on both sides, and the way back:
    places in the file of (the ends of words at) places in it."""
    begins, ends = lines.runs(chosen)
    lengths = ends - begins
    shift = begins - (np.cumsum(lengths) - lengths) - 3
    text = np.full(int(lengths.sum()) + 3 + DIGITS, BLANK, np.uint8)
    for at, begin, end in zip((begins - shift).tolist(), begins.tolist(), ends.tolist(), strict=True):
        text[at : at + end - begin] = lines.text[begin:end]

    def run_of(place: Ints) -> Ints:
        return np.searchsorted(begins, place, side="right") - 1

    keywords = lines.tokens[lines.first[chosen]]
    text[keywords - shift[run_of(keywords)]] = BLANK  # one letter
    # "1/" and "1//": empty indices, as some programs write them
    for _ in range(2):
        open_slash = np.flatnonzero((text[:-1] == SLASH) & (text[1:] <= BLANK))
        text[open_slash] = BLANK

    def places(found: Ints) -> Ints:
        return found + shift[np.searchsorted(begins - shift, found - 1, side="right") - 1]

    return text, places


def _after(flag: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """True where the number before is flagged."""
    return np.concatenate([np.zeros(1, dtype=bool), flag])[:-1]


def _integers(text: NDArray[np.uint8], starts: Ints, ends: Ints, negative: NDArray[np.bool_]) -> Ints:
    value = np.zeros(len(starts), np.int64)
    length = ends - starts
    for k in range(int(length.max()) if len(length) else 0):
        further = value * 10 + (text[starts + k] - ZERO)
        value = np.where(k < length, further, value)
    return np.where(negative, -value, value)


def _malformed(lines: TextLines, chosen: Ints) -> Exception:
    for line in chosen.tolist():
        text = lines.text[lines.starts[line] : lines.ends[line]].tobytes()
        if not WELL_FORMED.fullmatch(text):
            return lines.error(line, "not a list of vertex indices such as 3, 3/7, 3//5 or 3/7/5")
    return lines.error(int(chosen[0]), "a vertex index that is not understood, on this line or below")

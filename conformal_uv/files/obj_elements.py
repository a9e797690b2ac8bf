"""The corners of OBJ elements, ``a``, ``a/t``, ``a//n`` or ``a/t/n``: their indices and where they stand."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .text_lines import BLANK, TextLines
from .text_numbers import whole_numbers

__all__ = ["Elements", "scan_elements"]

Ints = NDArray[np.int64]

SLASH, MINUS, ZERO = b"/-0"
DIGITS = 18
NOWHERE = np.empty(0, np.int64)
WELL_FORMED = re.compile(rb"\s*\w+(\s+-?\d{1,18}(/|//|/-?\d{1,18}/?|/(-?\d{1,18})?/-?\d{1,18})?)*\s*")


@dataclass(frozen=True, eq=False)
class Elements:
    """Corners of faces and lines, in file order; places count from the beginning of the block of lines.

    Attributes
    ----------
    line : (e,) int64
        The line of each element.
    sizes : (e,) int64
        Its number of corners.
    vertex, texture : (c,) int64
        Indices as written (from 1, or negative); texture is 0 where there is none.
    vertex_end, texture_end : (c,) int64
        Where the vertex index and the texture index end in the lines' text (both the same, or after an empty one's
        slash, where there is none); empty where they were not asked for.
    """

    line: Ints
    sizes: Ints
    vertex: Ints
    texture: Ints
    vertex_end: Ints
    texture_end: Ints


def scan_elements(lines: TextLines, chosen: Ints, *, places: bool = False) -> Elements:
    """The corners of the chosen (ascending) lines, each a keyword followed by corners.

    ``places`` tells to find where their indices end, too.

    Raises
    ------
    FileFormatError
        A word is not a corner.
    """
    sizes = lines.counts[chosen] - 1
    text, at = lines.behind(chosen, 1)
    raw = text.tobytes()
    if b"/" not in raw and b"+" not in raw:
        vertex = whole_numbers(raw, int(sizes.sum()))
        if vertex is None:
            raise _malformed(lines, chosen)
        inked = text > BLANK
        ends = at[np.flatnonzero(inked[:-1] & ~inked[1:])] + 1 if places else NOWHERE
        return Elements(chosen, sizes, vertex, np.zeros(len(vertex), np.int64), ends, ends)
    padded = np.full(len(text) + 3 + DIGITS, BLANK, np.uint8)
    padded[3 : 3 + len(text)] = text
    corners = _corners(padded, int(sizes.sum()))
    if corners is None:
        raise _malformed(lines, chosen)
    vertex, texture, vertex_end, texture_end = corners
    if places:
        none = texture_end == vertex_end
        vertex_end, texture_end = at[vertex_end - 4] + 1, at[texture_end - 4] + 1
        texture_end += none & (lines.text[vertex_end] == SLASH)
    return Elements(chosen, sizes, vertex, texture, vertex_end, texture_end)


def _corners(text: NDArray[np.uint8], count: int) -> tuple[Ints, Ints, Ints, Ints] | None:
    """Vertex and texture indices of the corners, and where they end in the text; None if a word is not a corner."""
    digit = (text - ZERO) < 10
    edges = np.flatnonzero(digit[1:] != digit[:-1]) + 1
    alike = _alike_corners(text, digit, edges, count)
    if alike is not None:
        return alike
    # "1/" and "1//": empty indices, as some programs write them
    for _ in range(2):
        text[np.flatnonzero((text[:-1] == SLASH) & (text[1:] <= BLANK))] = BLANK
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
    if not sound or np.count_nonzero(opens) != count or (ends - starts).max(initial=0) > DIGITS:
        return None
    text[text == SLASH] = BLANK
    values = whole_numbers(text.tobytes(), len(starts))
    if values is None:
        return None
    at = np.flatnonzero(texture)
    corner = np.cumsum(opens)[at] - 1
    found, texture_end = np.zeros(count, np.int64), ends[opens]
    found[corner], texture_end[corner] = values[at], ends[at]
    return values[opens], found, ends[opens], texture_end


def _alike_corners(
    text: NDArray[np.uint8], digit: NDArray[np.bool_], edges: Ints, count: int
) -> tuple[Ints, Ints, Ints, Ints] | None:
    """The same where all corners are a/t or all are a/t/n, of positive numbers; else None."""
    slashes = int(np.count_nonzero(text == SLASH))
    each = 1 + slashes // max(count, 1)
    if each not in (2, 3) or len(edges) != 2 * each * count or slashes != (each - 1) * count:
        return None
    numbers = edges.reshape(count, each, 2)
    stops, next_starts = numbers[:, :-1, 1], numbers[:, 1:, 0]
    if np.count_nonzero(digit) + slashes != np.count_nonzero(text > BLANK) or (text[stops] != SLASH).any():
        return None
    if (next_starts - stops != 1).any() or (edges[1::2] - edges[::2]).max() > DIGITS:
        return None
    text[text == SLASH] = BLANK
    values = whole_numbers(text.tobytes(), each * count)
    if values is None:
        return None
    vertex, texture = values.reshape(count, each)[:, :2].T
    return vertex, texture, numbers[:, 0, 1], numbers[:, 1, 1]


def _after(flag: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """True where the number before is flagged."""
    return np.concatenate([np.zeros(1, dtype=bool), flag])[:-1]


def _malformed(lines: TextLines, chosen: Ints) -> Exception:
    for line in chosen.tolist():
        text = lines.text[lines.starts[line] : lines.ends[line]].tobytes()
        if not WELL_FORMED.fullmatch(text):
            return lines.error(line, "not a list of vertex indices such as 3, 3/7, 3//5 or 3/7/5")
    return lines.error(int(chosen[0]), "a vertex index that is not understood, on this line or below")

"""Properties dropped from and added to the rows of a PLY element; all else stays in the file's own bytes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..digits import whole_texts
from ..float_texts import float_rows
from ..splice import spliced
from ..text_lines import BLANK, NEWLINE
from .binary_rows import EvenRows, UnevenRows
from .header import PlyProperty
from .lists import packed
from .rows import Ints
from .source import PlyRows
from .text_rows import TextBlock, TextRows

__all__ = ["Added", "changed_rows"]

ROWS = 1 << 16  # changed together


@dataclass(frozen=True, eq=False)
class Added:
    """A new property and its values; of a list run together, with the length of each row's."""

    property: PlyProperty
    values: NDArray[Any]
    lengths: Ints | None = None

    def part(self, begin: int, end: int, starts: Ints | None) -> Added:
        """The same for some rows; ``starts`` is where the values of each row begin, and one behind."""
        if self.lengths is None or starts is None:
            return Added(self.property, self.values[begin:end])
        return Added(self.property, self.values[starts[begin] : starts[end]], self.lengths[begin:end])


def changed_rows(data: bytes, rows: PlyRows, order: str, dropped: list[str], added: list[Added]) -> Iterator[bytes]:
    """The rows without the properties dropped (by name) and with those added at their ends."""
    gone = [p for p in rows.element.properties if p.name in dropped]
    if not gone and not added:
        yield data[rows.begin : rows.end]
        return
    starts = [None if a.lengths is None else np.append(0, np.cumsum(a.lengths)) for a in added]

    def parts(begin: int, end: int) -> list[Added]:
        return [a.part(begin, end, s) for a, s in zip(added, starts, strict=True)]

    if isinstance(rows, TextRows):
        for block in rows.blocks():
            yield _text(rows, block, gone, parts(block.row, block.row + len(block.first) - 1))
        return
    even = isinstance(rows, EvenRows) and all(a.lengths is None or _constant(a.lengths) for a in added)
    for begin in range(0, rows.element.count, ROWS):
        end = min(begin + ROWS, rows.element.count)
        if even and isinstance(rows, EvenRows):
            yield _records(rows, order, begin, end, gone, parts(begin, end))
        else:
            yield _spliced(data, rows, order, begin, end, gone, parts(begin, end))


def _constant(lengths: Ints) -> bool:
    return bool((lengths == lengths[0]).all()) if len(lengths) else False


def _records(rows: EvenRows, order: str, begin: int, end: int, gone: list[PlyProperty], added: list[Added]) -> bytes:
    """Records of the bytes that stay, each stretch of them one field, and of the new columns."""
    width = rows.rows.dtype.itemsize
    cuts = [0, *(at for p in gone for at in rows.span(p)), width]
    kept = [(a, b) for a, b in zip(cuts[::2], cuts[1::2], strict=True) if b > a]
    fields: list[Any] = [(f"kept {a}", f"V{b - a}") for a, b in kept]
    for k, new in enumerate(added):
        if new.lengths is not None:
            fields.append((f"length {k}", order + new.property.length))
        shape = () if new.lengths is None else (int(new.lengths[0]),)
        fields.append((f"new {k}", order + new.property.type, shape))
    changed = np.empty(end - begin, fields)
    old = rows.rows[begin:end]
    for a, b in kept:
        there: Any = {"names": ["part"], "formats": [f"V{b - a}"], "offsets": [a], "itemsize": width}
        changed[f"kept {a}"] = old.view(there)["part"]
    for k, new in enumerate(added):
        changed[f"new {k}"] = new.values.reshape(changed[f"new {k}"].shape)
        if new.lengths is not None:
            changed[f"length {k}"] = new.lengths[0]
    return changed.tobytes()


def _spliced(
    data: bytes,
    rows: EvenRows | UnevenRows,
    order: str,
    begin: int,
    end: int,
    gone: list[PlyProperty],
    added: list[Added],
) -> bytes:
    """The bytes of some rows with spans of them left out and the new values behind each."""
    some = slice(begin, end)
    last = rows.spans(rows.element.properties[-1], some)[1]
    first = rows.spans(rows.element.properties[0], some)[0]
    spans = [rows.spans(p, some) for p in gone]
    starts = np.concatenate([last, *(s for s, _ in spans)])
    ends = np.concatenate([last, *(e for _, e in spans)])
    block, lengths = _joined([_binary(new, order) for new in added], end - begin)
    lengths = np.concatenate([lengths, np.zeros(len(starts) - len(last), np.int64)])
    sort = np.argsort(starts, kind="stable")  # what is new at a row's end, then what is dropped at the next row's start
    at = int(first[0])
    return spliced(data[at : int(last[-1])], starts[sort] - at, ends[sort] - at, block, lengths[sort])


def _binary(new: Added, order: str) -> tuple[NDArray[np.uint8], Ints]:
    if new.lengths is not None:
        return packed(new.values, new.lengths, order + new.property.length, order + new.property.type)
    raw = new.values.astype(order + new.property.type)
    return raw.view(np.uint8), np.full(len(raw), raw.itemsize, np.int64)


def _joined(parts: list[tuple[NDArray[np.uint8], Ints]], count: int) -> tuple[NDArray[np.uint8], Ints]:
    """Several byte strings for each row, put together row by row."""
    raw, lengths = np.empty(0, np.uint8), np.zeros(count, np.int64)
    for more, sizes in parts:
        at = np.cumsum(lengths)
        raw = np.frombuffer(spliced(raw.tobytes(), at, at, more, sizes), np.uint8)
        lengths = lengths + sizes
    return raw, lengths


def _text(rows: TextRows, block: TextBlock, gone: list[PlyProperty], added: list[Added]) -> bytes:
    """Lines without some words and with the new ones at their ends, where blanks go."""
    text, first = block.text, block.first
    if gone:
        _, places, lengths = rows.layout(block)
        words = np.append(block.words, len(text))
        spans = []
        for p in gone:
            at = places[p.name]
            spans.append((words[at], words[at + 1 + lengths.get(p.name, 0)]))
            first = first - np.append(0, np.cumsum(1 + lengths.get(p.name, np.zeros(len(at), np.int64))))
        newlines = _newlines(text)
        starts = np.concatenate([s for s, _ in spans])
        stops = np.minimum(np.concatenate([e for _, e in spans]), np.tile(newlines, len(spans)))
        sort = np.argsort(starts)
        nothing = np.zeros(len(starts), np.int64)
        text = spliced(text, starts[sort], stops[sort], np.empty(0, np.uint8), nothing)
    new, sizes = _texts(added, len(first) - 1)
    return spliced(text, _line_ends(text, first), _newlines(text), new, sizes)


def _newlines(text: bytes) -> Ints:
    return np.flatnonzero(np.frombuffer(text, np.uint8) == NEWLINE)


def _line_ends(text: bytes, first: Ints) -> Ints:
    """Where each line's last word ends; ``first`` counts the words before each line and before the end."""
    inked = np.frombuffer(text, np.uint8) > BLANK
    return (np.flatnonzero(inked[:-1] & ~inked[1:]) + 1)[first[1:] - 1]


def _texts(added: list[Added], count: int) -> tuple[NDArray[np.uint8], Ints]:
    """What is added to each row."""
    if added and all(new.lengths is None and new.values.dtype == np.float64 for new in added):
        raw, sizes = float_rows(np.column_stack([new.values for new in added]))
        return np.frombuffer(raw, np.uint8), sizes
    return _joined([_words(new) for new in added], count)


def _words(new: Added) -> tuple[NDArray[np.uint8], Ints]:
    """A new property's text row by row, a blank before each number."""
    if new.values.dtype.kind == "f":
        raw, sizes = float_rows(new.values[:, None])
    else:
        raw, sizes = whole_texts(new.values, b" ")
    text = np.frombuffer(raw, np.uint8)
    if new.lengths is None:
        return text, sizes
    at = np.append(0, np.cumsum(sizes))[np.append(0, np.cumsum(new.lengths))]
    raw, sizes = whole_texts(new.lengths, b" ")
    return _joined([(np.frombuffer(raw, np.uint8), sizes), (text, np.diff(at))], len(sizes))

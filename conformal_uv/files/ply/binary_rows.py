"""Rows of a binary PLY element: one record type where every list has one length, else the places of the lists."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .header import PlyElement, PlyProperty
from .list_places import first_cut, first_lengths, list_places, lists_of
from .lists import gathered
from .rows import Ints, damaged_row, kept_type

__all__ = ["EvenRows", "UnevenRows", "binary_rows"]

ALL = slice(None)


def binary_rows(path: Path, data: bytes, begin: int, element: PlyElement, order: str) -> EvenRows | UnevenRows:
    """The rows of an element that begin there.

    Raises
    ------
    FileFormatError
        The file ends before them, or a list has a negative length.
    """
    if not element.properties:
        return EvenRows(element, begin, begin, np.empty(0, np.uint8))
    first = first_lengths(data, begin, element, order)
    if first is not None:
        dtype = _record(element, order, first)
        if begin + element.count * dtype.itemsize <= len(data):
            rows: NDArray[Any] = np.ndarray(element.count, dtype, data, begin)
            if all((rows[_length(p)] == n).all() for p, n in zip(lists_of(element), first, strict=True)):
                return EvenRows(element, begin, begin + rows.nbytes, rows)
    return UnevenRows(path, data, begin, element, order)


def _length(p: PlyProperty) -> str:
    """The field of a record that holds the length of a list; no property's name has a line's end."""
    return f"{p.name}\nlength"


def _record(element: PlyElement, order: str, lengths: list[int]) -> np.dtype[Any]:
    """The type of rows whose lists have these lengths."""
    fields: list[Any] = []
    left = iter(lengths)
    for p in element.properties:
        if p.length:
            fields += [(_length(p), order + p.length), (p.name, order + p.type, (next(left),))]
        else:
            fields.append((p.name, order + p.type))
    return np.dtype(fields)


class EvenRows:
    """Rows whose lists all have one length: records in the file's own bytes."""

    def __init__(self, element: PlyElement, begin: int, end: int, rows: NDArray[Any]) -> None:
        self.element, self.begin, self.end, self.rows = element, begin, end, rows

    def columns(self, wanted: list[PlyProperty]) -> list[NDArray[Any]]:
        """Scalar properties."""
        return [self.rows[p.name] for p in wanted]

    def lists(self, wanted: list[PlyProperty]) -> list[tuple[NDArray[Any], Ints]]:
        """List properties."""
        values = [self.rows[p.name].astype(kept_type(p)) for p in wanted]
        return [(v.reshape(-1), np.broadcast_to(np.int64(v.shape[1]), len(v))) for v in values]

    def span(self, p: PlyProperty) -> tuple[int, int]:
        """Where a property stands in each row, its length included."""
        end = 0
        for q in self.element.properties:
            begin = end
            end += int(q.length[1] if q.length else 0) + self.rows.dtype[q.name].itemsize
            if q is p:
                break
        return begin, end

    def spans(self, p: PlyProperty, rows: slice) -> tuple[Ints, Ints]:
        """Where a property stands in the file, row by row, the length of a list included."""
        at = self.begin + self.rows.dtype.itemsize * np.arange(self.element.count)[rows]
        begin, end = self.span(p)
        return at + begin, at + end


class UnevenRows:
    """Rows with lists of different lengths: their places in the file."""

    def __init__(self, path: Path, data: bytes, begin: int, element: PlyElement, order: str) -> None:
        self.element, self.begin, self.order, self.data = element, begin, order, data
        lists = lists_of(element)
        count = element.count * len(lists)
        try:
            places = np.fromiter(list_places(data, begin, element, order), np.int64, count)
            self.places = places.reshape(element.count, len(lists)).T
            negative = np.flatnonzero(np.any([self.lengths(p) < 0 for p in lists], axis=0))
            self.end = int(self.spans(element.properties[-1])[1][-1])
        except (struct.error, IndexError):
            self.end = len(data) + 1
        if self.end > len(data):
            raise damaged_row(path, element, first_cut(data, begin, element, order), "the file ends within it")
        if len(negative):
            raise damaged_row(path, element, int(negative[0]), "a list of negative length")

    def lengths(self, p: PlyProperty, rows: slice = ALL) -> Ints:
        """The length of each row's list."""
        at = self.places[lists_of(self.element).index(p), rows]
        return gathered(self.data, at, np.ones(len(at), np.int64), self.order + p.length).astype(np.int64)

    def columns(self, wanted: list[PlyProperty]) -> list[NDArray[Any]]:
        """Scalar properties."""
        one = np.ones(self.element.count, np.int64)
        return [gathered(self.data, self.spans(p)[0], one, self.order + p.type) for p in wanted]

    def lists(self, wanted: list[PlyProperty]) -> list[tuple[NDArray[Any], Ints]]:
        """List properties."""
        found = []
        for p in wanted:
            lengths = self.lengths(p)
            at = self.places[lists_of(self.element).index(p)] + int(p.length[1])
            values = gathered(self.data, at, lengths, self.order + p.type)
            found.append((values.astype(kept_type(p), copy=False), lengths))
        return found

    def spans(self, p: PlyProperty, rows: slice = ALL) -> tuple[Ints, Ints]:
        """Where a property stands in the file, row by row, the length of a list included."""
        before = 0
        for q in self.element.properties:
            if q.length:
                break
            before += int(q.type[1])
        starts = ends = self.places[0, rows] - before
        for q in self.element.properties:
            starts = ends
            ends = starts + int(q.type[1]) * (self.lengths(q, rows) if q.length else 1)
            ends = ends + (int(q.length[1]) if q.length else 0)
            if q is p:
                break
        return starts, ends

"""PLY: every type and form of rows, what is kept byte for byte, and damage named by its place.

The oracle for values is struct, or plyfile reading the same bytes.
"""

from __future__ import annotations

import io
import struct
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import plyfile
import pytest

from conformal_uv.errors import FileFormatError
from conformal_uv.files import read_mesh, write_mesh
from conformal_uv.files.ply import change, text_rows

CODES = {
    "char": "b",
    "uchar": "B",
    "short": "h",
    "ushort": "H",
    "int": "i",
    "uint": "I",
    "float": "f",
    "double": "d",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "float32": "f",
    "float64": "d",
}
WHOLE = [name for name, code in CODES.items() if code not in "fd"]
FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
Row = list[float | list[float]]


def encoded(order: str, kinds: list[str], rows: list[Row]) -> bytes:
    """Rows of scalars and lists; a list's kind is "length value"."""
    out = b""
    for row in rows:
        words: list[str] = []
        for kind, value in zip(kinds, row, strict=True):
            names = kind.split()
            values = list(value) if isinstance(value, list) else [value]
            if len(names) == 2:
                words.append(str(len(values)))
                out += struct.pack(order + CODES[names[0]], len(values)) if order else b""
            words += map(str, values)
            out += struct.pack(f"{order}{len(values)}{CODES[names[-1]]}", *values) if order else b""
        out += b"" if order else " ".join(words).encode() + b"\n"
    return out


def ply(form: str, *elements: tuple[str, dict[str, str], list[Row]], comments: bool = True) -> bytes:
    """A file of elements: name, property kinds by name, rows."""
    lines = ["ply", f"format {form} 1.0"] + ["comment made  by hand", "obj_info x 1"] * comments
    for name, properties, rows in elements:
        lines.append(f"element {name} {len(rows)}")
        for property_name, kind in properties.items():
            lines.append(f"property {'list ' * (' ' in kind)}{kind} {property_name}")
        lines += [f"comment after {name}"] * comments
    body = b"".join(encoded(FORMATS[form], list(kinds.values()), rows) for _, kinds, rows in elements)
    return ("\n".join(lines) + "\nend_header\n").encode() + body


def saved(folder: Path, data: bytes) -> Path:
    path = folder / "a.ply"
    path.write_bytes(data)
    return path


XYZ = dict.fromkeys("xyz", "float")
POINTS: list[Row] = [[0, 0, 0], [1, 0, 0.5], [1, 1, 0.25], [0, 1, 0], [2, 2, 0]]
POLYGONS: list[Row] = [[[0, 1, 2]], [[0, 1, 2, 3]], [[4, 3, 2, 1, 0]], [[2, 1, 0]]]
CORNERS = [0, 1, 2, 0, 1, 2, 3, 4, 3, 2, 1, 0, 2, 1, 0]
FACES = {"vertex_indices": "uchar int"}


def by_plyfile(data: bytes) -> plyfile.PlyData:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return plyfile.PlyData.read(io.BytesIO(data))


def same_values(a: np.ndarray, b: np.ndarray) -> bool:
    return len(a) == len(b) and all(np.array_equal(x, y) for x, y in zip(a, b, strict=True))


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("kind", CODES)
def test_coordinates_of_every_type(tmp_path: Path, form: str, kind: str) -> None:
    ends = {"f": [-(2.0**-149), 1.5], "d": [-5e-324, 0.1]}
    low, high = (
        ends.get(CODES[kind])
        or {
            "b": [-128, 127],
            "B": [0, 255],
            "h": [-(2**15), 2**15 - 1],
            "H": [0, 2**16 - 1],
            "i": [-(2**31), 2**31 - 1],
            "I": [0, 2**32 - 1],
        }[CODES[kind]]
    )
    rows: list[Row] = [[low, 0, high], [0, high, low], [high, low, 0]]
    data = ply(form, ("vertex", dict.fromkeys("xyz", kind), rows), ("face", FACES, [[[0, 1, 2]]]))
    assert read_mesh(saved(tmp_path, data)).mesh.V.tolist() == rows


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("length", WHOLE)
@pytest.mark.parametrize("value", WHOLE)
@pytest.mark.parametrize("even", [False, True])
def test_indices_of_every_type(tmp_path: Path, form: str, length: str, value: str, even: bool) -> None:
    rows = POLYGONS[:1] * 3 if even else POLYGONS
    data = ply(form, ("vertex", XYZ, POINTS), ("face", {"vertex_index": f"{length} {value}"}, rows))
    mesh = read_mesh(saved(tmp_path, data)).mesh
    assert mesh.corners.tolist() == ([0, 1, 2] * 3 if even else CORNERS)
    assert mesh.sizes.tolist() == ([3] * 3 if even else [3, 4, 5, 3])


AROUND = {"a": "short", "w": "ushort float", "b": "double", "vertex_indices": "uchar int", "c": "uchar"}


def around(rows: list[Row], other: Callable[[int], int]) -> list[Row]:
    """Faces with scalars and another list around their indices."""
    return [[k - 300, [0.1 * k] * other(k), k / 3, row[0], k] for k, row in enumerate(rows)]


OTHERS = {"even": lambda k: 2, "empty": lambda k: 0, "mixed": lambda k: k % 3}


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("other", OTHERS)
@pytest.mark.parametrize("faces", ["even", "mixed"])
@pytest.mark.parametrize("uv", ["vertex", "corner", "some"])
def test_what_stands_around_indices_stays(tmp_path: Path, form: str, other: str, faces: str, uv: str) -> None:
    """plyfile reads every other property and element as it was; an element without changes has the same bytes."""
    polygons = [POLYGONS[0]] * 4 if faces == "even" else POLYGONS
    points: list[Row] = [[7, *p, 0.5, k] for k, p in enumerate(POINTS)]
    kinds = {"q": "int", **XYZ, "u": "float", "v": "float"}
    strange: list[Row] = [[1, [1, 2, 3]], [2, []], [3, [4]]]
    end: list[Row] = [[5]]
    data = ply(
        form,
        ("strange", {"n": "char", "l": "uchar uint"}, strange),
        ("vertex", kinds, points),
        ("face", AROUND, around(polygons, OTHERS[other])),
        ("end", {"e": "int16"}, end),
    )
    source = read_mesh(saved(tmp_path, data))
    count = len(source.mesh.corners)
    assert source.corner_uv is not None and source.corner_uv.tolist() == [[0.5, k] for k in source.mesh.corners]
    new = np.arange(2.0 * count).reshape(-1, 2) / 8
    if uv == "vertex":
        new = np.stack([source.mesh.corners, -source.mesh.corners], axis=1) / 8
    if uv == "some":
        new[:3] = np.nan
    write_mesh(tmp_path / "b.ply", source, corner_uv=new)
    written = (tmp_path / "b.ply").read_bytes()
    old, found = by_plyfile(data), by_plyfile(written)
    assert [e.name for e in found] == [e.name for e in old]
    for a in old:
        for p in a.properties:
            if p.name not in "uv":
                assert same_values(found[a.name][p.name], a[p.name]), (a.name, p.name)
    order = FORMATS[form]
    assert written.endswith(encoded(order, ["int16"], end))
    assert written.partition(b"end_header\n")[2].startswith(encoded(order, ["char", "uchar uint"], strange))
    expected = np.where(np.isnan(new), source.corner_uv, new)
    again = read_mesh(tmp_path / "b.ply")
    np.testing.assert_array_equal(again.corner_uv, expected)
    write_mesh(tmp_path / "c.ply", again, corner_uv=source.corner_uv[:, ::-1])  # drops what was added
    np.testing.assert_array_equal(read_mesh(tmp_path / "c.ply").corner_uv, source.corner_uv[:, ::-1])
    assert same_values(by_plyfile((tmp_path / "c.ply").read_bytes())["face"]["w"], old["face"]["w"])


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("place", [0, 1, 2])
@pytest.mark.parametrize("faces", ["even", "mixed"])
def test_texture_numbers_go_wherever_they_stand(tmp_path: Path, form: str, place: int, faces: str) -> None:
    polygons = [p[0] for p in ([POLYGONS[0]] * 4 if faces == "even" else POLYGONS)]
    columns = {"vertex_indices": "uchar int", "flag": "short"}
    names = list(columns)
    names.insert(place, "texcoord")
    kinds = {n: columns.get(n, "uchar float") for n in names}
    values = {"vertex_indices": lambda p: p, "flag": len, "texcoord": lambda p: [0.5] * (2 * len(p))}
    rows = [[values[n](p) for n in names] for p in polygons]
    source = read_mesh(saved(tmp_path, ply(form, ("vertex", XYZ, POINTS), ("face", kinds, rows))))
    assert source.corner_uv is not None and (source.corner_uv == 0.5).all()
    uv = np.stack([source.mesh.corners, source.mesh.corners], axis=1) / 4
    write_mesh(tmp_path / "b.ply", source, corner_uv=uv)
    written = (tmp_path / "b.ply").read_bytes()
    if faces == "mixed":  # all vertices have corners
        assert written.endswith(encoded(FORMATS[form], list(columns.values()), [[p, len(p)] for p in polygons]))
        assert b"texcoord" not in written
    np.testing.assert_array_equal(read_mesh(tmp_path / "b.ply").corner_uv, uv)


@pytest.mark.parametrize("end", [b"\n", b"\r\n"])
def test_header_lines_stay_where_they_are(tmp_path: Path, end: bytes) -> None:
    data = ply("binary_little_endian", ("vertex", XYZ, POINTS), ("face", FACES, POLYGONS))
    head, mark, body = data.partition(b"end_header\n")
    data = (head + mark).replace(b"\n", end) + body
    source = read_mesh(saved(tmp_path, data))
    write_mesh(tmp_path / "b.ply", source, corner_uv=np.zeros((len(CORNERS), 2)))
    written = (tmp_path / "b.ply").read_bytes()
    names = ("s", "t", "texture_u", "texture_v")
    added = b"".join(b"property double " + name.encode() + end for name in names)
    z = b"property float z" + end
    assert written.startswith(head.replace(b"\n", end).replace(z, z + added) + b"end_header" + end)
    assert written.endswith(encoded("<", ["uchar int"], POLYGONS))


def test_text_numbers_stay_as_they_are_written(tmp_path: Path) -> None:
    data = ply("ascii", ("vertex", XYZ, POINTS), ("face", FACES, POLYGONS))
    data = data.replace(b"\n1 0 0.5\n", b"\n+1.00  0e0\t.50 \n")
    source = read_mesh(saved(tmp_path, data))
    assert source.mesh.V[1].tolist() == [1, 0, 0.5]
    write_mesh(tmp_path / "b.ply", source, corner_uv=np.full((len(CORNERS), 2), 0.1))
    assert b"\n+1.00  0e0\t.50 0.1 0.1 0.1 0.1\n" in (tmp_path / "b.ply").read_bytes()


@pytest.mark.parametrize("form", FORMATS)
def test_lists_of_many_lengths_and_small_blocks(tmp_path: Path, form: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(text_rows, "BLOCK", 50)
    monkeypatch.setattr(change, "ROWS", 7)
    rng = np.random.default_rng(0)
    points: list[Row] = rng.integers(-9, 9, (60, 3)).tolist()
    polygons: list[Row] = [[rng.permutation(60)[:n].tolist()] for n in rng.integers(3, 40, 100)]
    source = read_mesh(saved(tmp_path, ply(form, ("vertex", XYZ, points), ("face", FACES, polygons))))
    assert source.mesh.V.tolist() == points
    assert source.mesh.corners.tolist() == [c for p in polygons for c in p[0]]
    uv = rng.random((len(source.mesh.corners), 2)).astype(np.float32).astype(float)
    uv[: len(polygons[0][0])] = np.nan
    write_mesh(tmp_path / "b.ply", source, corner_uv=uv)
    np.testing.assert_array_equal(read_mesh(tmp_path / "b.ply").corner_uv, uv)
    found = by_plyfile((tmp_path / "b.ply").read_bytes())
    assert same_values(found["face"]["vertex_indices"], np.array([p[0] for p in polygons], dtype=object))


def test_elements_without_rows_or_properties(tmp_path: Path) -> None:
    data = ply(
        "binary_big_endian",
        ("none", {"l": "uchar int", "a": "int"}, []),
        ("bare", {}, [[], []]),
        ("vertex", XYZ, POINTS),
        ("face", FACES, POLYGONS),
    )
    assert read_mesh(saved(tmp_path, data)).mesh.corners.tolist() == CORNERS


FOUR = encoded("<", ["uchar int"], [[[0, 1, 2, 3]]])
LAST = encoded("<", ["uchar int"], POLYGONS[3:])
HARM = [
    ("binary_little_endian", FOUR, b"\xff" + FOUR[1:], r"element 'face', row 1: the file ends within it"),
    ("binary_little_endian", LAST, LAST[:-1], r"element 'face', row 3: the file ends within it"),
    ("ascii", b"4 0 1 2 3", b"4 0 1 2", r"line 20: a list of another length.*'4 0 1 2'"),
    ("ascii", b"4 0 1 2 3", b"3 0 1 2 3", r"line 20: more numbers"),
    ("ascii", b"4 0 1 2 3", b"-4 0 1 2 3", r"line 20: a list of another length"),
    ("ascii", b"4 0 1 2 3", b"4 0 1 2 x", r"line 20: a word that is not a number.*'4 0 1 2 x'"),
    ("ascii", b"4 0 1 2 3", b"4 0 1 2 1_0", r"line 20: a word that is not a number"),
    ("ascii", b"4 0 1 2 3", b"4 0 1.5 2", r"line 20: a word that is not a number"),
    ("ascii", b"4 0 1 2 3", b"4 0 1-2 3", r"line 20: a word that is not a number"),
    ("ascii", b"3 2 1 0", b"3 2 1 0-", r"line 21: a word that is not a number"),
    ("ascii", b"\n3 2 1 0\n", b"\n", r"element 'face', row 3: the file ends before it"),
    ("ascii", b"1 0 0.5", b"1 0", r"line 15: numbers are missing"),
    ("ascii", b"1 0 0.5", b"", r"line 15: numbers are missing"),
    ("ascii", b"property float y", b"property float x", r"line 7: a PLY header line that is not understood"),
    ("ascii", b"element face", b"element vertex", r"line 10: a PLY header line that is not understood"),
    ("ascii", b"list uchar", b"list float", r"line 11: a PLY header line that is not understood"),
    ("ascii", b"format ascii 1.0\n", b"", r"no line 'format"),
    ("ascii", b"format ascii", b"format latin", r"line 2: a PLY header line that is not understood"),
    ("ascii", b"list uchar int", b"list uchar float", r"not integers"),
    ("ascii", b"property float z", b"property float w", r"need x, y, z"),
]


@pytest.mark.parametrize(("form", "old", "new", "told"), HARM)
def test_damage_is_named_by_its_place(tmp_path: Path, form: str, old: bytes, new: bytes, told: str) -> None:
    data = ply(form, ("vertex", XYZ, POINTS), ("face", FACES, POLYGONS))
    read_mesh(saved(tmp_path, data))
    assert data.count(old)
    with pytest.raises(FileFormatError, match=rf"a\.ply.*{told}"):
        read_mesh(saved(tmp_path, data.replace(old, new, 1)))


def test_negative_lengths_are_refused(tmp_path: Path) -> None:
    """In a list that is not read, too: what follows it stands elsewhere."""
    kinds = {"l": "short int", **FACES}
    rows: list[Row] = [[[], *row] for row in POLYGONS]
    data = ply("binary_little_endian", ("vertex", XYZ, POINTS), ("face", kinds, rows))
    at = data.index(b"\0\0" + FOUR)
    with pytest.raises(FileFormatError, match="element 'face', row 1: a list of negative length"):
        read_mesh(saved(tmp_path, data[:at] + b"\xff\xff" + data[at + 2 :]))


def test_whole_numbers_among_others_are_whole(tmp_path: Path) -> None:
    kinds = {**FACES, "area": "float"}
    data = ply("ascii", ("vertex", XYZ, POINTS), ("face", kinds, [[p[0], 0.5] for p in POLYGONS]))
    assert read_mesh(saved(tmp_path, data)).mesh.corners.tolist() == CORNERS
    for word in (b"1.5", b"1e400", b"nan"):
        with pytest.raises(FileFormatError, match="not a whole number"):
            read_mesh(saved(tmp_path, data.replace(b"3 0 1 2", b"3 0 " + word + b" 2")))

"""OBJ, OFF and text STL in blocks as small as their lines; STL as other programs lay it out; welding."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from conformal_uv.errors import FileFormatError
from conformal_uv.files import read_mesh, stl_text, text_lines, weld, write_mesh
from conformal_uv.files.text_numbers import float_numbers, whole_numbers
from conformal_uv.files.weld import welded

SEVERAL = b"""\xef\xbb\xbf# a comment \\
v 0 0 0 1 0 0
v 1 0 0
vt 0.5 0.5
v 1 1 \\
 0
f -3/-1 -2/1 \\
 -1/1
vt 0.25 0.75
v 0 1 0 # f 1 2 3

f 1 3 4
f 1/2 -2//1 -1/-1/7
l 1/1 2/2
vt 1 1
"""
OFF = b"OFF\n\n# counts\n4 2 0\n0 0 0\n1 0 0\n1 1 0 # third\n\n0 1 0\n3 0 1 2 0.5 0.5 0.5\n3 0 2 3\n"


def saved(folder: Path, name: str, data: bytes) -> Path:
    path = folder / name
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("block", [1, 7, 20, 50, 100])
@pytest.mark.parametrize("newline", [b"\n", b"\r\n"])
def test_blocks_change_nothing_of_an_obj(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: int, newline: bytes
) -> None:
    """Continued lines, indices that count back and texture vertices go over the blocks' ends."""
    path = saved(tmp_path, "a.obj", SEVERAL.replace(b"\n", newline))
    whole = read_mesh(path)
    assert whole.mesh.corners.tolist() == [0, 1, 2, 0, 2, 3, 0, 2, 3]
    uv = np.arange(18.0).reshape(9, 2) / 16
    some = np.where(np.arange(9)[:, None] < 3, uv, np.nan)
    for name, new in (("all.obj", uv), ("some.obj", some), ("none.obj", uv * np.nan)):
        write_mesh(tmp_path / name, whole, corner_uv=new)
    monkeypatch.setattr(text_lines, "BLOCK", block)
    again = read_mesh(path)
    assert whole.corner_uv is not None
    np.testing.assert_array_equal(again.mesh.V, whole.mesh.V)
    np.testing.assert_array_equal(again.mesh.corners, whole.mesh.corners)
    np.testing.assert_array_equal(again.corner_uv, whole.corner_uv)
    for name, new in (("all.obj", uv), ("some.obj", some), ("none.obj", uv * np.nan)):
        write_mesh(tmp_path / "b.obj", again, corner_uv=new)
        assert (tmp_path / "b.obj").read_bytes() == (tmp_path / name).read_bytes()
    np.testing.assert_array_equal(read_mesh(tmp_path / "none.obj").corner_uv, whole.corner_uv)


@pytest.mark.parametrize("face", [b"f 1 2 3", b"f 1/1 2/1 3/1", b"f 1//1 2//1 3//1", b"f 1 2 3/"])
def test_an_obj_without_newline_at_its_end(tmp_path: Path, face: bytes) -> None:
    source = read_mesh(saved(tmp_path, "a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n" + face))
    uv = np.array([[0, 0], [0.5, 0], [0, 0.25]])
    write_mesh(tmp_path / "b.obj", source, corner_uv=uv)
    np.testing.assert_array_equal(read_mesh(tmp_path / "b.obj").corner_uv, uv)


@pytest.mark.parametrize("block", [1, 50, 1000])
@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (b"f 1 3 4", b"f 1 3 5", "line 12: a vertex that does not exist"),
        (b"f 1/2", b"f 1/4", "line 13: a texture index.*has 3 vt lines"),
        (b"f -3/-1", b"f -3/-2", "line 7: a texture index.*too few vt lines above"),
        (b"v 1 0 0", b"v 1 0", "line 3: 3 numbers expected"),
    ],
)
def test_blocks_name_lines_of_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: int, old: bytes, new: bytes, told: str
) -> None:
    monkeypatch.setattr(text_lines, "BLOCK", block)
    with pytest.raises(FileFormatError, match=rf"a\.obj, {told}"):
        read_mesh(saved(tmp_path, "a.obj", SEVERAL.replace(old, new)))


@pytest.mark.parametrize("block", [1, 9, 30, 1000])
def test_blocks_change_nothing_of_an_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: int) -> None:
    monkeypatch.setattr(text_lines, "BLOCK", block)
    mesh = read_mesh(saved(tmp_path, "a.off", OFF)).mesh
    assert mesh.V.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert mesh.corners.tolist() == [0, 1, 2, 0, 2, 3]
    for old, new, told in [
        (b"3 0 2 3", b"3 0 2 4", "line 11"),
        (b"4 2 0", b"4 3 0", "line 4"),
        (b"0 1 0\n3", b"0 1\n3", "9"),
    ]:
        with pytest.raises(FileFormatError, match=rf"a\.off.*{told}"):
            read_mesh(saved(tmp_path, "a.off", OFF.replace(old, new)))


FACET = b"facet normal nan 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex %b 1 0\n endloop\nendfacet\n"
SOLID = b"solid vertex of a facet\n" + FACET % b"0" + FACET % b"1e0" + b"endsolid\n"


@pytest.mark.parametrize("block", [1, 60, 1000])
@pytest.mark.parametrize(
    "changed",
    [
        lambda data: data,
        bytes.upper,
        lambda data: data.replace(b"\n", b"\r\n"),
        lambda data: data.replace(b"\n", b"\r"),
        lambda data: data.replace(b"solid vertex of a facet", b"solid").replace(b"\n", b" "),
        lambda data: data.replace(b"endfacet", b"endfacet\n\ncolor 1 2 3"),
        lambda data: data.replace(b" outer loop\n", b"").replace(b" endloop\n", b""),
        lambda data: b"\xef\xbb\xbf" + data + data.replace(b" 1 0\n", b" 2 0\n"),
    ],
)
def test_text_stl_as_programs_lay_it_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: int, changed) -> None:
    monkeypatch.setattr(stl_text, "BLOCK", block)
    data = changed(SOLID)
    mesh = read_mesh(saved(tmp_path, "a.stl", data)).mesh
    expected = [0, 1, 2, 0, 1, 3]
    assert mesh.corners.tolist() == expected + ([0, 1, 4, 0, 1, 5] if len(data) > 2 * len(SOLID) else [])
    assert mesh.V[:4].tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (b"endsolid\n", b"", "whole solids, at facet 2 of 2"),
        (b"solid vertex of a facet\n", b"", "whole solids, at facet"),
        (b"  vertex 1 0 0\n", b"", "at facet 0 of 2"),
        (b"  vertex 1 0 0\n", b"  vertex 1 0 0\n" * 2, "at facet 0 of 2"),
        (b"endfacet\n", b"", "at facet 0 of 2"),
        (b"vertex 1 0 0", b"vertex 1 0", "vertex '1 0': three numbers expected"),
        (b"vertex 1 0 0", b"vertex 1 0 0 0", "vertex '1 0 0 0': three numbers expected"),
        (b"vertex 1 0 0", b"vertex 1 0 0-", "vertex '1 0 0-': three numbers expected"),
        (b"vertex 1e0 1 0", b"vertex 1e0 1 x", "vertex '1e0 1 x': three numbers expected"),
        (b"vertex 1e0 1 0", b"vertex 1e0 1.0.5", "vertex '1e0 1.0.5': three numbers expected"),
        (SOLID, b"solid a\nendsolid a\n" + SOLID[24:-9] + b"solid b\nendsolid b\n", "whole solids"),
        (SOLID, b"solid a\nendsolid a\n", "at facet 0 of 0"),
        (SOLID, b"", "at facet 0 of 0"),
    ],
)
def test_text_stl_that_is_damaged(tmp_path: Path, old: bytes, new: bytes, told: str) -> None:
    with pytest.raises(FileFormatError, match=rf"a\.stl.*{told}"):
        read_mesh(saved(tmp_path, "a.stl", SOLID.replace(old, new, 1)))


def test_binary_stl_of_another_length(tmp_path: Path) -> None:
    data = bytes(80) + (2).to_bytes(4, "little") + bytes(99)
    with pytest.raises(FileFormatError, match="2 facets are declared, which take 184 bytes, and the file has 183"):
        read_mesh(saved(tmp_path, "a.stl", data))


@pytest.mark.parametrize("tries", [0, 1, 8])
@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_welding_is_by_equality(monkeypatch: pytest.MonkeyPatch, tries: int, kind: type) -> None:
    """Against a dictionary of tuples, for which -0.0 is 0.0; NaN is as many positions as there are of it."""
    monkeypatch.setattr(weld, "TRIES", tries)
    monkeypatch.setattr(weld, "BLOCK", 100)
    soup = np.random.default_rng(0).integers(-3, 4, (1000, 3)).astype(kind) / 8
    soup[soup == 0.125] = -0.0
    soup[::50, 1] = np.nan
    known: dict[object, int] = {}
    expected = [
        known.setdefault(row if row == row and row[1] == row[1] else k, len(known))
        for k, row in enumerate(map(tuple, soup.tolist()))
    ]
    V, corners = welded(soup)
    assert corners.tolist() == expected and len(V) == len(known)
    np.testing.assert_array_equal(V[corners], soup)


@pytest.mark.parametrize(
    "text", [b"1 2-", b"1 2_0", b"1 0x2", b"1-2", b"1", b"1 2 3", b"1 \x002", b"1 --2", b"1 1e", b""]
)
def test_what_is_not_two_numbers(text: bytes) -> None:
    assert float_numbers(text, 2) is None and whole_numbers(text, 2) is None


def test_numbers() -> None:
    found = float_numbers(b" 0.1\n-1e400 +.5\t5e-324 ", 4)
    assert found is not None and found.tolist() == [0.1, -np.inf, 0.5, 5e-324]
    assert float_numbers(b" \n", 0) is not None
    whole = whole_numbers(b"999999999999999999 -999999999999999999", 2)
    assert whole is not None and whole.tolist() == [10**18 - 1, 1 - 10**18]
    for word in (b"1000000000000000000", b"-99999999999999999999999", b"1.0", b"1e3"):
        assert whole_numbers(word, 1) is None

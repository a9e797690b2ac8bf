"""Mesh files: hand-written ones read right, everything but texture coordinates kept, damage refused in type."""

import builtins
import gzip
import io
import os
import re
import struct
import tracemalloc
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import plyfile
import pytest

from conformal_uv.errors import FileFormatError, MissingDependencyError, NonFiniteError, OptionError
from conformal_uv.files import MeshFile, check_writable, read_mesh, replaced_file, write_mesh
from conformal_uv.files.corner_uv import shared_uv
from conformal_uv.mesh.polygons import PolygonMesh

NAN = float("nan")
MIXED = b"""# a house \xe9 with a comment about f 1 2 3 \\
mtllib stra\xdfe.mtl
o House # not a comment to anyone
v 0 0 0 1 0 0
v 1e0 0 0\t0.5 0.5 0.5
  v 1 1 0
v 0 1. 1e-3 # w is left out
v 0.5 +2 -.25
vt 0 0
vt 1 0 0
vt 1 1
vn 0 0 1
g wall
usemtl brick
s off
f 1/1/1 2/2/1 3/3/1 4//1
g roof
s 1
f -2 -3 \\
  -1
l 1 2 3
p 4
"""


def saved(folder, name, content):
    path = folder / name
    path.write_bytes(content)
    return path


def grid(n=4, seed=0):
    """A mesh of quads and two triangles with awkward coordinates."""
    rng = np.random.default_rng(seed)
    V = rng.normal(size=(n * n, 3)) * 10.0 ** rng.integers(-9, 9, size=(n * n, 1))
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    quads = np.stack([i, i + n, i + n + 1, i + 1], axis=1)
    corners = np.concatenate([quads[:-1].ravel(), quads[-1, [0, 1, 2]], quads[-1, [0, 2, 3]]])
    sizes = np.r_[np.full(len(quads) - 1, 4), 3, 3]
    return PolygonMesh(V, corners, np.concatenate([[0], np.cumsum(sizes)]))


def triangles(n=4, seed=0):
    mesh = grid(n, seed)
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    F = np.concatenate([np.stack([i, i + n, i + n + 1], 1), np.stack([i, i + n + 1, i + 1], 1)])
    return PolygonMesh(mesh.V, F.ravel(), np.arange(0, F.size + 1, 3))


def per_vertex(mesh, seed=1):
    return np.random.default_rng(seed).random((len(mesh.V), 2))[mesh.corners]


def per_corner(mesh, seed=1):
    return np.random.default_rng(seed).random((len(mesh.corners), 2))


def same_mesh(a, b):
    return (
        np.array_equal(a.V, b.V, equal_nan=True)
        and np.array_equal(a.corners, b.corners)
        and np.array_equal(a.starts, b.starts)
    )


def without_texture(data):
    """The file as it is meant to stay: no vt lines, no texture indices on f and l lines."""
    lines = [line for line in data.splitlines(keepends=True) if not line.lstrip().startswith(b"vt ")]

    def corner(found):
        vertex, normal = found.groups()
        return vertex + (b"/" + normal if normal else b"")

    return [
        re.sub(rb"(\d+)/-?\d*(/-?\d+)?", corner, line)
        if line.lstrip()[:2] in (b"f ", b"l ") or line.startswith(b"  -")
        else line
        for line in lines
    ]


# --- OBJ, in


def test_obj_by_hand(tmp_path):
    found = read_mesh(saved(tmp_path, "house.OBJ", MIXED))
    assert found.mesh.V.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1e-3], [0.5, 2, -0.25]]
    assert found.mesh.corners.tolist() == [0, 1, 2, 3, 3, 2, 4]
    assert found.mesh.starts.tolist() == [0, 4, 7]
    np.testing.assert_array_equal(found.corner_uv, [[0, 0], [1, 0], [1, 1]] + [[NAN, NAN]] * 4)


@pytest.mark.parametrize("newline", [b"\r\n", b"\r"])
def test_obj_line_ends(tmp_path, newline):
    expected = read_mesh(saved(tmp_path, "a.obj", MIXED)).mesh
    data = MIXED.replace(b"\n", newline)
    if newline == b"\r":
        data = data.replace(b"\\\r  ", b"")
    assert same_mesh(read_mesh(saved(tmp_path, "b.obj", data)).mesh, expected)


@pytest.mark.parametrize("corner", ["{v}", "{v}/{t}", "{v}//{n}", "{v}/{t}/{n}", "{v}/", "{v}//"])
@pytest.mark.parametrize("relative", [False, True])
def test_obj_corner_forms(tmp_path, corner, relative):
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .25 .5\nvt .75 .5\nvn 0 0 1\n"
    v, t, n = ((-3, -2, -1), (-2, -1, -2), -1) if relative else ((1, 2, 3), (1, 2, 1), 1)
    text += "f " + " ".join(corner.format(v=v[k], t=t[k], n=n) for k in range(3))
    found = read_mesh(saved(tmp_path, "a.obj", text.encode()))
    assert found.mesh.corners.tolist() == [0, 1, 2]
    if "t" in corner:
        assert found.corner_uv.tolist() == [[0.25, 0.5], [0.75, 0.5], [0.25, 0.5]]
    else:
        assert found.corner_uv is None


def test_obj_relative_indices_count_from_their_line(tmp_path):
    data = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nf -1 1 -2\n"
    assert read_mesh(saved(tmp_path, "a.obj", data)).mesh.corners.tolist() == [0, 1, 2, 4, 0, 3]


def test_obj_nan_vertices_pass(tmp_path):
    found = read_mesh(saved(tmp_path, "a.obj", b"v nan 0 0\nv 1 0 inf\nv 1 1 0\nf 1 2 3\n"))
    assert np.isnan(found.mesh.V[0, 0]) and np.isinf(found.mesh.V[1, 2])


V3 = b"v 0 0 0\nv 1 0 0\nv 1 1 0\n"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (V3 + b"f 1 2 4\n", ["line 4", "does not exist"]),
        (V3 + b"f 1 2 3\nf 0 1 2\n", ["line 5", "does not exist"]),
        (V3 + b"# x\n\nf 1 2 -4\n", ["line 6", "does not exist"]),
        (V3 + b"f 1/1 2/1 3/1\n", ["line 4", "texture index"]),
        (V3 + b"vt 0 0\nf 1/1 2/-2 3/1\n", ["line 5", "texture index"]),
        (V3 + b"f 1 2 3\nf 1 2\n", ["line 5", "2 corners"]),
        (V3 + b"f 1 2 x\n", ["line 4", "f 1 2 x"]),
        (V3 + b"f 1//2//3 4 5//6\n", ["line 4"]),
        (V3 + b"f 1 2 --3\n", ["line 4"]),
        (V3 + b"f 1 2 3-\n", ["line 4"]),
        (V3 + b"f 1/1/1/1 2 3\n", ["line 4"]),
        (V3 + b"f 1 2 /3\n", ["line 4"]),
        (V3 + b"f 1 2 1_0\n", ["line 4"]),
        (V3 + b"f 1 2 99999999999999999999999\n", ["line 4"]),
        (b"v 0 0 0\nv 1 0\n" + V3 + b"f 1 2 3\n", ["line 2", "v 1 0"]),
        (V3 + b"v 1 0 1_0\nf 1 2 3\n", ["line 4"]),
        (V3 + b"v 1 0 zero\nf 1 2 3\n", ["line 4", "not a number"]),
        (V3, ["no faces"]),
        (b"", ["no faces"]),
        (b"\x00\xff" * 50, ["no faces"]),
    ],
)
def test_obj_refusals_name_the_line(tmp_path, data, words):
    path = saved(tmp_path, "a.obj", data)
    with pytest.raises(FileFormatError) as caught:
        read_mesh(path)
    before, _, told = str(caught.value).partition(str(path))
    assert not before and all(word in told for word in words)


# --- OBJ, out


@pytest.mark.parametrize("newline", [b"\n", b"\r\n"])
def test_obj_keeps_every_other_byte(tmp_path, newline):
    data = MIXED.replace(b"\n", newline)
    source = read_mesh(saved(tmp_path, "a.obj", data))
    uv = per_corner(source.mesh)
    write_mesh(tmp_path / "b.obj", source, corner_uv=uv)
    written = (tmp_path / "b.obj").read_bytes()
    assert without_texture(written) == without_texture(data)
    assert written.count(newline) == written.count(b"\n")
    again = read_mesh(tmp_path / "b.obj")
    assert same_mesh(again.mesh, source.mesh)
    np.testing.assert_array_equal(again.corner_uv, uv)


def test_obj_text_by_hand(tmp_path):
    data = V3 + b"v 0 1 0\nvn 0 0 1\nusemtl a\nf 1//1  2//1 3//1 # first\nf 1/ 3 -1\ns 1\n"
    source = read_mesh(saved(tmp_path, "a.obj", data))
    write_mesh(
        tmp_path / "b.obj", source, corner_uv=np.array([[0, 0], [0.1, 0], [1, 1], [0, 0], [1, 1], [1e-7, 1 / 3]])
    )
    assert (tmp_path / "b.obj").read_bytes() == V3 + (
        b"v 0 1 0\nvn 0 0 1\nusemtl a\nvt 0.0 0.0\nvt 0.1 0.0\nvt 1.0 1.0\nvt 1e-07 0.3333333333333333\n"
        b"f 1/1/1  2/2/1 3/3/1 # first\nf 1/1 3/3 -1/4\ns 1\n"
    )


def test_obj_seam_corners_get_their_own_vt(tmp_path):
    mesh = triangles(6)
    uv = per_vertex(mesh)
    seam = np.flatnonzero(mesh.corners == 14)
    uv[seam[::2]] = [7, 8]
    write_mesh(tmp_path / "a.obj", MeshFile(Path("x"), mesh), corner_uv=uv)
    data = (tmp_path / "a.obj").read_bytes()
    assert data.count(b"vt ") == len(mesh.V) + 1
    assert data.count(b"vt 7.0 8.0\n") == 1
    np.testing.assert_array_equal(read_mesh(tmp_path / "a.obj").corner_uv, uv)


@pytest.mark.parametrize("make", [grid, triangles])
@pytest.mark.parametrize("uv_of", [per_vertex, per_corner])
def test_fresh_obj_is_exact(tmp_path, make, uv_of):
    mesh = make(7)
    uv = uv_of(mesh) * 10.0 ** np.random.default_rng(2).integers(-300, 300, size=(len(mesh.corners), 1))
    write_mesh(tmp_path / "a.obj", MeshFile(Path("x.ply"), mesh), corner_uv=uv)
    again = read_mesh(tmp_path / "a.obj")
    assert same_mesh(again.mesh, mesh)
    np.testing.assert_array_equal(again.corner_uv, uv)
    write_mesh(tmp_path / "b.obj", again, corner_uv=uv)
    assert (tmp_path / "a.obj").read_bytes() == (tmp_path / "b.obj").read_bytes()


def test_obj_unmapped_faces_without_texture_stay_without(tmp_path):
    source = read_mesh(saved(tmp_path, "a.obj", V3 + b"v 0 1 0\nf 1 2 3\nf 1//1 3//1 4//1\nf 1 3 4\n"))
    uv = per_corner(source.mesh)
    uv[4, 1] = NAN  # one corner is enough to leave the face out
    uv[:3] = [[0, 0], [1, 0], [1, 1]]
    uv[6:] = [[0, 0], [1, 1], [0, 1]]
    write_mesh(tmp_path / "b.obj", source, corner_uv=uv)
    assert (tmp_path / "b.obj").read_bytes() == V3 + (
        b"v 0 1 0\nvt 0.0 0.0\nvt 1.0 0.0\nvt 1.0 1.0\nvt 0.0 1.0\nf 1/1 2/2 3/3\nf 1//1 3//1 4//1\nf 1/1 3/3 4/4\n"
    )


def test_obj_unmapped_faces_keep_their_texture(tmp_path):
    """Old vt lines before and after the new ones, relative and absolute, and a polyline's."""
    data = (
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0 0.5\nvt 0.5 0\nvt 0.5 0.5\nf 1/1 2/2 3/3\n"
        b"v 0 1 0\nvt 0.25 0.75\nf 1/-4/7 3/3/7 4/-1/7\nf 1/1 3/3 -1/4\nl 1/4 2/-2\n"
    )
    source = read_mesh(saved(tmp_path, "a.obj", data))
    uv = np.full((9, 2), NAN)
    uv[:3] = [[0.125, 0], [1, 0], [1, 1]]
    write_mesh(tmp_path / "b.obj", source, corner_uv=uv)
    assert (tmp_path / "b.obj").read_bytes() == (
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0 0.5\nvt 0.5 0\nvt 0.5 0.5\n"
        b"vt 0.125 0.0\nvt 1.0 0.0\nvt 1.0 1.0\nf 1/4 2/5 3/6\n"
        b"v 0 1 0\nvt 0.25 0.75\nf 1/1/7 3/3/7 4/7/7\nf 1/1 3/3 -1/7\nl 1/7 2/3\n"
    )
    np.testing.assert_array_equal(
        read_mesh(tmp_path / "b.obj").corner_uv, np.concatenate([uv[:3], source.corner_uv[3:]])
    )


def test_obj_nothing_mapped_changes_nothing(tmp_path):
    data = V3 + b"vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3"
    source = read_mesh(saved(tmp_path, "a.obj", data))
    write_mesh(tmp_path / "b.obj", source, corner_uv=np.full((3, 2), NAN))
    assert (tmp_path / "b.obj").read_bytes() == data


def test_obj_whose_last_line_is_an_old_vt(tmp_path):
    data = V3 + b"f 1/1 2/1 3/1\nvt 0.5 0.5"
    source = read_mesh(saved(tmp_path, "a.obj", data))
    assert source.corner_uv.tolist() == [[0.5, 0.5]] * 3
    write_mesh(tmp_path / "b.obj", source, corner_uv=np.ones((3, 2)))
    assert (tmp_path / "b.obj").read_bytes() == V3 + b"vt 1.0 1.0\n" * 3 + b"f 1/1 2/2 3/3\n"


def test_obj_lines_are_not_used_for_another_mesh(tmp_path):
    source = read_mesh(saved(tmp_path, "a.obj", b"# mine\n" + V3 + b"f 1 2 3\n"))
    other = replace(source, mesh=PolygonMesh(source.mesh.V[::-1].copy(), source.mesh.corners, source.mesh.starts))
    write_mesh(tmp_path / "b.obj", other, corner_uv=np.zeros((3, 2)))
    assert same_mesh(read_mesh(tmp_path / "b.obj").mesh, other.mesh)


# --- PLY


def ply_bytes(mesh, *, text=False, order="<", vertex_uv=None, wedge=None, extra=True, index="vertex_indices"):
    """A PLY file with colours, face flags and an edge element, written by plyfile."""
    fields = [("x", "f8"), ("y", "f8"), ("z", "f8")] + [("red", "u1")] * extra
    fields += [(name, "f4") for name in vertex_uv or ()]
    vertex = np.zeros(len(mesh.V), fields)
    for k, axis in enumerate("xyz"):
        vertex[axis] = mesh.V[:, k]
    if extra:
        vertex["red"] = np.arange(len(mesh.V)) % 256
    for k, name in enumerate(vertex_uv or ()):
        vertex[name] = np.arange(len(mesh.V)) + 0.5 * k
    face = np.empty(len(mesh.sizes), [(index, "O")] + [("flags", "i2")] * extra + [("texcoord", "O")] * bool(wedge))
    for f in range(len(mesh.sizes)):
        corners = slice(mesh.starts[f], mesh.starts[f + 1])
        face[index][f] = mesh.corners[corners].astype("i4")
        if extra:
            face["flags"][f] = f - 3
        if wedge:
            face["texcoord"][f] = np.arange(2 * mesh.sizes[f], dtype="f4") + f
    elements = [
        plyfile.PlyElement.describe(vertex, "vertex"),
        plyfile.PlyElement.describe(face, "face", val_types={"texcoord": "f4", index: "i4"}),
    ]
    if extra:
        edge = np.array([(0, 1), (2, 3)], [("vertex1", "i4"), ("vertex2", "i4")])
        elements.append(plyfile.PlyElement.describe(edge, "edge"))
    stream = io.BytesIO()
    plyfile.PlyData(elements, text=text, byte_order="=" if text else order, comments=["made by hand"]).write(stream)
    return stream.getvalue()


STORED = [dict(text=True), dict(order="<"), dict(order=">")]


@pytest.mark.parametrize("stored", STORED, ids=["text", "little", "big"])
@pytest.mark.parametrize("make", [grid, triangles])
def test_ply_reads_polygons(tmp_path, stored, make):
    mesh = make()
    found = read_mesh(saved(tmp_path, "a.ply", ply_bytes(mesh, index="vertex_index", **stored)))
    assert same_mesh(found.mesh, mesh)
    assert found.corner_uv is None


@pytest.mark.parametrize("names", [("s", "t"), ("u", "v"), ("texture_u", "texture_v")])
def test_ply_reads_vertex_uv(tmp_path, names):
    mesh = grid()
    found = read_mesh(saved(tmp_path, "a.ply", ply_bytes(mesh, vertex_uv=names)))
    np.testing.assert_array_equal(found.corner_uv, np.stack([mesh.corners, mesh.corners + 0.5], axis=1))


@pytest.mark.parametrize("make", [grid, triangles])
@pytest.mark.parametrize("stored", STORED, ids=["text", "little", "big"])
def test_ply_reads_wedge_uv(tmp_path, make, stored):
    mesh = make()
    found = read_mesh(saved(tmp_path, "a.ply", ply_bytes(mesh, wedge=True, vertex_uv=("s", "t"), **stored)))
    face = np.repeat(np.arange(len(mesh.sizes)), mesh.sizes)
    first = 2 * (np.arange(len(mesh.corners)) - mesh.starts[face]) + face
    np.testing.assert_array_equal(found.corner_uv, np.stack([first, first + 1], axis=1))


def check_rest_kept(old, new):
    """Everything in the PLY file but its texture coordinates is as it was."""
    uv_names = {"s", "t", "u", "v", "texture_u", "texture_v", "texcoord"}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # an empty list in a text file
        old, new = (plyfile.PlyData.read(io.BytesIO(data)) for data in (old, new))
    assert (old.text, old.byte_order, old.comments) == (new.text, new.byte_order, new.comments)
    assert [e.name for e in old] == [e.name for e in new]
    for a, b in zip(old, new, strict=True):
        kept = [str(p) for p in a.properties if p.name not in uv_names]
        assert [str(p) for p in b.properties if p.name not in uv_names] == kept
        for p in a.properties:
            if p.name not in uv_names:
                assert all(np.array_equal(x, y) for x, y in zip(a[p.name], b[p.name], strict=True))


@pytest.mark.parametrize("stored", STORED, ids=["text", "little", "big"])
@pytest.mark.parametrize("make", [grid, triangles])
@pytest.mark.parametrize("had", [dict(), dict(vertex_uv=("texture_u", "texture_v")), dict(wedge=True)])
def test_ply_to_ply_per_vertex(tmp_path, stored, make, had):
    data = ply_bytes(make(), **stored, **had)
    source = read_mesh(saved(tmp_path, "a.ply", data))
    uv = per_vertex(source.mesh)
    write_mesh(tmp_path / "b.ply", source, corner_uv=uv)
    written = (tmp_path / "b.ply").read_bytes()
    check_rest_kept(data, written)
    header = written[: written.index(b"end_header")]
    for name in (b"s", b"t", b"texture_u", b"texture_v"):  # MeshLab reads texture_u, others s
        assert header.count(b"property double " + name + b"\n") == header.count(b" " + name + b"\n") == 1
    assert b"texcoord" not in header
    stored = plyfile.PlyData.read(io.BytesIO(written))["vertex"]
    assert np.array_equal(stored["s"], stored["texture_u"]) and np.array_equal(stored["t"], stored["texture_v"])
    again = read_mesh(tmp_path / "b.ply")
    assert same_mesh(again.mesh, source.mesh)
    np.testing.assert_array_equal(again.corner_uv, uv)


@pytest.mark.parametrize("stored", STORED, ids=["text", "little", "big"])
@pytest.mark.parametrize("make", [grid, triangles])
@pytest.mark.parametrize("unmapped", [False, True])
def test_ply_to_ply_per_corner(tmp_path, stored, make, unmapped):
    data = ply_bytes(make(), vertex_uv=None if unmapped else ("s", "t"), **stored)
    source = read_mesh(saved(tmp_path, "a.ply", data))
    uv = per_corner(source.mesh)
    if unmapped:
        uv[: source.mesh.starts[2]] = NAN
    write_mesh(tmp_path / "b.ply", source, corner_uv=uv)
    written = (tmp_path / "b.ply").read_bytes()
    check_rest_kept(data, written)
    header = written[: written.index(b"end_header")]
    assert b"property list uchar float texcoord\n" in header and b" s\n" not in header
    again = read_mesh(tmp_path / "b.ply")
    assert same_mesh(again.mesh, source.mesh)
    np.testing.assert_array_equal(again.corner_uv, uv.astype(np.float32))  # texcoord is float by convention


def test_ply_unreferenced_vertex_needs_wedges(tmp_path):
    mesh = triangles()
    lonely = PolygonMesh(np.r_[mesh.V, np.zeros((1, 3))], mesh.corners, mesh.starts)
    uv = per_vertex(mesh).astype(np.float32)
    write_mesh(tmp_path / "a.ply", MeshFile(Path("x"), lonely), corner_uv=uv)
    assert b"texcoord" in (tmp_path / "a.ply").read_bytes()[:300]
    np.testing.assert_array_equal(read_mesh(tmp_path / "a.ply").corner_uv, uv)


@pytest.mark.parametrize("size", [127, 128, 255, 256, 300])
def test_ply_big_polygon_has_room_for_its_length(tmp_path, size):
    """A byte counts to 255 corners, or the texture numbers of 127."""
    mesh = PolygonMesh(np.random.default_rng(0).random((size, 3)), np.arange(size), np.array([0, size]))
    uv = np.full((size, 2), 0.5)
    uv[:, 0] = np.arange(size)
    write_mesh(tmp_path / "a.ply", MeshFile(Path("x"), mesh), corner_uv=uv)
    again = read_mesh(tmp_path / "a.ply")
    assert same_mesh(again.mesh, mesh) and np.array_equal(again.corner_uv, uv)


def test_ply_absurd_counts_are_refused_before_allocation(tmp_path):
    data = ply_bytes(triangles())
    for count in (b"999999999999", b"9" * 30):
        bad = re.sub(rb"element vertex \d+", b"element vertex " + count, data)
        with pytest.raises(FileFormatError, match="can hold"):
            read_mesh(saved(tmp_path, "a.ply", bad))
    rows = len(data) - data.index(b"end_header\n") - len(b"end_header\n")
    most = (rows + 1) // 25  # three doubles and a byte each; a last newline may be missing
    for count in (most, most + 1):
        bad = re.sub(rb"element vertex \d+", b"element vertex %d" % count, data)
        with pytest.raises(FileFormatError) as refused:
            read_mesh(saved(tmp_path, "a.ply", bad))
        assert ("can hold" in str(refused.value)) == (count > most)


@pytest.mark.parametrize("size", [16, 18])
def test_packed_files_hold_no_more_than_a_mesh_can_be_packed(tmp_path, size):
    """Blanks are packed into a thousandth: 16 million of them are read, 18 million refused (the bound is 2^24)."""
    data = OFF + b" " * (size * 10**6)
    path = saved(tmp_path, "a.off.gz", gzip.compress(data))
    if size < 2**24 / 1e6:
        assert len(read_mesh(path).mesh.sizes)
    else:
        with pytest.raises(FileFormatError, match=r"a\.off\.gz.*this is no packed mesh"):
            read_mesh(path)


@pytest.mark.parametrize("apart", [[0, 0], [0.25, 0], [0, 0.25], [-0.25, 0.25]])
def test_corners_share_texture_coordinates_where_both_numbers_are_equal(apart):
    uv = np.array([[0.5, 0.5], [0.1, 0.2], np.array([0.5, 0.5]) + apart, [0.5, 0.5]])
    number, example = shared_uv(np.array([1, 0, 1, 1]), uv)
    np.testing.assert_array_equal(uv[example][number], uv)
    assert len(example) == (3 if any(apart) else 2) and number[0] == number[3]


@pytest.mark.parametrize(("numbers", "told"), [("4 0 0 1 0", "face 1: 4 texture numbers for 3 corners"), ("0", None)])
def test_ply_texture_numbers_are_two_a_corner_or_none(tmp_path, numbers, told):
    data = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    data += "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
    data += f"0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 6 0 0 1 0 0 1\n3 1 3 2 {numbers}\n"
    path = saved(tmp_path, "a.ply", data.encode())
    if told is None:
        uv = read_mesh(path).corner_uv
        np.testing.assert_array_equal(uv, [[0, 0], [1, 0], [0, 1]] + [[np.nan, np.nan]] * 3)
    else:
        with pytest.raises(FileFormatError, match=rf"a\.ply.*{told}"):
            read_mesh(path)


def test_ply_index_out_of_range_names_the_face(tmp_path):
    mesh = triangles()
    corners = mesh.corners.copy()
    corners[7] = len(mesh.V)
    with pytest.raises(FileFormatError, match="face 2"):
        read_mesh(saved(tmp_path, "a.ply", ply_bytes(PolygonMesh(mesh.V, corners, mesh.starts))))


# --- OFF, STL, npz


OFF = b"""OFF # a pyramid
5 5 0
-1 -1 0
1 -1 0  # comment

1 1 0
-1 1 0
0 0 1.5e0
4 3 2 1 0
3 0 1 4 255 0 0
3 1 2 4 0.5 0.5 0.5
3 2 3 4
3 3 0 4
"""


@pytest.mark.parametrize(
    "data",
    [
        OFF,
        OFF.replace(b"OFF # a pyramid\n", b"OFF "),
        OFF.replace(b"\n", b"\r\n"),
        OFF.replace(b"OFF", b"COFF").replace(b" 0\n", b" 0 1 1 1 1\n", 1),
    ],
)
def test_off_by_hand(tmp_path, data):
    found = read_mesh(saved(tmp_path, "a.off", data))
    assert found.mesh.V.tolist() == [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 1.5]]
    assert found.mesh.sizes.tolist() == [4, 3, 3, 3, 3]
    assert found.mesh.corners.tolist() == [3, 2, 1, 0, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]
    assert found.corner_uv is None


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        (b"5 5 0", b"5 6 0", "line 2"),
        (b"5 5 0", b"5 99999999999999 0", "line 2"),
        (b"5 5 0", b"5.5 5 0", "line 2"),
        (b"5 5 0", b"5 4.5 0", "line 2"),
        (b"4 3 2 1 0", b"4 3 2 1", "line 9"),
        (b"4 3 2 1 0", b"4 3 2 1 5", "line 9"),
        (b"1 1 0", b"1 1 zero", "line 6"),
        (b"3 2 3 4", b"3 2 3 1_0", "line 12"),
        (b"3 2 3 4", b"2 2 3", "line 12"),
        (b"3 2 3 4", b"-1 2 3", "line 12"),
        (b"3 2 3 4", b"3 2 3 99999999999999999999", "line 12"),
        (b"OFF", b"FOO", "not a text OFF"),
        (OFF, b"OFF", "number"),
    ],
)
def test_off_refusals(tmp_path, old, new, word):
    with pytest.raises(FileFormatError, match=rf"a\.off.*{word}"):  # not in the folder's name, which is the test's
        read_mesh(saved(tmp_path, "a.off", OFF.replace(old, new, 1)))


def stl_bytes(T):
    rows = np.zeros(len(T), [("n", "<f4", 3), ("T", "<f4", (3, 3)), ("a", "<u2")])
    rows["T"] = T
    return b"binary".ljust(80) + struct.pack("<I", len(T)) + rows.tobytes()


def stl_text(T):
    facets = [
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*p) for p in t.tolist())
        + "endloop\nendfacet\n"
        for t in T
    ]
    return ("solid thing\n" + "".join(facets) + "endsolid thing\n").encode()


@pytest.mark.parametrize("written", [stl_bytes, stl_text])
def test_stl_is_welded_exactly(tmp_path, written):
    T = np.array(
        [
            [[0, 0, 0], [1, 0, 0], [1, 1, 0]],
            [[-0.0, 0, 0], [1, 1, 0], [0, 1, 0]],
            [[0, 1, 0], [1, 1, 0], [0, 2, np.float32(1e-7)]],
            [[0, 2, 0], [1, 1, 0], [0, 3, 0]],
        ]
    )
    found = read_mesh(saved(tmp_path, "a.stl", written(T))).mesh
    assert found.corners.tolist() == [0, 1, 2, 0, 2, 3, 3, 2, 4, 5, 2, 6]
    np.testing.assert_array_equal(found.V[found.corners], T.reshape(-1, 3))


def test_stl_of_two_solids(tmp_path):
    T = triangles().V[triangles().corners].reshape(-1, 3, 3)
    found = read_mesh(saved(tmp_path, "a.stl", stl_text(T[:5]) + stl_text(T[5:]))).mesh
    np.testing.assert_array_equal(found.V[found.corners], T.reshape(-1, 3))
    assert len(found.V) == 16


@pytest.mark.parametrize("cut", [40, 200])
def test_stl_cut_short_is_refused(tmp_path, cut):
    T = triangles().V[triangles().corners].reshape(-1, 3, 3)
    for data in (stl_bytes(T)[:-cut], (stl_text(T) + stl_text(T + 1))[:-cut]):
        with pytest.raises(FileFormatError, match="export it again"):
            read_mesh(saved(tmp_path, "a.stl", data))


@pytest.mark.parametrize("make", [grid, triangles])
@pytest.mark.parametrize("uv_of", [per_vertex, per_corner])
def test_npz_round_trip(tmp_path, make, uv_of):
    mesh = make()
    uv = uv_of(mesh)
    write_mesh(tmp_path / "a.npz", MeshFile(Path("x"), mesh), corner_uv=uv)
    again = read_mesh(tmp_path / "a.npz")
    assert same_mesh(again.mesh, mesh)
    np.testing.assert_array_equal(again.corner_uv, uv)
    with np.load(tmp_path / "a.npz") as arrays:
        assert ("F" in arrays) == (make is triangles)
        assert ("uv" in arrays) == (uv_of is per_vertex)
        if "uv" in arrays:
            np.testing.assert_array_equal(arrays["uv"][mesh.corners], uv)


def test_npz_of_others(tmp_path):
    mesh = triangles()
    F = np.asfortranarray(mesh.corners.reshape(-1, 3).astype(np.uint16))
    uv = np.random.default_rng(0).random((16, 2)).astype(np.float32)
    np.savez_compressed(tmp_path / "a.npz", V=mesh.V.astype(np.float32), F=F, uv=uv, other=np.array(["x"]))
    found = read_mesh(tmp_path / "a.npz")
    assert np.array_equal(found.mesh.corners, mesh.corners)
    np.testing.assert_array_equal(found.corner_uv, uv[mesh.corners])


@pytest.mark.parametrize(
    ("arrays", "word"),
    [
        (dict(F=[[0, 1, 2]]), "'V'"),
        (dict(V=np.eye(3)), "'corners'"),
        (dict(V=np.eye(2), F=[[0, 1, 1]]), "shape"),
        (dict(V=np.eye(3), F=[[0.0, 1, 2]]), "integers"),
        (dict(V=np.eye(3), F=[[0, 1, 3]]), "face 0"),
        (dict(V=np.eye(3), corners=[0, 1, 2], starts=[0, 2]), "starts"),
        (dict(V=np.eye(3), corners=[0, 1, 2], starts=[0, 5, 3]), "starts"),
        (dict(V=np.eye(3), corners=[0, 0, 1, 2], starts=[1, 4]), "starts"),
        (dict(V=np.eye(3), F=[[0, 1, 2]], uv=np.zeros((2, 2))), "rows"),
        (dict(V=np.eye(3) * 1j, F=[[0, 1, 2]]), "real"),
        (dict(V=np.array([None]), F=[[0, 1, 2]]), "real"),
    ],
)
def test_npz_refusals(tmp_path, arrays, word):
    np.savez(tmp_path / "a.npz", **arrays)
    with pytest.raises(FileFormatError, match=rf"a\.npz.*{word}"):
        read_mesh(tmp_path / "a.npz")


# --- across formats


@pytest.mark.parametrize("first", [".obj", ".ply", ".npz"])
@pytest.mark.parametrize("second", [".obj", ".ply", ".npz"])
def test_unmapped_faces_keep_what_the_source_had(tmp_path, first, second):
    mesh = grid()
    old = per_vertex(mesh).astype(np.float32).astype(np.float64)
    write_mesh(tmp_path / f"a{first}", MeshFile(Path("x"), mesh), corner_uv=old)
    source = read_mesh(tmp_path / f"a{first}")
    new = per_corner(mesh, 9).astype(np.float32).astype(np.float64)
    new[mesh.starts[3] : mesh.starts[5]] = NAN
    write_mesh(tmp_path / f"b{second}", source, corner_uv=new)
    np.testing.assert_array_equal(read_mesh(tmp_path / f"b{second}").corner_uv, np.where(np.isnan(new), old, new))


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".npz"])
def test_unmapped_faces_of_a_source_without_uv(tmp_path, suffix):
    mesh = grid()
    uv = per_corner(mesh).astype(np.float32).astype(np.float64)
    uv[mesh.starts[3] : mesh.starts[5]] = NAN
    write_mesh(tmp_path / f"a{suffix}", MeshFile(Path("x"), mesh), corner_uv=uv)
    np.testing.assert_array_equal(read_mesh(tmp_path / f"a{suffix}").corner_uv, uv)


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".npz"])
def test_a_file_can_be_written_over_itself(tmp_path, suffix):
    mesh = triangles()
    path = tmp_path / f"a{suffix}"
    write_mesh(path, MeshFile(Path("x"), mesh), corner_uv=per_vertex(mesh))
    write_mesh(path, read_mesh(path), corner_uv=per_vertex(mesh, 5))
    np.testing.assert_array_equal(read_mesh(path).corner_uv, per_vertex(mesh, 5))


def test_corner_uv_that_does_not_fit(tmp_path):
    source = MeshFile(Path("x"), triangles())
    with pytest.raises(OptionError, match=r"\(54, 2\)"):
        write_mesh(tmp_path / "a.obj", source, corner_uv=np.zeros((16, 2)))
    uv = per_vertex(source.mesh)
    uv[5] = np.inf
    with pytest.raises(NonFiniteError) as caught:
        write_mesh(tmp_path / "a.obj", source, corner_uv=uv)
    assert caught.value.indices == (5,)
    assert list(tmp_path.iterdir()) == []


def test_suffixes_folders_and_missing_files(tmp_path):
    with pytest.raises(FileFormatError, match=r"'.fbx'.*\.obj, \.ply, \.off, \.stl, \.npz"):
        read_mesh(tmp_path / "a.fbx")
    for suffix in (".obj", ".ply", ".off", ".stl", ".npz"):
        with pytest.raises(FileFormatError, match="no such file"):
            read_mesh(tmp_path / f"a{suffix}")
        (tmp_path / f"folder{suffix}").mkdir()
        with pytest.raises(FileFormatError, match="can not be read"):
            read_mesh(tmp_path / f"folder{suffix}")
    for name, word in [
        ("a.off", r"\.obj, \.ply, \.npz"),
        ("none/a.obj", "does not exist"),
        ("folder.obj", "folder"),
        ("a", "not written"),
    ]:
        with pytest.raises(FileFormatError, match=word):
            check_writable(tmp_path / name)
    check_writable(tmp_path / "new.PLY")
    assert not (tmp_path / "new.PLY").exists()


@pytest.mark.parametrize(("library", "suffix"), [("trimesh", ".glb"), ("meshio", ".vtk")])
def test_missing_libraries_are_named(tmp_path, monkeypatch, library, suffix):
    path = saved(tmp_path, f"a{suffix}", b"never looked at")
    real = builtins.__import__

    def without(name, *args, **kwargs):
        if name.split(".")[0] == library:
            raise ImportError(name)
        return real(name, *args, **kwargs)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(MissingDependencyError, match=re.escape('pip install "conformal-uv[cli]"')):
        read_mesh(path)


@pytest.mark.parametrize("protected", ["a.obj", ""])
def test_write_protection_is_honoured(tmp_path, monkeypatch, protected):
    """os.replace would go over a write-protected file without a word."""
    path = saved(tmp_path, "a.obj", b"old")
    monkeypatch.setattr(os, "access", lambda p, mode: Path(p) != Path(os.path.realpath(tmp_path)) / protected)
    with pytest.raises(FileFormatError, match="write-protected"):
        write_mesh(path, MeshFile(Path("x"), triangles()), corner_uv=per_vertex(triangles()))
    assert path.read_bytes() == b"old"


# --- replacing files


def test_failed_replacement_leaves_the_old_file(tmp_path):
    path = saved(tmp_path, "a.obj", b"old")
    with pytest.raises(KeyError), replaced_file(path) as stream:
        stream.write(b"new")
        raise KeyError
    assert path.read_bytes() == b"old" and list(tmp_path.iterdir()) == [path]


def test_failed_rename_is_typed_and_cleaned_up(tmp_path, monkeypatch):
    path = saved(tmp_path, "a.obj", b"old")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(FileFormatError, match="No space left"), replaced_file(path) as stream:
        stream.write(b"new")
    assert path.read_bytes() == b"old" and list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(os.name == "nt", reason="POSIX permissions")
def test_permissions_follow_the_old_file_or_the_umask(tmp_path):
    old = saved(tmp_path, "a.obj", b"old")
    old.chmod(0o751)
    umask = os.umask(0o027)
    try:
        for path in (old, tmp_path / "new.obj"):
            with replaced_file(path) as stream:
                stream.write(b"new")
    finally:
        os.umask(umask)
    assert old.read_bytes() == b"new" and old.stat().st_mode & 0o777 == 0o751
    assert (tmp_path / "new.obj").stat().st_mode & 0o777 == 0o640


@pytest.mark.skipif(os.name == "nt", reason="symbolic links need rights on Windows")
def test_symbolic_link_is_followed(tmp_path):
    target = saved(tmp_path, "a.obj", b"old")
    link = tmp_path / "link.obj"
    link.symlink_to(target)
    with replaced_file(link) as stream:
        stream.write(b"new")
    assert link.is_symlink() and target.read_bytes() == b"new"


# --- damage


def damaged(data, rng):
    """A truncation, flipped bytes, a digit changed, a piece doubled or left out."""
    kind = rng.integers(5)
    at, to = sorted(rng.integers(len(data), size=2).tolist())
    if kind == 0:
        return data[:at]
    if kind == 1:
        out = bytearray(data)
        for i in rng.integers(len(data), size=rng.integers(1, 5)).tolist():
            out[i] = int(rng.integers(256))
        return bytes(out)
    if kind == 2:
        digits = [m.start() for m in re.finditer(rb"\d", data)]
        i = digits[rng.integers(len(digits))]
        return data[:i] + b"9" * int(rng.integers(1, 25)) + data[i + 1 :]
    to = min(to, at + 40)
    return data[:at] + data[to:] if kind == 3 else data[:to] + data[at:]


def npz_bytes(compress):
    stream = io.BytesIO()
    mesh = triangles()
    (np.savez_compressed if compress else np.savez)(stream, V=mesh.V, F=mesh.corners.reshape(-1, 3))
    return stream.getvalue()


SOUP = triangles().V[triangles().corners].reshape(-1, 3, 3)
SOUND = {
    "mixed.obj": MIXED,
    "plain.obj": V3 + b"vt 0 0\n" + b"f 1/1 2/1 3/1\nf -1 -2 -3\n" * 9,
    "text.ply": ply_bytes(grid(), text=True, wedge=True),
    "mixed.ply": ply_bytes(grid(), wedge=True),
    "triangles.ply": ply_bytes(triangles(), order=">", vertex_uv=("s", "t")),
    "a.off": OFF,
    "binary.stl": stl_bytes(SOUP),
    "text.stl": stl_text(SOUP),
    "stored.npz": npz_bytes(False),
    "deflated.npz": npz_bytes(True),
}


@pytest.mark.parametrize("name", SOUND)
def test_damaged_files_raise_nothing_else_and_allocate_little(tmp_path, name):
    rng = np.random.default_rng(len(name))
    path = saved(tmp_path, name, SOUND[name])
    read_mesh(path)  # sound as it is; libraries are loaded before memory is watched
    refused = 0
    tracemalloc.start()
    try:
        for _ in range(300):
            path.write_bytes(damaged(SOUND[name], rng))
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                try:
                    found = read_mesh(path)
                except FileFormatError as error:
                    refused += 1
                    assert str(path) in str(error)
                else:
                    corners = found.mesh.corners
                    assert corners.min() >= 0 and corners.max() < len(found.mesh.V)
                    assert found.corner_uv is None or found.corner_uv.shape == (len(corners), 2)
        assert tracemalloc.get_traced_memory()[1] < 20e6
    finally:
        tracemalloc.stop()
    assert refused > 30

"""What the fast ways of writing must not lose: every bit of the numbers, every face, whatever the lines look like."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from conformal_uv.files import MeshFile, read_mesh, write_mesh
from conformal_uv.mesh.polygons import PolygonMesh

RANDOM = np.random.default_rng(4)


def many_faces(scale: float) -> tuple[PolygonMesh, np.ndarray]:
    """Triangles, quads and pentagons over more vertices than are written together, with texture coordinates."""
    n, sizes = 70000, RANDOM.integers(3, 6, 66000)
    starts = np.append(0, np.cumsum(sizes))
    corners = RANDOM.integers(0, n, starts[-1])
    uv = RANDOM.random((n, 2))[corners]
    uv[RANDOM.integers(0, len(uv), 9000)] += 0.25  # seams
    return PolygonMesh(scale * RANDOM.normal(size=(n, 3)), corners, starts), uv


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".npz"])
@pytest.mark.parametrize("scale", [1e-7, 1.0, 1e6])
def test_a_fresh_file_reads_back_bit_for_bit(tmp_path: Path, suffix: str, scale: float) -> None:
    mesh, uv = many_faces(scale)
    write_mesh(tmp_path / f"out{suffix}", MeshFile(Path("memory"), mesh), corner_uv=uv)
    back = read_mesh(tmp_path / f"out{suffix}")
    assert np.array_equal(back.mesh.V, mesh.V)
    assert np.array_equal(back.mesh.corners, mesh.corners) and np.array_equal(back.mesh.starts, mesh.starts)
    assert back.corner_uv is not None
    kept = np.float32 if suffix == ".ply" else np.float64  # MeshLab's wedge coordinates are floats
    assert np.array_equal(back.corner_uv.astype(kept), uv.astype(kept))


@pytest.mark.parametrize("suffix", [".obj", ".ply"])
def test_a_file_written_twice_is_the_same(tmp_path: Path, suffix: str) -> None:
    mesh, uv = many_faces(1.0)
    one, two = tmp_path / f"one{suffix}", tmp_path / f"two{suffix}"
    write_mesh(one, MeshFile(Path("memory"), mesh), corner_uv=uv)
    write_mesh(two, read_mesh(one), corner_uv=uv)
    assert one.read_bytes() == two.read_bytes()


ROWS = 40


def text_ply(gap: str, end: str, *, wedges: bool) -> bytes:
    """A text file whose lines have blanks at their ends, and old texture numbers before and behind other ones."""
    extra = "property list uchar float texcoord\n" if wedges else ""
    head = (
        f"ply\nformat ascii 1.0\nelement vertex {ROWS + 2}\nproperty float s\nproperty float x\nproperty float y\n"
        "property float t\nproperty float z\nproperty uchar red\n"
        f"element face {ROWS}\nproperty list uchar int vertex_indices\n{extra}end_header\n"
    )
    vertex = [gap.join(["9", f"{k}.5", f"{k * k}", "9.25", "-1e-7", f"{k}"]) + end for k in range(ROWS + 2)]
    face = [gap.join(["3", str(k), str(k + 1), str(k + 2)] + ["6", *"123456"] * wedges) + end for k in range(ROWS)]
    return (head + "\n".join(vertex + face) + "\n").encode()


@pytest.mark.parametrize("gap", [" ", "\t", "  "])
@pytest.mark.parametrize("end", ["", " ", "\t "])
@pytest.mark.parametrize("wedges", [False, True])
@pytest.mark.parametrize("seams", [False, True])
def test_text_ply_rows_keep_their_words(tmp_path: Path, gap: str, end: str, wedges: bool, seams: bool) -> None:
    path = tmp_path / "in.ply"
    path.write_bytes(text_ply(gap, end, wedges=wedges))
    source = read_mesh(path)
    uv = RANDOM.random((ROWS + 2, 2))[source.mesh.corners]
    if seams:
        uv = RANDOM.random(uv.shape).astype(np.float32).astype(np.float64)
        uv[:3] = np.nan
    write_mesh(path, source, corner_uv=uv)
    rows = path.read_text().split("end_header\n")[1].split("\n")[:-1]
    for k, row in enumerate(rows[: ROWS + 2]):
        kept = [f"{k}.5", f"{k * k}", "-1e-7", f"{k}"]
        assert row.split()[:4] == kept and len(row.split()) == (4 if seams else 8)
        assert row == row.rstrip()
    for k, row in enumerate(rows[ROWS + 2 :]):
        words = row.split()
        assert words[:4] == ["3", str(k), str(k + 1), str(k + 2)]
        if not seams:
            assert len(words) == 4
        else:
            assert words[4] == "6" and len(words) == 11
    back = read_mesh(path)
    assert back.corner_uv is not None
    new = ~np.isnan(uv)
    assert np.array_equal(back.corner_uv[new], uv[new])


CORNERS = {
    "a/t": "f 1/1 2/2 3/3\nf 2/2 4/4 3/3\n",
    "a/t/n": "f 1/1/1 2/2/1 3/3/1\nf 2/2/1 4/4/1 3/3/1\n",
    "mixed": "f 1/1 2/2/1 3\nf 2//1 4/4 3/3/1\n",
    "as many slashes as of a/t": "f 1/1/1 2/2 3\nf 2/2 4/4 3/3\n",
    "empty": "f 1/ 2// 3/3\nf 2/2/ 4/4 3/3\n",
    "relative": "f -4/-4 -3/-3 -2/-2\nf 2/2 -1/-1 3/3\n",
}


@pytest.mark.parametrize("faces", CORNERS.values(), ids=CORNERS)
def test_obj_corners_of_every_form_keep_their_vertices_and_normals(tmp_path: Path, faces: str) -> None:
    path = tmp_path / "in.obj"
    head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvn 0 0 1\n"
    path.write_text(head + faces)
    source = read_mesh(path)
    assert source.mesh.corners.tolist() == [0, 1, 2, 1, 3, 2]
    uv = 0.5 * source.mesh.V[source.mesh.corners, :2] + 0.125
    write_mesh(path, source, corner_uv=uv)
    back = read_mesh(path)
    assert back.corner_uv is not None and np.array_equal(back.corner_uv, uv)
    normals = [word.split("/")[2:] for word in faces.replace("f", "").split()]
    written = [
        word.split("/")[2:] for line in path.read_text().split("\n") if line[:1] == "f" for word in line.split()[1:]
    ]
    assert [n for n in written if any(n)] == [n for n in normals if any(n)]


@pytest.mark.parametrize("corner", ["1/2/3/4 5/6 7/8", "1/1x 2/2 3/3", "1/1 2 /2 3/3/3", "1/1/ /1 2/2"])
def test_obj_corners_that_are_none_are_refused(tmp_path: Path, corner: str) -> None:
    (tmp_path / "in.obj").write_text("v 0 0 0\n" * 9 + "vt 0 0\n" * 9 + "vn 0 0 1\n" * 9 + f"f {corner}\n")
    with pytest.raises(Exception, match=r"line 28: not a list of vertex indices"):
        read_mesh(tmp_path / "in.obj")

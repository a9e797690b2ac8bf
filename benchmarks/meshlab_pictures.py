"""The pictures of docs/pymeshlab.md: a scan coloured by distortion, and with the checker texture.

python benchmarks/meshlab_pictures.py scan.obj docs
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import matplotlib
import numpy as np
import pymeshlab
from matplotlib.figure import Figure
from PIL import Image

import meshlab_filter

SIZE = 880  # pixels of a rendered square before it is halved
LIGHT = np.array([-0.35, 0.45, 0.82]) / np.linalg.norm([-0.35, 0.45, 0.82])


def view(V: np.ndarray, F: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices seen along the mean normal, in pixels with depth (n, 3), and the light on each face (m,)."""
    cross = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    front = cross.sum(axis=0) / np.linalg.norm(cross.sum(axis=0))
    right = np.cross([0.0, 1.0, 0.0], front)
    right /= np.linalg.norm(right)
    axes = np.stack((right, np.cross(front, right), front))
    seen = V @ axes.T
    middle = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
    scale = 0.96 * SIZE / np.ptp(seen[:, :2], axis=0).max()
    pixels = np.column_stack((SIZE / 2 + scale * (seen - middle)[:, :2] * [1, -1], scale * seen[:, 2]))
    facing = (cross / np.linalg.norm(cross, axis=1, keepdims=True)) @ axes.T @ LIGHT
    return pixels, 0.35 + 0.65 * np.clip(facing, 0.0, 1.0)


def rastered(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Which face (m, 3, 3 in pixels with depth) each pixel shows, -1 for none, and the barycentric place in it."""
    face = np.full((SIZE, SIZE), -1)
    place = np.zeros((SIZE, SIZE, 3))
    depth = np.full((SIZE, SIZE), -np.inf)
    for f, (a, b, c) in enumerate(corners):
        low = np.floor(np.minimum(np.minimum(a, b), c)[:2]).astype(int).clip(0)
        high = np.ceil(np.maximum(np.maximum(a, b), c)[:2]).astype(int).clip(max=SIZE - 1) + 1
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        whole = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if whole == 0.0 or x.size == 0:
            continue
        v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / whole
        w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / whole
        z = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])
        box = np.s_[low[1] : high[1], low[0] : high[0]]
        shown = (v >= 0) & (w >= 0) & (v + w <= 1) & (z > depth[box])
        face[box][shown], depth[box][shown] = f, z[shown]
        place[box][shown] = np.stack((1 - v - w, v, w), axis=-1)[shown]
    return face, place


def painted(face: np.ndarray, colour: np.ndarray) -> np.ndarray:
    """Half as many pixels, white where no face is."""
    picture = np.where((face >= 0)[..., None], colour, 1.0)
    return picture.reshape(SIZE // 2, 2, SIZE // 2, 2, 3).mean(axis=(1, 3))


def save(figure: Figure, path: Path) -> None:
    figure.savefig(path, dpi=90, pil_kwargs={"optimize": True})


def panels(left: np.ndarray, right: np.ndarray) -> tuple[Figure, list]:
    figure = Figure(figsize=(8.6, 4.2), layout="constrained")
    axes = list(figure.subplots(1, 2))
    for panel, picture in zip(axes, (left, right), strict=True):
        panel.imshow(picture)
        panel.set_axis_off()
    return figure, axes


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scan")
    parser.add_argument("folder", type=Path)
    options = parser.parse_args()
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(options.scan)
    meshlab_filter.compute_texcoord_parametrization_conformal_disk(ms, quality="angle")
    mesh = ms.current_mesh()
    V, F, error = mesh.vertex_matrix(), mesh.face_matrix(), mesh.face_scalar_array()
    uv = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    pixels, light = view(V, F)
    face, place = rastered(pixels[F])
    flat = np.dstack((0.02 * SIZE + 0.96 * SIZE * (uv * [1, -1] + [0, 1]), np.zeros(uv.shape[:2])))
    flat_face, flat_place = rastered(flat)

    norm = matplotlib.colors.Normalize(0.0, 5.0)
    colour = matplotlib.colormaps["viridis"](norm(error))[:, :3]
    lit = colour * (0.4 + 0.6 * light)[:, None]
    figure, axes = panels(painted(face, lit[face]), painted(flat_face, colour[flat_face]))
    scale = matplotlib.cm.ScalarMappable(norm, "viridis")
    figure.colorbar(scale, ax=axes, shrink=0.8, extend="max", label="angle error of a face, degrees")
    save(figure, options.folder / "pymeshlab_distortion.png")

    with tempfile.TemporaryDirectory() as folder:
        meshlab_filter.write_checker(Path(folder) / "checker.png")
        with Image.open(Path(folder) / "checker.png") as image:
            texels = np.asarray(image) / 255.0

    def textured(face: np.ndarray, place: np.ndarray) -> np.ndarray:
        u, v = np.einsum("yxk,yxkd->dyx", place, uv[face])
        rows, columns = len(texels) - 1, texels.shape[1] - 1
        return texels[((1 - v) * rows).astype(int).clip(0, rows), (u * columns).astype(int).clip(0, columns)]

    lit = textured(face, place) * light[face][..., None]
    figure, _ = panels(painted(face, lit), painted(flat_face, textured(flat_face, flat_place)))
    save(figure, options.folder / "pymeshlab_checker.png")


if __name__ == "__main__":
    main()

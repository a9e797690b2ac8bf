"""Up on the surface is up in the texture, by the command."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from test_cli import run
from test_cli_shapes import saved

from conformal_uv.files import read_mesh
from conformal_uv.options import Upright
from conformal_uv.samples import mask, terrain

Real = NDArray[np.float64]
Faces = NDArray[np.integer]


def turned(degrees: float, axis: int) -> Real:
    """The matrix of a turn about an axis of space."""
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    matrix = np.eye(3)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix[np.ix_((first, second), (first, second))] = [[cos, -sin], [sin, cos]]
    return matrix


def degrees_from_v(uv: Real, F: Faces, flat: Real) -> float:
    """Between v and the image of the second of two coordinates on the surface, in the mean.

    The mean is that of the affine map that fits best; it is not the mean of slopes that the maps are turned by.
    """
    at = np.zeros((len(flat), 2))
    at[np.asarray(F).reshape(-1)] = uv
    fitted, *_ = np.linalg.lstsq(np.column_stack((flat, np.ones(len(flat)))), at, rcond=None)
    return float(np.degrees(np.arctan2(abs(fitted[1, 0]), fitted[1, 1])))


def by_command(tmp_path: Path, shape: str, V: Real, F: Faces, flat: Real, *options: str) -> float:
    run(shape, saved(tmp_path / "in.obj", V, F), tmp_path / "out.obj", "-q", *options)
    return degrees_from_v(read_mesh(tmp_path / "out.obj").corner_uv, F, flat)


def wall() -> tuple[Real, Faces, Real]:
    """Upright in space, turned about the vertical; across it and up it. No diagonals that all lean to one side."""
    V, F = terrain(900)
    V = V * [1.6, 1.0, 0.0]
    return V @ (turned(35.0, 2) @ turned(90.0, 0)).T, F, V[:, :2]


def head() -> tuple[Real, Faces, Real]:
    """The mask raised, leaning back by 25 degrees and turned aside; its own x and y, about which it is symmetric."""
    V, F = mask(1500)
    return V @ (turned(40.0, 2) @ turned(65.0, 0)).T, F, V[:, :2]


def ground() -> tuple[Real, Faces, Real]:
    """A terrain of slopes that cancel out; north is up on maps."""
    V, F = terrain(900)
    return V * [1.0, 1.0, 0.1], F, V[:, :2]


@pytest.mark.parametrize(
    ("shape", "surface"),
    [(shape, surface) for surface in (wall, head, ground) for shape in ("disk", "free")]
    + [("rectangle", wall), ("rectangle", ground)],
)
def test_up_is_v_within_a_degree(tmp_path: Path, shape: str, surface):
    V, F, flat = surface()
    assert by_command(tmp_path, shape, V, F, flat) < 1.0
    y_up = V @ turned(-90.0, 0).T  # z becomes y
    assert by_command(tmp_path, shape, y_up, F, flat, "--upright", "y") < 1.0


def test_without_it_a_map_lies_as_it_was_found(tmp_path: Path):
    V, F, flat = head()
    assert by_command(tmp_path, "free", V, F, flat, "--upright", "none") > 5.0


def test_straight_sides_of_what_lies_flat_run_along_the_squares(tmp_path: Path):
    """The ground turned by 30 degrees: as a disk it has north up, by its outline the nearest of its sides."""
    V, F, flat = ground()
    V = V @ turned(30.0, 2).T
    assert by_command(tmp_path, "free", V, F, flat) < 1.0
    assert by_command(tmp_path, "disk", V, F, V[:, :2]) < 1.0


def test_the_surface_in_the_picture_stands_as_its_charts():
    from conformal_uv.pictures.first_view import seen_triangles

    V, F, flat = head()
    for upright, space in ((Upright.Z, V), (Upright.Y, V @ turned(-90.0, 0).T)):
        picture, _, _ = seen_triangles(space[F], upright)
        assert degrees_from_v(picture.reshape(-1, 2), F, flat) < 1.0

"""Draw the icons of the extension's toolbar: python -m tools.tool_icons.

Blender keeps such icons as triangles: "VCO\\0", the width and height and the place of the first corner in a byte each,
then three corners (x, y) for each triangle and the color (red, green, blue, opacity) of each corner, a byte a number.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FOLDER = Path(__file__).resolve().parent.parent / "blender_addon" / "icons"
WHITE, ORANGE = (230, 230, 230, 255), (237, 153, 41, 255)
SIDE = 255
PIECES = 36  # of a circle

Points = NDArray[np.float64]
Triangles = list[tuple[Points, tuple[int, int, int, int]]]


def stroke(curve: Points, width: float, color: tuple[int, int, int, int]) -> Triangles:
    """A line of some width along points (k, 2)."""
    along = np.gradient(curve, axis=0)
    across = along @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    across *= 0.5 * width / np.linalg.norm(across, axis=1, keepdims=True)
    left, right = curve + across, curve - across
    out: Triangles = []
    for k in range(len(curve) - 1):
        out.append((np.array([left[k], right[k], right[k + 1]]), color))
        out.append((np.array([left[k], right[k + 1], left[k + 1]]), color))
    return out


def dot(center: tuple[float, float], radius: float, color: tuple[int, int, int, int]) -> Triangles:
    """A disk."""
    rim = circle(center, radius)
    return [(np.array([center, rim[k], rim[k + 1]]), color) for k in range(PIECES)]


def circle(center: tuple[float, float], radius: float) -> Points:
    """A closed circle, (PIECES + 1, 2)."""
    angle = np.linspace(0.0, 2.0 * np.pi, PIECES + 1)
    return np.array(center) + radius * np.column_stack((np.cos(angle), np.sin(angle)))


def slide() -> Triangles:
    """Circles about a centre that has been moved in the disk: Moebius images of concentric ones."""
    out: Triangles = []
    angle = np.linspace(0.0, 2.0 * np.pi, PIECES + 1)
    for radius, width in ((1.0, 14.0), (0.55, 9.0)):
        z = radius * np.exp(1j * angle)
        moved = (z + 0.4 + 0.25j) / (1.0 + (0.4 - 0.25j) * z)
        out += stroke(127.5 + 108.0 * np.column_stack((moved.real, moved.imag)), width, WHITE)
    return out + dot((127.5 + 43.0, 127.5 + 27.0), 20.0, ORANGE)


def live() -> Triangles:
    """A patch of a grid with pins at its ends."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, 13), np.linspace(-1.0, 1.0, 13))
    z = (x + 1j * y) * (1.0 + 0.18 * (x + 1j * y))
    z = (z - z.mean()) / np.abs(z).max() * 110.0
    place = 115.0 + np.stack((z.real, z.imag + 12.0), axis=-1)
    out: Triangles = []
    for k in (0, 6, 12):
        out += stroke(place[k], 10.0, WHITE) + stroke(place[:, k], 10.0, WHITE)
    for corner in (place[0, 0], place[0, 12], place[12, 12]):
        out += dot(tuple(corner), 22.0, ORANGE)
    return out


def encoded(triangles: Triangles) -> bytes:
    """The file's bytes."""
    corners = np.array([points for points, _ in triangles])
    if corners.min() < 0.0 or corners.max() > SIDE:
        raise ValueError(f"the drawing leaves its square: {corners.min()} to {corners.max()}")
    colors = np.repeat(np.array([color for _, color in triangles], dtype=np.uint8), 3, axis=0)
    return b"VCO\0" + bytes((SIDE, SIDE, 0, 0)) + np.rint(corners).astype(np.uint8).tobytes() + colors.tobytes()


def main() -> None:
    """Write all of them."""
    FOLDER.mkdir(exist_ok=True)
    for name, drawing in (("conformal_slide", slide()), ("conformal_live", live())):
        (FOLDER / f"{name}.dat").write_bytes(encoded(drawing))


if __name__ == "__main__":
    main()

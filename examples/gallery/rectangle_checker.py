"""A strip of hills on a rectangle, whose length for its width is the strip's own: the conformal modulus."""

import numpy as np
from scene import Scene, checker, textured
from surfaces import grid

import conformal_uv as cuv

place, F = grid(360, 150)
turn, across = np.pi * (1.1 - 1.2 * place[:, 0]), place[:, 1] - 0.5
radius = 1.5 + (1.0 + 0.3 * np.sin(4 * turn)) * across + 0.15 * np.cos(3 * turn)
height = 0.16 * np.sin(6 * turn) * np.cos(4 * across) + 0.1 * np.cos(9 * turn + 6 * across)
V = np.column_stack((radius * np.cos(turn), radius * np.sin(turn), height))
found = cuv.rectangle_map(V, F, corners=(0, 359, 360 * 150 - 1, 360 * 149))
print(f"modulus {found.modulus:.4f}, within {found.modulus_bounds}")
uv = found.uv / found.uv[:, 0].max()
scene = Scene(height=380)
scene.add(0, textured(V, F, uv), view=(0.1, -0.8, 0.9), up=(0, 0, 1), texture=checker(40))
scene.add(1, textured(uv, F, uv), flat=True, texture=checker(40))
scene.save("rectangle_checker")

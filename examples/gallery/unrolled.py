"""What can be unrolled comes out exactly: a curled sheet, laid flat with its boundary free."""

import numpy as np
from scene import Scene, checker, textured
from surfaces import grid

import conformal_uv as cuv

place, F = grid(400, 100)
turn = np.sqrt(1.5 + 60 * place[:, 0])  # equal steps of arc length, nearly
radius = 0.13 * turn
V = np.column_stack((radius * np.cos(turn), 2.2 * place[:, 1] * 0.6, radius * np.sin(turn)))
found = cuv.free_map(V, F)
print(f"{found.distortion.angle_mean:.1e} degrees; areas within {np.ptp(found.distortion.area_scale):.1e}")
uv = found.uv @ np.linalg.svd(found.uv - found.uv.mean(axis=0), full_matrices=False)[2].T
uv = (uv - uv.min(axis=0)) / np.ptp(uv[:, 0])
uv *= np.sign(np.linalg.det(np.diff(uv[F[0]], axis=0))) ** np.array([0, 1])
scene = Scene(height=420)
scene.add(0, textured(V, F, uv), view=(0.35, -0.8, 0.55), up=(0, 0, 1), texture=checker(40))
scene.add(1, textured(uv, F, uv), flat=True, texture=checker(40))
scene.save("unrolled")

"""The hat of Choi's report: mapped by arc length of the boundary alone (Tutte's way), and conformally."""

import numpy as np
from scene import Scene, checker, mesh, textured
from scipy.sparse.linalg import splu
from surfaces import hat

import conformal_uv as cuv

V, F = hat()
found = cuv.disk_map(V, F)
loop = found.boundary
steps = np.linalg.norm(np.diff(V[np.append(loop, loop[0])], axis=0), axis=1)
circle = np.exp(2j * np.pi * np.append(0, np.cumsum(steps)[:-1]) / steps.sum())
inner = np.setdiff1d(np.arange(len(V)), loop)
L = cuv.uniform_laplacian(F, len(V)).tocsr()
z = np.zeros(len(V), complex)
z[loop] = circle
solver, pulled = splu(L[inner][:, inner].tocsc()), -(L[inner][:, loop] @ circle)
z[inner] = solver.solve(pulled.real) + 1j * solver.solve(pulled.imag)
tutte = z.view(float).reshape(-1, 2)
print(f"Tutte {cuv.distortion(V, F, tutte).angle_mean:.2f}, conformal {found.distortion.angle_mean:.2f} degrees")
scene = Scene(panels=3, width=1500, height=520)
look, uv = {"texture": checker(24)}, 0.5 + 0.5 * found.uv
scene.add(0, textured(V, F, uv), view=(0.2, -1, 0.75), up=(0, 0, 1), **look)
worst = np.clip(cuv.distortion(V, F, tutte).angle_error.mean(axis=1), 0, 30)
scene.add(1, mesh(tutte, F), flat=True, zoom=0.9, scalars=cuv.angle_colors(worst, most=20.0), rgb=True)
error = found.distortion.angle_error.mean(axis=1)
scene.add(2, mesh(found.uv, F), flat=True, zoom=0.9, scalars=cuv.angle_colors(error, most=20.0), rgb=True)
scene.save("report_hat")

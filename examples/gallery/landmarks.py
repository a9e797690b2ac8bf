"""Three landmarks of a ball, brought to the same three places of the sphere."""

import numpy as np
import pyvista as pv
from scene import ORANGE, Scene, mesh
from surfaces import bumpy_ball

import conformal_uv as cuv

V, F = bumpy_ball()
landmarks = [int(np.argmax(V @ d)) for d in ([1, -0.2, -0.9], [1, 0.2, 0.1], [0.6, -0.9, 0.5])]
xyz = cuv.sphere_map(V, F, landmarks=landmarks).xyz
print(xyz[landmarks].round(9).tolist())
colour = np.linalg.norm(V, axis=1)
scene = Scene()
for panel, place in enumerate((V, xyz)):
    view = (1, -0.45, 0.1)
    scene.add(panel, mesh(place, F), zoom=0.92, view=view, up=(0, 0, 1), scalars=colour, cmap="YlGnBu")
    for mark, paint in zip(place[landmarks], (ORANGE, (0.75, 0.1, 0.2), (0.35, 0.1, 0.5)), strict=True):
        scene.add(panel, pv.Sphere(radius=0.075, center=mark), view=view, up=(0, 0, 1), color=paint)
scene.save("landmarks")

"""The start page's picture: a mask and its disk, a ball and its sphere, a cortex and its flat map."""

import numpy as np
from scene import ORANGE, Scene, by_vertex, checker, mesh, textured, unshared
from sphere_checker import texture
from surfaces import bumpy_ball, cortex

import conformal_uv as cuv
from conformal_uv.samples import mask

scene = Scene(panels=3, rows=2, width=1280, height=860)
V, F = mask(60000)
uv = by_vertex(cuv.unwrap(V, F, shape="disk", upright="y"), F)
scene.add(0, textured(V, F, uv), view=(0.25, 0.1, 1), texture=checker(24))
scene.add(3, textured(uv, F, uv), flat=True, zoom=0.92, texture=checker(24))
V, F = bumpy_ball()
xyz = cuv.sphere_map(V, F, rotation="surface").xyz
uv = cuv.equirectangular(xyz, cuv.PolygonMesh(V, F.ravel(), np.arange(0, F.size + 1, 3)))
for panel, place in ((1, V), (4, xyz)):
    look = {"texture": texture(ORANGE), "zoom": 0.92 if panel == 4 else 1.0}
    scene.add(panel, unshared(place, F, uv.reshape(-1, 2)), view=(1, 0.4, 0.5), up=(0, 0, 1), **look)
V, F, depth = cortex("left")
look = {"scalars": depth, "cmap": "cividis_r", "clim": (-1.2, 1.4)}
scene.add(2, mesh(V, F), view=(-1, 0, 0), up=(0, 0, 1), **look)
scene.add(5, mesh(cuv.disk_map(V, F).uv, F), flat=True, zoom=0.92, **look)
scene.save("hero")

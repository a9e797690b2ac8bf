"""A terrain on the disk, heights in colours and contour lines."""

from scene import Scene, by_vertex, mesh

import conformal_uv as cuv
from conformal_uv.samples import terrain

V, F = terrain(90000)
V = V * [1, 1, 0.7]
uv = by_vertex(cuv.unwrap(V, F, shape="disk"), F)
look = {"scalars": V[:, 2], "cmap": "terrain", "clim": (V[:, 2].min() - 0.1, V[:, 2].max() + 0.1)}
scene = Scene()
scene.add(0, mesh(V, F), view=(0.4, -1, 1.2), up=(0, 0, 1), **look)
contours = mesh(V, F).contour(14, scalars=V[:, 2]).translate((0.001, -0.003, 0.004))
scene.add(0, contours, view=(0.4, -1, 1.2), up=(0, 0, 1), smooth=False, color="#333333", line_width=2)
scene.add(1, mesh(uv, F), flat=True, zoom=0.9, **look)
scene.add(1, mesh(uv, F).contour(14, scalars=V[:, 2]), flat=True, zoom=0.9, color="#333333", line_width=2)
scene.save("terrain_map")

"""What a conformal map does not keep: areas. Red faces grow, blue ones shrink, on the surface and in the disk."""

import numpy as np
from scene import Scene, by_vertex, mesh

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(60000)
found = cuv.unwrap(V, F, shape="disk", upright="y")
scale = found.charts[0].distortion.area_scale
look = {"scalars": cuv.area_colors(scale / np.median(scale), most=4.0), "rgb": True}
scene = Scene()
scene.add(0, mesh(V, F), view=(0.25, 0.1, 1), **look)
scene.add(1, mesh(by_vertex(found, F), F), flat=True, zoom=0.92, **look)
scene.save("area_change")

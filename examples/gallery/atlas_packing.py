"""A ball cut into twenty pieces, each laid flat by itself, packed by their outlines into the unit square."""

import numpy as np
from matplotlib import colormaps
from scene import Scene, mesh
from surfaces import bumpy_ball, sphere_points

import conformal_uv as cuv

V, F = bumpy_ball()
middles = sphere_points(20)[0]
cell = np.argmax(sphere_points(40000)[0][F].mean(axis=1) @ middles.T, axis=1)
edges = np.sort(np.vstack((F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]])), axis=1)
edge, which = np.unique(edges, axis=0, return_inverse=True)
first, last = np.full(len(edge), 99), np.full(len(edge), -1)
np.minimum.at(first, which, np.tile(cell, 3))
np.maximum.at(last, which, np.tile(cell, 3))
found = cuv.unwrap(V, F, seams=edge[first != last], shape="free", pack_rotation="any", margin=0.005)
print(found.summary)
colour = colormaps["tab20"](cell % 20)[:, :3]
scene = Scene()
scene.add(0, mesh(V, F), view=(1, 0.4, 0.5), up=(0, 0, 1), scalars=colour, rgb=True)
scene.add(1, mesh(found.uv, np.arange(F.size).reshape(-1, 3)), flat=True, zoom=0.93, scalars=colour, rgb=True)
scene.save("atlas_packing")

"""A symmetric head has a symmetric map: what mirrors on the surface mirrors on the sphere."""

import numpy as np
from scene import Scene, mesh
from scipy.spatial import cKDTree
from surfaces import head

import conformal_uv as cuv

V, F = head(100000)
twin = cKDTree(V).query(V * [-1, 1, 1])[1]
xyz = cuv.sphere_map(V, F, rotation="surface").xyz
plane = np.linalg.svd(xyz - xyz[twin], full_matrices=False)[2][0]  # the direction from each vertex to its twin
plane *= np.sign(plane @ xyz[np.argmax(V[:, 0])])
off = np.abs(xyz - 2 * np.outer(xyz @ plane, plane) - xyz[twin]).max()
print(f"mirrored to {off:.1e}")
front = xyz[np.argmax(V[:, 2])]
front -= (front @ plane) * plane
front /= np.linalg.norm(front)
turned = xyz @ np.column_stack((plane, np.cross(front, plane), front))
longitude, latitude = np.arctan2(turned[:, 0], turned[:, 2]), np.arcsin(np.clip(turned[:, 1], -1, 1))
stripes = np.cos(18 * longitude) * np.cos(18 * np.arctanh(np.clip(turned[:, 1], -0.99, 0.99)))
left = turned[:, 0] > 0
warm, cool = np.array([0.93, 0.63, 0.36]), np.array([0.36, 0.62, 0.75])
colours = np.where(left[:, None], warm, cool) * (0.9 + 0.12 * np.tanh(6 * stripes))[:, None]
scene = Scene()
for panel, place in enumerate((V, turned)):
    scene.add(panel, mesh(place, F), view=(0.15, 0.05, 1), scalars=np.clip(colours, 0, 1), rgb=True)
scene.save("symmetric_head")

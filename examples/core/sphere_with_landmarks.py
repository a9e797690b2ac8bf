"""A closed surface onto the sphere, three landmarks at given places."""

import numpy as np
from scipy.spatial import ConvexHull

import conformal_uv as cuv

points = np.random.default_rng(0).normal(size=(500, 3))
points *= [1.0, 1.3, 2.0] / np.linalg.norm(points, axis=1, keepdims=True)
F = ConvexHull(points).simplices
a, b, c = points[F].transpose(1, 0, 2)
inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) < 0
F[inward] = F[inward][:, ::-1]

south, front, north = int(points[:, 2].argmin()), int(points[:, 0].argmax()), int(points[:, 2].argmax())
result = cuv.sphere_map(points, F, landmarks=(south, front, north))
print(f"mean angle error {result.distortion.angle_mean:.2f} degrees, {len(result.flipped)} folded")
assert np.allclose(result.xyz[[south, front, north]], [[0, 0, -1], [1, 0, 0], [0, 0, 1]])

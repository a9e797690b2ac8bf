"""Slivers and faces without area: the intrinsic Delaunay Laplacian takes over by itself."""

import numpy as np

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(2000)
V = V * [1.0, 30.0, 1.0]  # stretched: obtuse triangles everywhere
inside = np.setdiff1d(np.arange(len(V)), cuv.DiskMapper(V, F).boundary)
V[inside[0]] = V[F[(F == inside[0]).any(axis=1)][0]].mean(axis=0)
result = cuv.disk_map(V, F)
print(f"{result.laplacian}, {len(result.flipped)} folded, {result.distortion.angle_mean:.2f} degrees")
assert result.laplacian == "intrinsic-delaunay"
try:
    cuv.disk_map(V * [1.0, 0.0, 0.0], F)
except cuv.DegenerateFaceError as error:
    print("refused:", error)
else:
    raise AssertionError("a line is no surface")

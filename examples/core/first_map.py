"""The first map: a surface onto the disk, and how good it is."""

import numpy as np

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(2000)
result = cuv.disk_map(V, F)
print(f"mean angle error {result.distortion.angle_mean:.3f} degrees, {len(result.flipped)} faces folded")
assert np.allclose(np.linalg.norm(result.uv[result.boundary], axis=1), 1.0)
assert result.converged and len(result.flipped) == 0

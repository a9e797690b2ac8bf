"""A cortex on the sphere, in the colours of its sulci; no vertex is lost and no face folds."""

from scene import Scene, mesh
from surfaces import hemisphere

import conformal_uv as cuv

V, F, depth = hemisphere("left")
found = cuv.sphere_map(V, F, rotation="surface")
print(f"{found.distortion.angle_mean:.2f} degrees, {len(found.flipped)} folds")
look = {"scalars": depth, "cmap": "cividis_r", "clim": (-1.2, 1.4), "view": (-1, 0, 0.15), "up": (0, 0, 1)}
scene = Scene()
scene.add(0, mesh(V, F), **look)
scene.add(1, mesh(found.xyz, F), zoom=0.85, **look)
scene.save("brain_sphere")

"""A cortex without its medial wall, flattened to the disk in the colours of its sulci (dark) and gyri."""

from scene import Scene, mesh
from surfaces import cortex

import conformal_uv as cuv

V, F, depth = cortex("left")
uv = cuv.disk_map(V, F, balance="area").uv
look = {"scalars": depth, "cmap": "cividis_r", "clim": (-1.2, 1.4)}
scene = Scene(panels=3, width=1500, height=520)
scene.add(0, mesh(V, F), view=(-1, 0, 0), up=(0, 0, 1), **look)
scene.add(1, mesh(V, F), view=(1, 0, 0), up=(0, 0, 1), **look)
scene.add(2, mesh(uv, F), flat=True, zoom=0.9, **look)
scene.save("cortex_flat")

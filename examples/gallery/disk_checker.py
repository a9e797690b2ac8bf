"""A mask on the unit disk, with one checker on both: squares stay square, and grow where the disk has less room."""

from scene import Scene, by_vertex, checker, textured

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(60000)
found = cuv.unwrap(V, F, shape="disk", upright="y")
uv, look = by_vertex(found, F), {"texture": checker(24)}
scene = Scene()
scene.add(0, textured(V, F, uv), view=(0.25, 0.1, 1), **look)
scene.add(1, textured(uv, F, uv), flat=True, zoom=0.92, **look)
scene.save("disk_checker")

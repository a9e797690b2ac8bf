"""A mask laid flat with its boundary free: the least change of size that angles allow."""

from scene import Scene, by_vertex, checker, textured

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(60000)
found = cuv.unwrap(V, F, shape="free", upright="y")
uv, look = by_vertex(found, F), {"texture": checker(24)}
scene = Scene()
scene.add(0, textured(V, F, uv), view=(0.25, 0.1, 1), **look)
scene.add(1, textured(uv, F, uv), flat=True, zoom=0.92, **look)
scene.save("free_checker")

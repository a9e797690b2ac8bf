"""Conformal slide: the disk moved onto itself by Moebius maps, in five frames, all equally conformal."""

from scene import Scene, by_vertex, checker, textured

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(40000)
z = (2 * by_vertex(cuv.unwrap(V, F, shape="disk", upright="y"), F) - 1) @ [1, 1j]
scene = Scene(panels=5, rows=2, width=1400, height=620)
for frame, centre in enumerate((-0.6, -0.3, 0, 0.3j, 0.6j)):
    w = cuv.Moebius.disk_translation(0, centre)(z)
    uv = 0.5 + 0.5 * w.view(float).reshape(-1, 2)
    look = {"texture": checker(20)}
    scene.add(frame, textured(V, F, uv), view=(0.2, 0.1, 1), **look)
    grid = 0.5 + 0.5 * z.view(float).reshape(-1, 2)
    scene.add(5 + frame, textured(uv, F, grid), flat=True, zoom=0.88, **look)
scene.save("conformal_slide")

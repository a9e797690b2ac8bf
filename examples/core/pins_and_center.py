"""The Moebius freedom: a vertex at the center, one at angle 0, or three pins."""

import numpy as np

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(2000)
mapper = cuv.DiskMapper(V, F)
tip = int(np.argmax(V[:, 2]))
centered = mapper.map(center=tip, boundary_vertex=int(mapper.boundary[10]))
print("center at", centered.uv[tip], "and", centered.uv[mapper.boundary[10]])
assert np.allclose(centered.uv[tip], 0.0) and np.allclose(centered.uv[mapper.boundary[10]], [1.0, 0.0])

third = len(mapper.boundary) // 3
pins = [int(mapper.boundary[k * third]) for k in range(3)]
pinned = mapper.map(pins=pins)
print("pins at", pinned.uv[pins].round(3).tolist())
assert np.allclose(pinned.uv[pins] @ [1, 1j], np.exp(2j * np.pi / 3 * np.arange(3)))

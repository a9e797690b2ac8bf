"""Factorized once, asked again: another method or center costs little."""

import time

import conformal_uv as cuv
from conformal_uv.samples import terrain

V, F = terrain(20000)
mapper = cuv.DiskMapper(V, F)
for options in ({"method": "linear"}, {"method": "newton"}, {"center": 5000}, {"center": 6000}):
    start = time.perf_counter()
    result = mapper.map(**options)
    print(f"{options}: {time.perf_counter() - start:.3f} s, mean {result.distortion.angle_mean:.3f} degrees")
    assert len(result.flipped) == 0

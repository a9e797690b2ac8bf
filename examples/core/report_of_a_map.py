"""All numbers of an unwrap in one object, as the command and the wrappers show them."""

import conformal_uv as cuv
from conformal_uv.samples import mask, spherical_cap

(V1, F1), (V2, F2) = mask(800), spherical_cap(500)
V, F = [*V1.tolist(), *(V2 + [5.0, 0.0, 0.0]).tolist()], [*F1.tolist(), *(F2 + len(V1)).tolist()]
numbers = cuv.unwrap_numbers(cuv.unwrap(V, F))
d = numbers.distortion
print(f"{numbers.mapped_charts} of {numbers.charts} charts; angle error mean {d.angle_mean:.3f}, rms {d.angle_rms:.3f}")
print(f"area ratio {d.area_ratio:.2f}; lost to single precision: {numbers.lost_to_float32.sum()}")
assert numbers.mapped_charts == 2 and d.angle_mean <= d.angle_rms <= d.angle_max

"""Polygons with seams: a box cut along its edges, a chart for each side, packed into the unit square."""

import numpy as np

import conformal_uv as cuv

V = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
seams = {tuple(sorted((side[k - 1], side[k]))) for side in sides for k in range(4)}
result = cuv.unwrap(V, sides, seams=sorted(seams))
print(result.summary)
assert len(result.charts) == 6 and result.mapped.all()
assert result.uv.min() >= 0.0 and result.uv.max() <= 1.0

closed = cuv.unwrap(V, sides)  # without seams it has no boundary
print(closed.summary)
assert not closed.mapped.any()
remedies = {way.option: way.value for way in closed.charts[0].error.ways if isinstance(way, cuv.Remedy) and way.value}
assert cuv.unwrap(V, sides, **remedies).mapped.all()

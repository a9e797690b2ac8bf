"""Conformal Sphere Map: a shape key on closed meshes, nothing on others."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import scenes

import conformal_uv as cuv


def positions(data) -> np.ndarray:
    out = np.empty(3 * len(data), dtype=np.float32)
    data.foreach_get("co", out)
    return out.reshape(-1, 3)


@pytest.fixture
def egg():
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
    ob = bpy.context.object
    ob.scale = (1, 1.3, 1.8)
    bpy.ops.object.transform_apply(scale=True)
    return ob


def test_shape_key_is_the_librarys_map_around_the_surface(egg):
    before = positions(egg.data.vertices)
    assert bpy.ops.object.conformal_sphere() == {"FINISHED"}
    key = egg.data.shape_keys.key_blocks["Conformal Sphere"]
    F = np.array([list(polygon.vertices) for polygon in egg.data.polygons])
    expected = cuv.sphere_map(before.astype(float), F, rotation="surface").around_surface
    # Shape keys are single precision.
    np.testing.assert_allclose(positions(key.data), expected, rtol=0, atol=1e-6)
    np.testing.assert_array_equal(positions(egg.data.shape_keys.key_blocks["Basis"].data), before)
    assert key.value == 1.0
    bpy.ops.object.conformal_sphere(method="LINEAR")
    assert len(egg.data.shape_keys.key_blocks) == 2


@pytest.mark.parametrize("layout", ["EQUIRECTANGULAR", "OCTAHEDRAL"])
def test_uvs_are_torn_along_faces_only(egg, layout):
    bpy.ops.object.conformal_sphere(uv=layout)
    uv = np.empty(2 * len(egg.data.loops), dtype=np.float32)
    egg.data.uv_layers.active.uv.foreach_get("vector", uv)
    a, b, c = uv.reshape(-1, 3, 2).astype(float).transpose(1, 0, 2)
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    around_poles = 2 if layout == "EQUIRECTANGULAR" else 0  # a face with a pole inside has all longitudes
    assert (area <= 0).sum() <= around_poles and np.abs(area).max() < 0.1


def test_a_mesh_that_is_no_sphere_is_left_alone(egg):
    bpy.ops.mesh.primitive_torus_add()
    torus = bpy.context.object
    with pytest.raises(RuntimeError, match="genus 1"):
        bpy.ops.object.conformal_sphere()
    assert torus.data.shape_keys is None
    egg.select_set(True)
    assert bpy.ops.object.conformal_sphere() == {"FINISHED"}
    assert torus.data.shape_keys is None and egg.data.shape_keys is not None


def test_poll_says_why(egg):
    egg.select_set(False)
    with pytest.raises(RuntimeError, match="Select a mesh object"):
        bpy.ops.object.conformal_sphere()


def test_errors_name_polygons():
    """A box of quads with one of them standing twice, and a loose vertex before all others."""
    V = [[5, 5, 5]] + [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    quads = [[v + 1 for v in quad] for quad in quads]
    scenes.mesh_object(V, [*quads[:-1], quads[-1][::-1]])
    with pytest.raises(RuntimeError, match="1 face is wound against their neighbours: face 5[.]"):
        bpy.ops.object.conformal_sphere()

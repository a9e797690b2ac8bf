"""Conformal Flatten: lengths of what can be unrolled, tears, shape keys, refusals; UVs in Geometry Nodes."""

from __future__ import annotations

import bpy
import measured
import numpy as np
import pytest
import scenes


def cylinder(turns=24, height=3.0):
    """An open cylinder of radius 1, with a seam along one line."""
    turn = 2.0 * np.pi * np.arange(turns) / turns
    V = np.concatenate([np.column_stack((np.cos(turn), np.sin(turn), 0 * turn + z)) for z in (0.0, height)])
    k = np.arange(turns)
    quads = np.stack((k, (k + 1) % turns, (k + 1) % turns + turns, k + turns), axis=1)
    ob = scenes.mesh_object(V, quads.tolist(), "Cylinder")
    scenes.mark_seams(ob, lambda a, b: a.x > 0.999 and b.x > 0.999)
    return ob


def points(data):
    out = np.empty(3 * len(data), dtype=np.float32)
    data.foreach_get("co", out)
    return out.reshape(-1, 3).astype(float)


def test_a_cylinder_is_unrolled_at_its_size():
    ob = cylinder()
    ob.scale = (2.0, 2.0, 2.0)
    ob.location = (5.0, 0.0, 1.0)
    ob.data.materials.append(bpy.data.materials.new("Cloth"))
    bpy.ops.uv.conformal_unwrap(shape="FREE", upright="Z")
    assert bpy.ops.object.conformal_flatten() == {"FINISHED"}
    flat = bpy.context.object
    assert flat.name == "Cylinder Flat" and bpy.context.selected_objects == [flat]
    V = points(flat.data.vertices)
    around = 24 * 2.0 * np.sin(np.pi / 24)  # the polygon's own length
    np.testing.assert_allclose(np.ptp(V, axis=0), [2.0 * around, 6.0, 0.0], atol=1e-3)
    assert len(V) == len(ob.data.vertices) + 2 and len(flat.data.polygons) == len(ob.data.polygons)
    vertex = np.empty(len(V), dtype=np.int32)
    flat.data.attributes["conformal_vertex"].data.foreach_get("value", vertex)
    own = [list(polygon.vertices) for polygon in ob.data.polygons]
    assert [[int(vertex[v]) for v in polygon.vertices] for polygon in flat.data.polygons] == own
    assert scenes.shadowed(scenes.uvs(flat)) == scenes.shadowed(scenes.uvs(ob))
    assert [material.name for material in flat.data.materials] == ["Cloth"]
    assert tuple(flat.scale) == (1.0, 1.0, 1.0)
    assert tuple(flat.location) == pytest.approx((7.02, 0.0, 1.0))  # beside it
    assert not flat.data.validate()


def test_islands_lie_side_by_side_and_uvs_may_be_taken_as_they_are():
    ob = scenes.primitive("cube", size=2.0)
    for edge in ob.data.edges:
        edge.use_seam = True
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    uv = scenes.uvs(ob)
    bpy.ops.object.conformal_flatten(gap=0.5)
    flat = bpy.context.object.data
    V = points(flat.vertices)[[loop.vertex_index for loop in flat.loops]].reshape(-1, 4, 3)[:, :, :2]
    low, high = V.min(axis=1), V.max(axis=1)
    np.testing.assert_allclose(high - low, 2.0, atol=1e-3)
    apart = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2) + np.diag([np.inf] * 6)
    assert apart.min() >= 0.5 - 1e-4
    scenes.select(ob)
    bpy.ops.object.conformal_flatten(size="UV")
    flat = bpy.context.object
    corner = [loop.vertex_index for loop in flat.data.loops]
    np.testing.assert_array_equal(points(flat.data.vertices)[corner][:, :2].astype(np.float32), uv)


@pytest.mark.parametrize("shape", ["DISK", "FREE", "RECTANGLE"])
def test_shape_key(shape):
    ob = scenes.grid(height=0.4)
    before = points(ob.data.vertices)
    bpy.ops.uv.conformal_unwrap(shape=shape, upright="NONE")
    assert bpy.ops.object.conformal_flatten(result="SHAPE_KEY") == {"FINISHED"}
    key = ob.data.shape_keys.key_blocks["Conformal Flat"]
    flat = points(key.data)
    assert key.value == 1.0 and np.ptp(flat[:, 2]) < 1e-6
    np.testing.assert_array_equal(points(ob.data.shape_keys.key_blocks["Basis"].data), before)
    corner = [loop.vertex_index for loop in ob.data.loops]
    uv = scenes.uvs(ob).astype(float)
    spread = flat[corner][:, :2] - flat[corner][0, :2]
    factor = np.ptp(spread) / np.ptp(uv - uv[0])
    np.testing.assert_allclose(spread, factor * (uv - uv[0]), atol=1e-4)
    corners = measured.triangles(ob)
    area = [
        0.5 * np.linalg.norm(np.cross(*(P[corners][:, k] - P[corners][:, 0] for k in (1, 2))), axis=1).sum()
        for P in (flat[corner], before[corner])
    ]
    assert area[0] == pytest.approx(area[1], rel=1e-3)  # bent quads are cut along other diagonals


def test_what_can_not_be_flattened_is_told_and_left():
    ob = cylinder()
    bpy.ops.uv.conformal_unwrap(shape="FREE")
    with pytest.raises(RuntimeError, match="torn at 2 vertices; make a new object"):
        bpy.ops.object.conformal_flatten(result="SHAPE_KEY")
    assert ob.data.shape_keys is None
    ob.scale = (1.0, 2.0, 1.0)
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match="scale is not uniform; apply it first"):
        bpy.ops.object.conformal_flatten()
    ob.data.uv_layers.remove(ob.data.uv_layers[0])
    with pytest.raises(RuntimeError, match="no UV map; unwrap it first"):
        bpy.ops.object.conformal_flatten()
    assert len(bpy.data.objects) == 1


def test_geometry_nodes_read_what_the_operator_wrote():
    """The nodes of docs/blender.md: all edges split, points moved by a named attribute of corners, and merged again."""
    ob = cylinder()
    assert bpy.ops.uv.conformal_unwrap(shape="FREE", uv_layer="pattern") == {"FINISHED"}
    attribute = ob.data.attributes["pattern"]
    assert (attribute.domain, attribute.data_type) == ("CORNER", "FLOAT2")
    tree = bpy.data.node_groups.new("Flat", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    kinds = (
        "NodeGroupInput",
        "GeometryNodeSplitEdges",
        "GeometryNodeSetPosition",
        "GeometryNodeMergeByDistance",
        "GeometryNodeInputNamedAttribute",
        "NodeGroupOutput",
    )
    start, split, move, merge, uv, end = (tree.nodes.new(kind) for kind in kinds)
    uv.data_type = "FLOAT_VECTOR"
    uv.inputs["Name"].default_value = "pattern"
    merge.inputs["Distance"].default_value = 1e-4
    vector = next(socket for socket in uv.outputs if socket.name == "Attribute" and socket.enabled)
    for one, other in (
        (start.outputs[0], split.inputs["Mesh"]),
        (split.outputs[0], move.inputs["Geometry"]),
        (vector, move.inputs["Position"]),
        (move.outputs[0], merge.inputs["Geometry"]),
        (merge.outputs[0], end.inputs[0]),
    ):
        tree.links.new(one, other)
    ob.modifiers.new("Flat", "NODES").node_group = tree
    made = ob.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    corner = [loop.vertex_index for loop in made.loops]
    np.testing.assert_allclose(points(made.vertices)[corner][:, :2], scenes.uvs(ob, "pattern"), atol=1e-5)
    assert len(made.vertices) == len(ob.data.vertices) + 2  # torn along the seam alone


@pytest.mark.parametrize("mode", [scenes.leave, scenes.edit])
def test_vectors_of_corners_are_written_too(mode):
    """Where eight UV maps are taken, and for what is to stay out of their list."""
    ob = scenes.grid()
    while len(ob.data.uv_layers) < 8:
        ob.data.uv_layers.new()
    attribute = ob.data.attributes.new("flat", "FLOAT_VECTOR", "CORNER")
    attribute.data.foreach_set("vector", np.full(3 * len(ob.data.loops), 7.0, dtype=np.float32))
    kept = scenes.shadowed(scenes.uvs(ob, "UVMap"))
    mode()
    assert bpy.ops.uv.conformal_unwrap(shape="FREE", uv_layer="flat") == {"FINISHED"}
    scenes.leave()
    values = np.empty(3 * len(ob.data.loops), dtype=np.float32)
    ob.data.attributes["flat"].data.foreach_get("vector", values)
    assert scenes.shadowed(scenes.uvs(ob, "UVMap")) == kept
    bpy.ops.uv.conformal_unwrap(shape="FREE", uv_layer="UVMap")
    np.testing.assert_array_equal(values.reshape(-1, 3)[:, :2], scenes.uvs(ob, "UVMap"))
    assert (values.reshape(-1, 3)[:, 2] == 0.0).all()
    ob.data.uv_layers.remove(ob.data.uv_layers[7])
    ob.data.attributes.new("weights", "FLOAT", "POINT")
    with pytest.raises(RuntimeError, match="no vector of face corners"):
        bpy.ops.uv.conformal_unwrap(uv_layer="weights")

"""Packing: what margins mean beside Blender's own packer, coverage, all edited objects, what is left alone."""

from __future__ import annotations

import bpy
import measured
import numpy as np
import pytest
import scenes

# Blender's packer rounds its search to parts of a percent; ours to a cell of about 1 / 500.
ONE_CELL = 0.004


def quads(count=4, size=0.1):
    """Quads apart in space, each an island of this size in the texture."""
    x = 3.0 * np.arange(count)[:, None]
    V = np.stack([x + [0, 1, 1, 0], 0 * x + [0, 0, 1, 1], 0 * x + np.zeros(4)], axis=2).reshape(-1, 3)
    ob = scenes.mesh_object(V, np.arange(4 * count).reshape(-1, 4).tolist(), "Quads")
    write(ob, size * V[:, :2])
    return ob


def write(ob, uv):
    ob.data.uv_layers.active.uv.foreach_set("vector", np.asarray(uv, dtype=np.float32).reshape(-1))


def pack(ob, operator, **options):
    scenes.select(ob)
    scenes.edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")
    assert operator(**options) == {"FINISHED"}
    scenes.leave()


def margins(ob):
    """To the sides of the square, and between quads."""
    quad = scenes.uvs(ob).reshape(-1, 4, 2)
    low, high = quad.min(axis=1), quad.max(axis=1)
    apart = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2) + np.diag([np.inf] * len(quad))
    return float(min(low.min(), 1.0 - high.max())), float(apart.min())


@pytest.mark.parametrize(("method", "margin"), [("FRACTION", 0.02), ("ADD", 0.01), ("SCALED", 0.2), ("FRACTION", 0.0)])
def test_margins_mean_what_blenders_mean(method, margin):
    ob = quads()
    pack(ob, bpy.ops.uv.pack_islands, rotate=False, margin_method=method, margin=margin)
    theirs = margins(ob)
    write(ob, 0.1 * np.array([tuple(v.co)[:2] for v in ob.data.vertices]))
    pack(ob, bpy.ops.uv.conformal_pack, margin_method=method, margin=margin)
    assert margins(ob) == pytest.approx(theirs, abs=ONE_CELL)


def test_pixels_are_those_of_the_image():
    ob = quads()
    pack(ob, bpy.ops.uv.conformal_pack, margin_method="PIXELS", margin=8.0, image_size=256)
    side, between = margins(ob)
    assert side == pytest.approx(8.0 / 256, abs=ONE_CELL) and between == pytest.approx(16.0 / 256, abs=ONE_CELL)
    assert side >= 8.0 / 256 - 1e-6 and between >= 16.0 / 256 - 1e-6


def mixed(count=100):
    """Stars, rectangles and triangles of many sizes at all angles, as fans; an island each."""
    rng, V, faces = np.random.default_rng(1), [], []
    for number in range(count):
        turn = 2 * np.pi * np.arange(24) / 24
        z = (
            (1 + 0.45 * np.cos(rng.integers(2, 6) * turn + 1)) * np.exp(1j * turn),
            np.exp(1j * turn) / np.maximum(np.abs(np.cos(turn)), np.abs(np.sin(turn))) * (1 + 0j),
            np.cos(turn) + 0.4j * np.sin(turn),
        )[number % 3]
        z = np.append(z, 0.0) * rng.lognormal(0.0, 0.5) * np.exp(1j * rng.uniform(0, 6.28)) + 20 * number
        faces += [[len(V) + k, len(V) + (k + 1) % 24, len(V) + 24] for k in range(24)]
        V += np.column_stack((z.real, z.imag, 0 * z.real)).tolist()
    ob = scenes.mesh_object(V, faces, "Mixed")
    write(ob, 0.01 * np.array(V)[[loop.vertex_index for loop in ob.data.loops]][:, :2])
    return ob


def covered(ob):
    P = scenes.uvs(ob).astype(float)[measured.triangles(ob)]
    return 0.5 * float(np.abs(np.linalg.det(P[:, 1:] - P[:, :1])).sum())


def test_more_is_covered_than_by_blenders_own():
    ob = mixed()
    how = {"margin_method": "SCALED", "margin": 0.001}  # of a fraction Blender's own makes minutes
    pack(ob, bpy.ops.uv.pack_islands, **how)
    theirs = covered(ob)
    pack(ob, bpy.ops.uv.conformal_pack, pack_rotation="ANY", **how)
    assert covered(ob) > theirs
    assert_apart_on_a_raster(ob)


def test_suzanne_covers_as_much_as_by_blenders_own():
    ob = scenes.primitive("monkey")
    scenes.mark_seams_of_uvs(ob)
    bpy.ops.uv.conformal_unwrap(shape="FREE", closed="CUT", pack_rotation="ANY", margin=0.0)
    ours = covered(ob)
    pack(ob, bpy.ops.uv.pack_islands)
    assert ours >= covered(ob) - 0.002 and ours > 0.645
    bpy.ops.uv.conformal_unwrap(shape="FREE", closed="CUT", margin=0.0)
    assert measured.tilt(ob, 2, measured.largest_island(ob)) == pytest.approx(0.0, abs=0.1)  # upright as long as asked


def assert_apart_on_a_raster(ob, cells=1500):
    """No middle of a cell lies in two islands."""
    uv, corners = scenes.uvs(ob).astype(float), measured.triangles(ob)
    owner = np.repeat(scenes.face_islands(ob), [polygon.loop_total for polygon in ob.data.polygons])
    taken = np.full((cells, cells), -1)
    for triangle in corners:
        a, b, c = uv[triangle] * cells - 0.5
        low = np.clip(np.ceil(np.min([a, b, c], axis=0)).astype(int), 0, cells)
        high = np.clip(np.floor(np.max([a, b, c], axis=0)).astype(int) + 1, low, cells)
        x, y = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
        turns = [(q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) for p, q in ((a, b), (b, c), (c, a))]
        inside = (np.min(turns, axis=0) > 0) | (np.max(turns, axis=0) < 0)
        here = taken[low[1] : high[1], low[0] : high[0]]
        number = owner[triangle[0]]
        assert not (inside & (here >= 0) & (here != number)).any()
        here[inside] = number
    assert (taken >= 0).mean() > 0.3


def test_all_edited_objects_share_the_square_and_others_stay():
    one, other, third = quads(), quads(3, 0.2), quads(2)
    stays = scenes.shadowed(scenes.uvs(third))
    scenes.select(one, other)
    scenes.edit()
    bpy.ops.mesh.select_all(action="SELECT")
    assert bpy.ops.uv.conformal_pack(margin=0.01) == {"FINISHED"}
    scenes.leave()
    both = np.concatenate([scenes.uvs(ob) for ob in (one, other)]).reshape(-1, 4, 2)
    low, high = both.min(axis=1), both.max(axis=1)
    apart = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2) + np.diag([np.inf] * 7)
    assert apart.min() >= 0.02 - 1e-6 and low.min() >= 0.01 - 1e-6 and high.max() <= 0.99 + 1e-6
    side = (high - low)[:, 0]
    np.testing.assert_allclose(side[4:] / side[0], 2.0, rtol=1e-4)
    assert scenes.shadowed(scenes.uvs(third)) == stays
    scenes.select(one, other)
    assert bpy.ops.uv.conformal_pack(average_scale=True) == {"FINISHED"}
    side = [np.ptp(scenes.uvs(ob)[:4], axis=0)[0] for ob in (one, other)]
    assert side[0] == pytest.approx(side[1], rel=1e-4)


def test_only_what_is_selected_is_packed():
    ob = quads()
    before = scenes.uvs(ob)
    for items, count in ((ob.data.polygons, 2), (ob.data.edges, 8), (ob.data.vertices, 8)):
        items.foreach_set("select", np.arange(len(items)) < count)
    scenes.edit()
    assert bpy.ops.uv.conformal_pack(tile=1002) == {"FINISHED"}
    scenes.leave()
    after = scenes.uvs(ob)
    assert scenes.shadowed(after[8:]) == scenes.shadowed(before[8:])
    assert after[:8, 0].min() > 1.0 and after[:8, 1].min() > 0.0 and after[:8, 1].max() < 1.0
    scenes.edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="No visible face with UVs is selected"):
        bpy.ops.uv.conformal_pack()


def test_a_margin_that_is_none_is_told_before_anything_is_done(addon, factorizations):
    ob = scenes.grid()
    before = scenes.shadowed(scenes.uvs(ob))
    with pytest.raises(RuntimeError, match="margin is 0.7"):
        bpy.ops.uv.conformal_unwrap(margin=0.7)
    with pytest.raises(RuntimeError, match="margin is 0.7"):
        bpy.ops.uv.conformal_pack(margin=0.7)
    assert scenes.shadowed(scenes.uvs(ob)) == before and not factorizations


def test_sizes_and_tiles_of_an_unwrap(addon):
    """A plate of 3 x 2 keeps its lengths; on another tile the coverage is told all the same."""
    V = [[0, 0, 0], [3, 0, 0], [3, 2, 0], [0, 2, 0]]
    ob = scenes.mesh_object(V, [[0, 1, 2, 3]], "Plate")
    bpy.ops.uv.conformal_unwrap(shape="FREE", keep_scale=True, upright="NONE")
    assert sorted(np.ptp(scenes.uvs(ob), axis=0)) == pytest.approx([2.0, 3.0], rel=1e-5)
    bpy.ops.uv.conformal_unwrap(shape="FREE", tile=1012)
    uv = scenes.uvs(ob)
    assert uv.min() >= 1.0 - 1e-6 and uv.max() <= 2.0 + 1e-6
    assert addon.last_result.last().objects[0].coverage == pytest.approx(2.0 / 3.0, abs=0.01)

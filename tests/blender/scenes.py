"""Objects for the tests, and what is read back of them."""

from __future__ import annotations

import bpy
import numpy as np


def grid(columns=12, rows=9, height=0.15, name="Grid"):
    """A bent grid of quads; selected, active, all its faces selected."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, columns + 1), np.linspace(-0.8, 0.8, rows + 1))
    z = height * np.sin(3.0 * x + 1.0) * np.cos(2.0 * y)
    k = np.arange(x.size).reshape(x.shape)
    quads = np.stack((k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]), axis=-1).reshape(-1, 4)
    return mesh_object(np.column_stack((x.ravel(), y.ravel(), z.ravel())), quads.tolist(), name)


def mesh_object(V, polygons, name="Mesh"):
    """An object of these vertices and polygons, with a UV map; selected, active, all its faces selected."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.asarray(V).tolist(), [], polygons)
    mesh.update(calc_edges=True)
    mesh.uv_layers.new(name="UVMap")
    values = np.linspace(0.1, 0.7, 2 * len(mesh.loops), dtype=np.float32)
    mesh.uv_layers[0].uv.foreach_set("vector", values)
    for flag in (".select_vert", ".select_edge", ".select_poly"):
        if mesh.attributes.get(flag) is not None:  # 5.0's update makes one of the wrong type
            mesh.attributes.remove(mesh.attributes[flag])
    for items in (mesh.vertices, mesh.edges, mesh.polygons):
        for item in items:
            item.select = True
    ob = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(ob)
    select(ob)
    return ob


def select(*objects):
    """Select these objects alone, the first one active."""
    bpy.context.view_layer.update()  # new objects can not be selected before
    for ob in bpy.context.view_layer.objects:
        ob.select_set(ob in objects)
    bpy.context.view_layer.objects.active = objects[0]


def primitive(kind, **options):
    """One of Blender's own primitives: "monkey", "cube", ..."""
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**options)
    return bpy.context.object


def edit():
    bpy.ops.object.mode_set(mode="EDIT")


def leave():
    bpy.ops.object.mode_set(mode="OBJECT")


def uvs(ob, layer=None):
    """UVs of every corner as stored, (k, 2) float32; in Object Mode."""
    mesh = ob.data
    layer = mesh.uv_layers.active if layer is None else mesh.uv_layers[layer]
    values = np.empty(2 * len(mesh.loops), dtype=np.float32)
    layer.uv.foreach_get("vector", values)
    return values.reshape(-1, 2)


def arrays(ob):
    """Vertices (n, 3) float64 and polygons as lists, read by other means than the extension's."""
    mesh = ob.data
    V = np.array([tuple(vertex.co) for vertex in mesh.vertices], dtype=np.float64)
    return V, [list(polygon.vertices) for polygon in mesh.polygons]


def seams(ob):
    """Seams as vertex pairs."""
    return [tuple(edge.vertices) for edge in ob.data.edges if edge.use_seam]


def mark_seams(ob, chosen):
    """Mark the edges for whose two end points (3,) the function says so."""
    V = [vertex.co for vertex in ob.data.vertices]
    for edge in ob.data.edges:
        edge.use_seam = bool(chosen(*(V[v] for v in edge.vertices)))


def mark_seams_of_uvs(ob):
    """Mark as seams what the active UV map is cut along."""
    select(ob)
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")  # Blender 4.3 takes only selected UVs
    assert bpy.ops.uv.seams_from_islands(mark_seams=True) == {"FINISHED"}
    leave()


def pin(ob, vertices):
    """Pin these vertices' UVs in the active UV map, and no others."""
    pinned = np.isin([loop.vertex_index for loop in ob.data.loops], vertices)
    name = f".pn.{ob.data.uv_layers.active.name}"
    attribute = ob.data.attributes.get(name) or ob.data.attributes.new(name, "BOOLEAN", "CORNER")
    attribute.data.foreach_set("value", pinned)


def select_vertices(ob, vertices):
    """Select these vertices, and no edge or face, in Object Mode."""
    for items in (ob.data.polygons, ob.data.edges, ob.data.vertices):
        items.foreach_set("select", np.zeros(len(items), dtype=bool))
    for vertex in vertices:
        ob.data.vertices[vertex].select = True


def corners_of(ob, faces):
    """Which corners belong to some faces, (k,) bool."""
    corner = np.zeros(len(ob.data.loops), dtype=bool)
    for face in faces:
        corner[list(ob.data.polygons[face].loop_indices)] = True
    return corner


def face_islands(ob):
    """For every face the smallest face that it hangs together with across edges that are not seams."""
    mesh, parent = ob.data, list(range(len(ob.data.polygons)))
    closed = {tuple(sorted(pair)) for pair in seams(ob)}

    def root(face):
        while parent[face] != face:
            face = parent[face]
        return face

    first = {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            if tuple(sorted(key)) in closed:
                continue
            one, other = root(first.setdefault(key, polygon.index)), root(polygon.index)
            parent[max(one, other)] = min(one, other)
    return [root(face) for face in range(len(parent))]


def shadowed(values):
    """Bytes, for comparison bit by bit."""
    return np.ascontiguousarray(values).tobytes()

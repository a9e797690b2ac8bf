"""Texture coordinates of a polygon mesh: charts, each mapped conformally to a disk."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from numpy.typing import ArrayLike

from ..mesh.mesh_objects import MeshObject
from ..progress import Callback
from .arguments import Polygons
from .unwrapped import Unwrapped
from .unwrapper import Unwrapper, Vertices

__all__ = ["unwrap"]


def unwrap(
    V: ArrayLike | MeshObject | None,
    polygons: Polygons | None = None,
    *,
    seams: ArrayLike | None = None,
    selection: ArrayLike | None = None,
    shape: str | Sequence[str] = "disk",
    upright: str = "z",
    refine: bool = False,
    corner_choice: str = "turning",
    method: str = "auto",
    objective: str | None = None,
    pins: Vertices = None,
    pinned_uv: Mapping[int, ArrayLike] | None = None,
    pin_mode: str | None = None,
    center: Vertices = None,
    boundary_vertex: Vertices = None,
    balance: str = "middle",
    rotation: float = 0.0,
    tolerance: float = 1e-10,
    relative_tolerance: float = 0.0,
    max_iterations: int = 50,
    holes: str = "fill",
    outer_loop: Vertices = None,
    closed: str = "refuse",
    nonmanifold: str = "refuse",
    orientation: str = "refuse",
    laplacian: str = "auto",
    repair: str = "auto",
    backend: str = "auto",
    place: str = "fit",
    margin: float | None = None,
    margin_method: str = "between",
    image_size: int = 1024,
    pack_rotation: str = "none",
    pack_shape: str = "outline",
    keep_scale: bool = False,
    tile: int = 1001,
    callback: Callback | None = None,
) -> Unwrapped:
    """Split a polygon mesh into charts and map each conformally onto a disk, or to another shape.

    Charts are the parts of the selected polygons that hang together across edges which are not seams. What is
    wrong with one chart is that chart's error and leaves the others alone. Polygons are never split between
    charts; nothing of the mesh is changed. Vertices of no selected polygon do not matter.

    Parameters
    ----------
    V : (n, 3) floats
        Vertex positions; None where `polygons` is a PolygonMesh; or, without `polygons`, a mesh: (V, polygons), or one
        of trimesh, pyvista, meshio or open3d.
    polygons : (m, k) integers, a list of vertex lists, or a PolygonMesh
        Vertices of each polygon in winding order, 0-based, three or more.
    seams : (s, 2) integers, optional
        Edges to cut along. Seams that end inside a chart and do not reach its circle are closed again where holes
        are filled.
    selection : (p,) bool or polygon indices, optional
        Polygons to map, by default all.
    shape : {"disk", "free", "rectangle"} or one of them for each chart
        What charts become: the unit disk, their own outline (`free_map`), or a rectangle (`rectangle_map`).
    upright : {"z", "y", "none"}
        The axis of the surface that points up in the texture, in the mean over each chart. A chart that lies flat has
        the next axis up (y; for "y" it is -z), and with a free boundary its straight sides along the square's.
        Rectangles are turned by quarters; charts with pins or a boundary vertex are not turned.
    refine : bool
        As in `free_map`, for charts with a free boundary.
    corner_choice : {"turning", "area"}
        As in `rectangle_map`, for charts that become rectangles.
    method, objective, balance, pin_mode, tolerance, relative_tolerance, max_iterations, laplacian, backend
        As in `disk_map`.
    repair
        As in `disk_map`, for all shapes.
    pins : vertices or triples of vertices, optional
        A chart takes those on its boundary, which must be exactly three, or four as the corners of a rectangle, in the
        order of its boundary from the one named first; a note tells where that is another order. A set of pins is an
        offer, and has no order: charts with another number of them on their boundary are not pinned and say so in
        their notes, and rectangles are turned upright.
    pinned_uv : mapping of int to (2,) floats, optional
        Places of polygon corners, rows of ``Unwrapped.uv``. A chart with a free boundary in which two vertices or more
        have one, not all the same, is mapped with these where they are, as by `pinned_map`, and is not turned, refined
        or placed; others do not use them.
    center, boundary_vertex : vertices, optional
        Each is used by the chart in whose interior, or on whose boundary, it lies; of several in one chart the first.
    rotation : float
        Radians, anticlockwise; every chart is turned by it about its center at the end.
    holes : {"fill", "refuse"}
        What to do with all boundary loops but one: fill them for the solution only, or refuse.
    outer_loop : vertices, optional
        Vertices on loops that become circles; by default it is the longest loop of each chart.
    closed : {"refuse", "cut"}
        Charts that are closed or have handles: refuse, or cut them open along polygon edges (a shortest path
        between two far ends of a sphere; a shortened cut graph, Erickson and Whittlesey 2005, where there are
        handles).
    nonmanifold : {"refuse", "cut"}
        Edges of three or more polygons, and vertices where parts touch without sharing an edge: refuse, or cut.
    orientation : {"refuse", "mend"}
        Polygons wound against their neighbours: refuse, or turn the smaller part for the solution and cut
        one-sided charts.
    place : {"fit", "pack", "disk"}
        "disk": every chart on the unit disk, other shapes in the middle of [-1, 1]^2. "fit" and "pack": in the unit
        square; one chart fills it, several are packed, their areas in the same proportion as on the surface.
    margin : float, optional
        Least distance between charts and to the sides of the square, by default 0.005 between several and none about
        one, which then lies at 0.5 + 0.5 (x, y); with very many charts, a quarter of a chart's
        share of the side if that is less.
    margin_method : {"between", "fraction", "pixels", "add", "scaled"}
        What `margin` is. "between": as above. The others as Blender means its margins, kept around every chart, so that
        two of them keep twice as much: a fraction of the side, pixels of an image of `image_size`, a length on the
        surface, or that times a tenth of the sum of the mean sides of the charts' boxes there.
    pack_rotation : {"none", "quarters", "axes", "any"}
        How charts may be turned to be packed: not at all, by quarters, lying along the axes, or in 16 ways and more
        (of more than 64 charts each in 12; more than 150 lie along the axes).
    pack_shape : {"outline", "convex", "box"}
        What is packed of a chart; with "outline" others come to lie in its bays and holes.
    keep_scale : bool
        Nothing is scaled to fit the square: areas are those on the surface, and charts may lie beyond it.
    tile : int
        The UDIM tile that is the square: 1001 is the unit square, 1002 the one to its right, 1011 the one above.
    callback : callable, optional
        Called as ``callback(stage, fraction)``, the fraction over all charts; the work stops with CancelledError
        when it returns False.

    Returns
    -------
    Unwrapped

    Raises
    ------
    MeshError
        The arrays are not a mesh: shapes, types, indices.
    OptionError
        An option that is not taken, a seam that is no edge, a vertex of no selected polygon, or one that no chart
        can use as a center, boundary vertex or pin.
    CancelledError
        The callback returned False.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> cube = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    >>> sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    >>> cuv.unwrap(cube, sides).summary
    'mapped 0 of 1 chart; chart 0 (faces 0, 1, 2, 3, 4, 5): The chart is closed, of genus 0: it has no boundary. ...'
    >>> cuv.unwrap(cube, sides, closed="cut").summary
    'mapped 1 of 1 chart'
    """
    unwrapper = Unwrapper(
        V,
        polygons,
        seams=seams,
        selection=selection,
        holes=holes,
        outer_loop=outer_loop,
        closed=closed,
        nonmanifold=nonmanifold,
        orientation=orientation,
        laplacian=laplacian,
        backend=backend,
        callback=callback,
    )
    return unwrapper.unwrap(
        shape=shape,
        upright=upright,
        refine=refine,
        corner_choice=corner_choice,
        method=method,
        objective=objective,
        pins=pins,
        pinned_uv=pinned_uv,
        pin_mode=pin_mode,
        center=center,
        boundary_vertex=boundary_vertex,
        balance=balance,
        rotation=rotation,
        tolerance=tolerance,
        relative_tolerance=relative_tolerance,
        max_iterations=max_iterations,
        repair=repair,
        place=place,
        margin=margin,
        margin_method=margin_method,
        image_size=image_size,
        pack_rotation=pack_rotation,
        pack_shape=pack_shape,
        keep_scale=keep_scale,
        tile=tile,
        callback=callback,
    )

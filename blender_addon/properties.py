"""The operator's properties, and the same as a plain value that threads, files and the command pass around."""

# No `from __future__ import annotations`: Blender reads the annotations themselves.
from dataclasses import dataclass, fields

from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from conformal_uv.options import Closed, Method


def items(told):
    """Items of an EnumProperty: the library's choices by their Python names, each with its label and description."""
    return tuple((choice.name, label, description) for choice, (label, description) in told.items())


METHODS = items(
    {
        Method.AUTO: (
            "Automatic",
            "Linear or Newton, whichever keeps the angles of an island better",
        ),
        Method.LINEAR: (
            "Linear",
            "One factorization: the Riemann map read off a Green's function; the fastest",
        ),
        Method.NEWTON: (
            "Newton",
            "The least conformal energy, by Newton's method on the boundary angles; where an island is crowded, Linear "
            "may keep angles better",
        ),
        Method.AUGMENTED_LAGRANGIAN: (
            "Augmented Lagrangian",
            "The algorithm of Choi's report with three pins; slow, for comparison",
        ),
    }
)
CENTERS = (
    ("AUTOMATIC", "Automatic", "The vertex deepest inside each island"),
    ("ACTIVE", "Active Vertex", "The active vertex of each object, in the island in whose interior it lies"),
)
CLOSED = items(
    {
        Closed.REFUSE: ("Refuse", "Leave islands without a boundary, or with handles, as they are and say so"),
        Closed.CUT: ("Cut", "Cut them open along edges"),
    }
)
PLACES = (
    (
        "FIT",
        "Fit the Square",
        "One island fills the unit square; several are packed by conformal_uv: of all objects in Edit Mode together, "
        "of selected objects in Object Mode each by itself",
    ),
    ("PACK", "Keep Size and Pack", "Islands keep their relative size; Blender packs those of all objects together"),
)
FACES = (
    (
        "SELECTED",
        "Selected",
        "Selected, visible faces; in Object Mode all visible faces of a mesh with no face selected",
    ),
    ("ALL", "All Visible", "All visible faces"),
)


@dataclass(frozen=True)
class Options:
    """What the user chose; fields as the operator's properties."""

    method: str = Method.AUTO.name
    fill_holes: bool = True
    correct_aspect: bool = True
    use_subsurf_data: bool = False
    use_pins: bool = False
    center: str = "AUTOMATIC"
    rotation: float = 0.0
    repair: bool = True
    closed: str = Closed.REFUSE.name
    place: str = "FIT"
    margin: float = 0.005
    faces: str = "SELECTED"
    uv_layer: str = ""
    only_selected_uvs: bool = False

    @classmethod
    def of(cls, properties: object) -> "Options":
        """Taken from anything with attributes of these names."""
        return cls(**{field.name: getattr(properties, field.name) for field in fields(cls)})


DEFAULTS = Options()


class UnwrapProperties:
    """Properties of the operator, named as Blender's own unwrap names them where it has them."""

    method: EnumProperty(name="Method", description="How the map is computed", items=METHODS, default=DEFAULTS.method)
    fill_holes: BoolProperty(
        name="Fill Holes",
        description="Close all boundaries of an island but its longest for the solution; else such islands are refused",
        default=DEFAULTS.fill_holes,
    )
    correct_aspect: BoolProperty(
        name="Correct Aspect",
        description="Keep disks round on the image of the active face's material, though it be not square",
        default=DEFAULTS.correct_aspect,
    )
    use_subsurf_data: BoolProperty(
        name="Use Subdivision Surface",
        description="Map the surface as the Subdivision Surface modifier makes it",
        default=DEFAULTS.use_subsurf_data,
    )
    use_pins: BoolProperty(
        name="Use Pins",
        description="Send three pinned UVs on the boundary of an island to three equally spaced points of the circle",
        default=DEFAULTS.use_pins,
    )
    center: EnumProperty(
        name="Center", description="What comes to the middle of the disk", items=CENTERS, default=DEFAULTS.center
    )
    rotation: FloatProperty(
        name="Rotation", description="Turn every disk about its center", subtype="ANGLE", default=DEFAULTS.rotation
    )
    repair: BoolProperty(
        name="Repair Folds", description="Unfold faces that came out inverted", default=DEFAULTS.repair
    )
    closed: EnumProperty(
        name="Closed Surfaces",
        description="What to do with islands that have no boundary, or handles",
        items=CLOSED,
        default=DEFAULTS.closed,
    )
    place: EnumProperty(
        name="Place", description="Where the disks go in the texture", items=PLACES, default=DEFAULTS.place
    )
    margin: FloatProperty(
        name="Margin",
        description="Space between islands, as a part of the square's side; one island alone fills the square",
        min=0.0,
        max=0.49,
        soft_max=0.1,
        step=0.1,
        precision=3,
        default=DEFAULTS.margin,
    )
    faces: EnumProperty(name="Faces", description="Which faces are unwrapped", items=FACES, default=DEFAULTS.faces)
    uv_layer: StringProperty(
        name="UV Map",
        description="UV map to write, made when missing; empty: the active one",
        default=DEFAULTS.uv_layer,
    )
    only_selected_uvs: BoolProperty(
        name="Only Selected UVs",
        description="Take only faces with a selected UV, as unwrapping in the UV editor does",
        options={"HIDDEN", "SKIP_SAVE"},
        default=DEFAULTS.only_selected_uvs,
    )

"""The operator's properties, and the same as a plain value that threads, files and the command pass around."""

# No `from __future__ import annotations`: Blender reads the annotations themselves.
from dataclasses import dataclass, fields
from typing import Self

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from conformal_uv.options import Closed, CornerChoice, MarginMethod, Method, PackRotation, PackShape, Shape, Upright

from .choices import (
    CENTERS,
    CLOSED,
    CORNER_CHOICES,
    FACES,
    MARGIN_METHODS,
    METHODS,
    PACK_ROTATIONS,
    PACK_SHAPES,
    PLACES,
    SHAPES,
    UPRIGHT,
)


@dataclass(frozen=True)
class PackOptions:
    """How islands are packed; fields as the operators' properties."""

    margin: float = 0.0025
    margin_method: str = MarginMethod.FRACTION.name
    image_size: int = 1024
    pack_rotation: str = PackRotation.NONE.name
    pack_shape: str = PackShape.OUTLINE.name
    keep_scale: bool = False
    tile: int = 1001

    @classmethod
    def of(cls, properties: object) -> Self:
        """Taken from anything with attributes of these names."""
        return cls(**{field.name: getattr(properties, field.name) for field in fields(cls)})


@dataclass(frozen=True)
class Options(PackOptions):
    """What the user chose; fields as the operator's properties."""

    shape: str = Shape.DISK.name
    method: str = Method.AUTO.name
    fill_holes: bool = True
    correct_aspect: bool = True
    use_subsurf_data: bool = False
    use_pins: bool = False
    corner_choice: str = CornerChoice.TURNING.name
    refine: bool = False
    center: str = "AUTOMATIC"
    upright: str = Upright.Z.name
    rotation: float = 0.0
    repair: bool = True
    closed: str = Closed.REFUSE.name
    place: str = "FIT"
    faces: str = "SELECTED"
    uv_layer: str = ""
    only_selected_uvs: bool = False

    def as_arguments(self) -> dict[str, object]:
        """Keywords for the operator; what it finds out by itself is left out."""
        return {field.name: getattr(self, field.name) for field in fields(self) if field.name != "only_selected_uvs"}

    @property
    def takes_pins(self) -> bool:
        """Whether pinned vertices go to places of the shape; where the boundary is free, they stay."""
        return self.use_pins and self.shape != Shape.FREE.name

    @property
    def holds_pins(self) -> bool:
        """Whether islands are mapped with their pinned UVs where they are."""
        return self.use_pins and self.shape == Shape.FREE.name

    @property
    def takes_active(self) -> bool:
        """Whether the active vertex is asked for; only disks have a center."""
        return self.shape == Shape.DISK.name and self.center == "ACTIVE"

    @property
    def takes_selected_corners(self) -> bool:
        """Whether selected vertices may be the corners of rectangles."""
        return self.shape == Shape.RECTANGLE.name and self.use_pins


DEFAULTS = Options()
SHOWN = {  # names in the redo panel, by shape and then for all
    Shape.DISK.name: ("method", "center", "use_pins"),
    Shape.FREE.name: ("refine", "use_pins"),
    Shape.RECTANGLE.name: ("corner_choice", "use_pins"),
}
PACKING = tuple(field.name for field in fields(PackOptions))
SHOWN_FOR_ALL = (
    ("upright", "rotation"),
    ("place", *PACKING, "correct_aspect"),
    ("faces", "fill_holes", "closed", "repair", "use_subsurf_data"),
    ("uv_layer",),
)


class PackProperties:
    """Properties of the operators that pack, named as Blender's own packer names them where it has them."""

    margin: FloatProperty(
        name="Margin",
        description="Space kept around every island, twice that between two.\n"
        "One island that is unwrapped alone fills the square",
        min=0.0,
        max=1000.0,
        soft_max=0.1,
        step=0.1,
        precision=4,
        default=DEFAULTS.margin,
    )
    margin_method: EnumProperty(
        name="Margin Method",
        description="What the margin is, as in Blender's own packer.\nPixels for an image of known size",
        items=MARGIN_METHODS,
        default=DEFAULTS.margin_method,
    )
    image_size: IntProperty(
        name="Image Size",
        description="Side of the image that pixels of the margin are counted on.\nFor the margin method Pixels",
        min=1,
        max=1 << 20,
        soft_max=1 << 14,
        default=DEFAULTS.image_size,
    )
    pack_rotation: EnumProperty(
        name="Rotate",
        description="How islands may be turned to fill more of the square.\nWhat was upright is so no more",
        items=PACK_ROTATIONS,
        default=DEFAULTS.pack_rotation,
    )
    pack_shape: EnumProperty(
        name="Shape Method",
        description="What is packed of an island.\nExact Shape fills the most, Bounding Box keeps bays free",
        items=PACK_SHAPES,
        default=DEFAULTS.pack_shape,
    )
    keep_scale: BoolProperty(
        name="Keep Scale",
        description="Do not scale islands to fit the square, beyond which they may lie.\n"
        "Unwrapped islands have the size of their surface, a unit of length a unit of UV",
        default=DEFAULTS.keep_scale,
    )
    tile: IntProperty(
        name="UDIM Tile",
        description="The tile to pack into.\n1001 is the first, 1002 to its right, 1011 above it",
        min=1001,
        max=2000,
        default=DEFAULTS.tile,
    )


class UnwrapProperties(PackProperties):
    """Properties of the operator, named as Blender's own unwrap names them where it has them."""

    shape: EnumProperty(
        name="Shape",
        description="What islands become.\nFree for most meshes, Disk for round islands, Rectangle for strips",
        items=SHAPES,
        default=DEFAULTS.shape,
    )
    method: EnumProperty(
        name="Method",
        description="How the map is computed.\nAutomatic unless time or a comparison matters",
        items=METHODS,
        default=DEFAULTS.method,
    )
    fill_holes: BoolProperty(
        name="Fill Holes",
        description="Close all boundaries of an island but its longest for the solution.\n"
        "Off: islands with holes are refused",
        default=DEFAULTS.fill_holes,
    )
    correct_aspect: BoolProperty(
        name="Correct Aspect",
        description="Keep angles on the image of the active face's material.\nFor textures that are not square",
        default=DEFAULTS.correct_aspect,
    )
    use_subsurf_data: BoolProperty(
        name="Use Subdivision Surface",
        description="Map the surface as the Subdivision Surface modifier makes it.\n"
        "When the subdivided object is what gets the texture",
        default=DEFAULTS.use_subsurf_data,
    )
    use_pins: BoolProperty(
        name="Use Pins",
        description="Free: islands with two pinned UVs or more follow them. Disks: three on the boundary go to equally "
        "spaced points of the circle.\n"
        "Rectangles: four on the boundary are the corners; of a mesh without pins four selected vertices, while no "
        "face is selected",
        default=DEFAULTS.use_pins,
    )
    corner_choice: EnumProperty(
        name="Corners",
        description="What the corners of a rectangle are.\nWhere no pins give them",
        items=CORNER_CHOICES,
        default=DEFAULTS.corner_choice,
    )
    refine: BoolProperty(
        name="Refine",
        description="Move all vertices for the last percents of angle error, never to the worse.\n"
        "For final maps: takes about four times as long",
        default=DEFAULTS.refine,
    )
    center: EnumProperty(
        name="Center",
        description="What comes to the middle of the disk.\nArea Balance where parts come out too small",
        items=CENTERS,
        default=DEFAULTS.center,
    )
    upright: EnumProperty(
        name="Upright",
        description="Turn every island so that up on the surface is up in the texture.\nDisks with pins are not turned",
        items=UPRIGHT,
        default=DEFAULTS.upright,
    )
    rotation: FloatProperty(
        name="Rotation",
        description="Turn every island about its center.\nAfter all else, Upright too",
        subtype="ANGLE",
        default=DEFAULTS.rotation,
    )
    repair: BoolProperty(
        name="Repair Folds",
        description="Unfold faces that came out inverted.\nOff: they stay, and are counted",
        default=DEFAULTS.repair,
    )
    closed: EnumProperty(
        name="Closed Surfaces",
        description="What to do with islands that have no boundary, or handles.\nCut where seams are too much work",
        items=CLOSED,
        default=DEFAULTS.closed,
    )
    place: EnumProperty(
        name="Place",
        description="Where islands go in the texture.\nPack Together where objects share it",
        items=PLACES,
        default=DEFAULTS.place,
    )
    faces: EnumProperty(
        name="Faces",
        description="Which faces are unwrapped.\nAll Visible spares selecting them",
        items=FACES,
        default=DEFAULTS.faces,
    )
    uv_layer: StringProperty(
        name="UV Map",
        description="UV map, or vector attribute of face corners, to write; a UV map is made when missing.\n"
        "Empty: the active one",
        default=DEFAULTS.uv_layer,
    )
    only_selected_uvs: BoolProperty(
        name="Only Selected UVs",
        description="Take only faces with a selected UV, as unwrapping in the UV editor does",
        options={"HIDDEN", "SKIP_SAVE"},
        default=DEFAULTS.only_selected_uvs,
    )

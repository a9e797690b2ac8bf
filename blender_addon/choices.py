"""What may be chosen, as the panel names it: the library's own choices, and Blender's beside them."""

from conformal_uv.options import Closed, CornerChoice, MarginMethod, Method, PackRotation, PackShape, Shape, Upright


def items(told):
    """Items of an EnumProperty: the library's choices by their Python names, each with its label and description."""
    return tuple((choice.name, label, description) for choice, (label, description) in told.items())


SHAPES = items(  # the commonest first, here and in menus
    {
        Shape.FREE: (
            "Free",
            "Islands keep their own outline, as long as on the surface: for most meshes; what can be unrolled keeps "
            "its lengths too",
        ),
        Shape.DISK: ("Disk", "Islands become round: for maps that are compared or composed with others on the disk"),
        Shape.RECTANGLE: (
            "Rectangle",
            "Islands become rectangles of the proportions that keep angles: for strips, panels and tiles",
        ),
    }
)
UNWRAPS = (  # menu entries: every shape, by its identifier
    (Shape.FREE.name, "Conformal Unwrap"),
    (Shape.DISK.name, "Conformal Disk Unwrap"),
    (Shape.RECTANGLE.name, "Conformal Rectangle Unwrap"),
)
UPRIGHT = items(
    {
        Upright.Z: ("Z Up", "What is up along Z points up in the texture; of what lies flat, what is up along Y"),
        Upright.Y: ("Y Up", "What is up along Y points up in the texture; of what lies flat, what is up along -Z"),
        Upright.NONE: ("Off", "Islands are not turned"),
    }
)
CORNER_CHOICES = items(
    {
        CornerChoice.TURNING: ("Sharpest Turns", "Where the boundary turns most"),
        CornerChoice.AREA: ("Least Stretch", "Of several choices the one whose map changes areas least; slower"),
    }
)
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
    ("AUTOMATIC", "Automatic", "The place deepest inside each island"),
    ("AREA", "Area Balance", "What gives all parts of an island the most even share of the disk's area"),
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
        "One island fills the unit square; several are packed: of all objects in Edit Mode together, of selected "
        "objects in Object Mode each by itself",
    ),
    ("PACK", "Pack Together", "Islands of all objects are packed into one square, in Object Mode too"),
)
MARGIN_METHODS = items(
    {
        MarginMethod.FRACTION: ("Fraction", "A part of the square's side"),
        MarginMethod.PIXELS: ("Pixels", "Pixels of a square image of the size given"),
        MarginMethod.SCALED: ("Scaled", "A part of a tenth of the sum of the islands' sides, scaled as they are"),
        MarginMethod.ADD: ("Add", "Added to islands as they are before they are scaled to fit the square"),
        MarginMethod.BETWEEN: ("Between", "A part of the square's side, between islands as to the sides of the square"),
    }
)
PACK_ROTATIONS = items(
    {
        PackRotation.NONE: ("Off", "Islands are not turned"),
        PackRotation.QUARTERS: ("Cardinal", "By quarter turns"),
        PackRotation.AXES: ("Axis-aligned", "To lie along the axes, and by quarter turns"),
        PackRotation.ANY: ("Any", "By any angle; fills the most"),
    }
)
PACK_SHAPES = items(
    {
        PackShape.OUTLINE: ("Exact Shape (Concave)", "The outline: others may come to lie in bays and holes"),
        PackShape.CONVEX: ("Boundary Shape (Convex)", "The convex hull"),
        PackShape.BOX: ("Bounding Box", "The box around it"),
    }
)
FACES = (
    (
        "SELECTED",
        "Selected",
        "Selected, visible faces; in Object Mode all visible faces of a mesh with no face selected",
    ),
    ("ALL", "All Visible", "All visible faces"),
)

LABELS = {  # of options that the library proposes: what the panel calls them and their values
    "closed": ("Closed Surfaces", {identifier: name for identifier, name, _ in CLOSED}),
    "method": ("Method", {identifier: name for identifier, name, _ in METHODS}),
}

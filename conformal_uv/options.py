"""Every choice and every option, once: frozen, and checked without a mesh.

What depends on a surface (which vertices exist, which lie on the boundary) is checked where the surface is at hand.
The names of the members' values are those of the library's arguments and of the commands' options.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from operator import index
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from .errors import OptionError, listed

__all__ = [
    "Backend",
    "Balance",
    "ChartOptions",
    "Choice",
    "Closed",
    "CornerChoice",
    "DiskOptions",
    "DistributedSolver",
    "FreeOptions",
    "Holes",
    "Laplacian",
    "MapKind",
    "MarginMethod",
    "Method",
    "NonManifold",
    "Normalization",
    "Objective",
    "Orientation",
    "PackRotation",
    "PackShape",
    "PinMode",
    "Place",
    "PlaceOptions",
    "RectangleOptions",
    "Repair",
    "Rotation",
    "Shape",
    "ShapeOptions",
    "SphereBoundary",
    "SphereLayout",
    "SphereMethod",
    "SphereOptions",
    "SplitOptions",
    "Upright",
    "real_number",
    "vertex_index",
]

INFINITY = float("inf")
FIRST_TILE, TILES_IN_A_ROW = 1001, 10
MOST_SCALE = 50.0  # of a logarithm; the squares of such scale factors are far from what doubles hold
FULL_TURN = 2.0 * np.pi
TURN_ROUNDING = 1e-6
C = TypeVar("C", bound="Choice")


class Choice(StrEnum):
    """One of a few names; a member is equal to its name."""

    @classmethod
    def of(cls, name: str, value: object) -> Self:
        """The member of this value.

        Raises
        ------
        OptionError
            None has it; `name` is that of the option.
        """
        try:
            return cls(value)  # type: ignore[arg-type]
        except ValueError as error:
            raise OptionError(f"{name} is {value!r}; choose {cls._joint().join(cls)}.") from error

    @classmethod
    def _joint(cls) -> str:
        return " or "


class Method(Choice):
    """How a map is found."""

    LINEAR = "linear"
    NEWTON = "newton"
    AUGMENTED_LAGRANGIAN = "augmented-lagrangian"
    AUTO = "auto"


class SphereMethod(Choice):
    """How a map to the sphere is found."""

    LINEAR = "linear"
    SCHWARZ = "schwarz"
    NEWTON = "newton"
    AUGMENTED_LAGRANGIAN = "augmented-lagrangian"
    AUTO = "auto"


class Objective(Choice):
    """What is minimised: the Dirichlet energy less the area of the image, or the Dirichlet energy."""

    CONFORMAL = "conformal"
    DIRICHLET = "dirichlet"


class Balance(Choice):
    """What is at 0 of a disk where no center and no pins are given."""

    MIDDLE = "middle"
    AREA = "area"


class PinMode(Choice):
    """How pins are reached."""

    MOEBIUS = "moebius"
    CONSTRAINT = "constraint"


class Repair(Choice):
    """What becomes of folded triangles."""

    AUTO = "auto"
    ALWAYS = "always"
    NEVER = "never"

    @property
    def pays(self) -> float:
        """Degrees of mean angle error that unfolding may cost."""
        return {Repair.AUTO: 0.5, Repair.ALWAYS: INFINITY, Repair.NEVER: 0.0}[self]

    @classmethod
    def _joint(cls) -> str:
        return ", "


class Laplacian(Choice):
    """Weights of the edges."""

    AUTO = "auto"
    COTAN = "cotan"
    INTRINSIC_DELAUNAY = "intrinsic-delaunay"

    @classmethod
    def _joint(cls) -> str:
        return ", "


class Backend(Choice):
    """Library of the linear solver."""

    AUTO = "auto"
    CHOLMOD = "cholmod"
    SUPERLU = "superlu"
    MULTIGRID = "multigrid"
    PETSC = "petsc"


class DistributedSolver(Choice):
    """What solves the linear systems of the backend "petsc"; by itself hypre where PETSc has it, else gamg."""

    AUTO = "auto"
    GAMG = "gamg"
    HYPRE = "hypre"
    MUMPS = "mumps"

    @classmethod
    def _joint(cls) -> str:
        return ", "


class Holes(Choice):
    """All boundary loops of a chart but one."""

    FILL = "fill"
    REFUSE = "refuse"


class Closed(Choice):
    """Charts that are closed or have handles."""

    REFUSE = "refuse"
    CUT = "cut"


class NonManifold(Choice):
    """Edges of three or more polygons, and vertices where parts only touch."""

    REFUSE = "refuse"
    CUT = "cut"


class Orientation(Choice):
    """Polygons wound against their neighbours."""

    REFUSE = "refuse"
    MEND = "mend"


class Place(Choice):
    """Where charts go: into the unit square, or each onto the unit disk."""

    FIT = "fit"
    PACK = "pack"
    DISK = "disk"

    @classmethod
    def _joint(cls) -> str:
        return ", "


class MarginMethod(Choice):
    """What a margin means: a distance between charts and to the sides of the square, as a part of its side; or, as in
    Blender, one kept around every chart, so that two keep twice as much: a fraction of the side, pixels of an image,
    a length in the charts' units, or that as many times as a tenth of the sum of their boxes' mean sides."""

    BETWEEN = "between"
    FRACTION = "fraction"
    PIXELS = "pixels"
    ADD = "add"
    SCALED = "scaled"


class PackRotation(Choice):
    """How charts may be turned to be packed: not at all, by quarters, to lie along the axes, or by any angle."""

    NONE = "none"
    QUARTERS = "quarters"
    AXES = "axes"
    ANY = "any"


class PackShape(Choice):
    """What is packed of a chart: its outline, the convex hull, or the box around it."""

    OUTLINE = "outline"
    CONVEX = "convex"
    BOX = "box"


class CornerChoice(Choice):
    """Which boundary vertices become the corners of a rectangle."""

    TURNING = "turning"
    AREA = "area"


class Shape(Choice):
    """What a chart becomes."""

    DISK = "disk"
    FREE = "free"
    RECTANGLE = "rectangle"

    @classmethod
    def _joint(cls) -> str:
        return ", "


class MapKind(Choice):
    """What a batch makes of its surfaces: the shapes of charts, or the sphere."""

    DISK = "disk"
    FREE = "free"
    RECTANGLE = "rectangle"
    SPHERE = "sphere"

    @classmethod
    def _joint(cls) -> str:
        return ", "


class Upright(Choice):
    """The surface's axis that points up in the texture."""

    Z = "z"
    Y = "y"
    NONE = "none"

    @classmethod
    def _joint(cls) -> str:
        return ", "


class SphereBoundary(Choice):
    """Boundary loops of a surface that goes onto the sphere."""

    REFUSE = "refuse"
    CAP = "cap"


class Normalization(Choice):
    """What the last Moebius map brings to the middle of the ball."""

    AREA = "area"
    CENTER = "center"
    NONE = "none"

    @classmethod
    def _missing_(cls, value: object) -> Normalization | None:
        return cls.CENTER if value == "centre" else None  # its name in the first version


class Rotation(Choice):
    """How the sphere is turned in the end."""

    PRINCIPAL = "principal"
    SURFACE = "surface"
    NONE = "none"


class SphereLayout(Choice):
    """Texture coordinates of a sphere."""

    NONE = "none"
    EQUIRECTANGULAR = "equirectangular"
    OCTAHEDRAL = "octahedral"


def real_number(name: str, value: object, what: str = "a number") -> float:
    """The value as a finite float.

    Raises
    ------
    OptionError
        It is none.
    """
    try:
        if isinstance(value, str | bytes) or type(value).__name__ in {"bool", "bool_"}:
            raise TypeError
        number = float(value)  # type: ignore[arg-type]
        if number - number != 0.0:
            raise ValueError
    except (TypeError, ValueError, OverflowError) as error:
        raise OptionError(f"{name} is {value!r}; pass {what}.") from error
    return number


def vertex_index(name: str, value: object) -> int:
    """The value as an int.

    Raises
    ------
    OptionError
        It is no whole number.
    """
    try:
        return index(value)  # type: ignore[arg-type]
    except TypeError as error:
        raise OptionError(f"{name} is {value!r}; pass a vertex index.") from error


@dataclass(frozen=True, kw_only=True)
class Limits:
    """When an iteration ends."""

    tolerance: float
    relative_tolerance: float = 0.0
    max_iterations: int = 50

    def _check_limits(self) -> None:
        given = self.tolerance, self.relative_tolerance, self.max_iterations
        try:
            if any(isinstance(value, str | bytes) or type(value).__name__ in {"bool", "bool_"} for value in given):
                raise TypeError
            norm, part, most = float(self.tolerance), float(self.relative_tolerance), index(self.max_iterations)
        except (TypeError, ValueError) as error:
            raise OptionError(
                f"tolerance is {self.tolerance!r}, relative_tolerance {self.relative_tolerance!r}, max_iterations "
                f"{self.max_iterations!r}; pass numbers."
            ) from error
        if not 0.0 < norm < INFINITY or most < 0:
            raise OptionError(f"tolerance must be positive and max_iterations not negative; got {norm} and {most}.")
        if not 0.0 <= part < 1.0:
            raise OptionError(f"relative_tolerance must be at least 0 and less than 1; got {part}.")
        _set(self, tolerance=norm, relative_tolerance=part, max_iterations=most)


@dataclass(frozen=True, kw_only=True)
class DiskOptions(Limits):
    """What to solve on a disk and how to place it; see `disk_map`.

    Vertices are those of the mesh; `disk.anchors.anchored` checks them against a surface.
    """

    method: Method = Method.AUTO
    objective: Objective | None = None
    pins: tuple[int, int, int] | None = None
    pin_mode: PinMode | None = None
    center: int | None = None
    boundary_vertex: int | None = None
    balance: Balance = Balance.MIDDLE
    tolerance: float = 1e-10
    repair: Repair = Repair.AUTO

    def __post_init__(self) -> None:
        method = Method.of("method", self.method)
        report = method is Method.AUGMENTED_LAGRANGIAN
        if method is Method.AUTO and (self.objective == "dirichlet" or self.pin_mode == "constraint"):
            method = Method.NEWTON  # a problem of optimisation is stated; nothing else solves it
        objective, pin_mode = self.objective, self.pin_mode
        if objective is None:
            objective = Objective.DIRICHLET if report else Objective.CONFORMAL
        if pin_mode is None:
            pin_mode = PinMode.CONSTRAINT if report else PinMode.MOEBIUS
        _set(
            self,
            method=method,
            objective=Objective.of("objective", objective),
            pin_mode=PinMode.of("pin_mode", pin_mode),
            balance=Balance.of("balance", self.balance),
            repair=Repair.of("repair", self.repair),
        )
        if report and self.pin_mode is not PinMode.CONSTRAINT:
            raise OptionError("The augmented Lagrangian takes its pins as constraints; leave pin_mode out.")
        if method is Method.LINEAR and self.pin_mode is PinMode.CONSTRAINT:
            raise OptionError('The linear method does not optimise; it takes pins only with pin_mode="moebius".')
        self._check_limits()
        if self.pins is not None:
            _set(self, pins=_vertices("pins", self.pins, 3, "three"))
        if self.needs_pins and (self.center is not None or self.boundary_vertex is not None):
            raise OptionError("Three pins already fix the map; leave out center and boundary_vertex.")
        if self.balance is Balance.AREA and (self.needs_pins or self.center is not None):
            raise OptionError('balance="area" says what is in the middle, as center and pins do; leave one out.')
        for name in ("center", "boundary_vertex"):
            if getattr(self, name) is not None:
                _set(self, **{name: vertex_index(name, getattr(self, name))})

    @property
    def needs_pins(self) -> bool:
        """Whether there are pins, given or by default."""
        return self.pins is not None or self.pin_mode is PinMode.CONSTRAINT

    @property
    def constrained_pins(self) -> tuple[int, int, int] | None:
        """Pins that are constraints of the optimisation."""
        return self.pins if self.pin_mode is PinMode.CONSTRAINT else None

    @property
    def solution_key(self) -> tuple[object, ...]:
        """What the solution depends on before it is placed."""
        limits = self.tolerance, self.relative_tolerance, self.max_iterations
        return self.method, self.objective, *limits, self.constrained_pins


@dataclass(frozen=True, kw_only=True, eq=False)
class SplitOptions:
    """What to do with a mesh that does not fall into disks by itself; see `unwrap`.

    `outer_loop` (v,) are vertices on loops that become circles.
    """

    holes: Holes = Holes.FILL
    closed: Closed = Closed.REFUSE
    nonmanifold: NonManifold = NonManifold.REFUSE
    orientation: Orientation = Orientation.REFUSE
    outer_loop: NDArray[np.int64] | None = None

    def __post_init__(self) -> None:
        _set(
            self,
            holes=Holes.of("holes", self.holes),
            closed=Closed.of("closed", self.closed),
            nonmanifold=NonManifold.of("nonmanifold", self.nonmanifold),
            orientation=Orientation.of("orientation", self.orientation),
        )


@dataclass(frozen=True, kw_only=True)
class PlaceOptions:
    """Where charts go in the texture; see `unwrap`."""

    place: Place = Place.FIT
    margin: float | None = None
    margin_method: MarginMethod = MarginMethod.BETWEEN
    image_size: int = 1024
    pack_rotation: PackRotation = PackRotation.NONE
    pack_shape: PackShape = PackShape.OUTLINE
    keep_scale: bool = False
    tile: int = FIRST_TILE
    rotation: float = 0.0

    def __post_init__(self) -> None:
        _set(
            self,
            place=Place.of("place", self.place),
            margin_method=MarginMethod.of("margin_method", self.margin_method),
            pack_rotation=PackRotation.of("pack_rotation", self.pack_rotation),
            pack_shape=PackShape.of("pack_shape", self.pack_shape),
            keep_scale=_flag("keep_scale", self.keep_scale),
            rotation=real_number("rotation", self.rotation, "radians"),
            image_size=_whole("image_size", self.image_size, 1, 1 << 20),
            tile=_whole("tile", self.tile, FIRST_TILE, 2000),
        )
        if self.margin is not None:
            _set(self, margin=real_number("margin", self.margin, "a part of the square's side"))
            self._check_margin()

    def _check_margin(self) -> None:
        margin, method = self.margin or 0.0, self.margin_method
        if method in {MarginMethod.ADD, MarginMethod.SCALED}:
            if margin < 0.0:
                raise OptionError(f"margin is {margin}; pass a length, at least 0.")
            return
        of_side = margin / self.image_size if method is MarginMethod.PIXELS else margin
        if not 0.0 <= of_side < 0.5:
            raise OptionError(f"margin is {margin}; pass a part of the unit square's side, at least 0 and below 0.5.")

    @property
    def corner(self) -> complex:
        """The lower left corner of the tile: ten of them in a row (UDIM)."""
        return complex((self.tile - FIRST_TILE) % TILES_IN_A_ROW, (self.tile - FIRST_TILE) // TILES_IN_A_ROW)


@dataclass(frozen=True, kw_only=True)
class SphereOptions(Limits):
    """What to solve on the sphere and how to place it; see `sphere_map`."""

    method: SphereMethod = SphereMethod.AUTO
    normalization: Normalization = Normalization.AREA
    rotation: Rotation = Rotation.PRINCIPAL
    landmarks: tuple[int, int, int] | None = None
    boundary: SphereBoundary = SphereBoundary.REFUSE
    tolerance: float = 1e-8
    laplacian: Laplacian = Laplacian.AUTO
    repair: Repair = Repair.AUTO

    def __post_init__(self) -> None:
        _set(
            self,
            method=SphereMethod.of("method", self.method),
            normalization=Normalization.of("normalization", self.normalization),
            rotation=Rotation.of("rotation", self.rotation),
            boundary=SphereBoundary.of("boundary", self.boundary),
            laplacian=Laplacian.of("laplacian", self.laplacian),
            repair=Repair.of("repair", self.repair),
        )
        self._check_limits()
        if self.landmarks is not None:
            try:
                a, b, c = (index(v) for v in self.landmarks)
            except (TypeError, ValueError) as error:
                raise OptionError(f"landmarks is {self.landmarks!r}; pass three vertex indices.") from error
            _set(self, landmarks=(a, b, c))


@dataclass(frozen=True, kw_only=True, eq=False)
class FreeOptions:
    """What the boundary of a flat surface is to be like; see `free_map`.

    `boundary_scale` and `boundary_angles` (nb,) follow the boundary loop; how many there are to be is checked where the
    surface is at hand.
    """

    boundary_scale: NDArray[np.float64] | None = None
    boundary_angles: NDArray[np.float64] | None = None
    refine: bool = False
    repair: Repair = Repair.AUTO

    def __post_init__(self) -> None:
        _set(self, repair=Repair.of("repair", self.repair), refine=_flag("refine", self.refine))
        for name in ("boundary_scale", "boundary_angles"):
            if getattr(self, name) is not None:
                _set(self, **{name: _real_numbers(name, getattr(self, name))})
        scale, angles = self.boundary_scale, self.boundary_angles
        if scale is not None and angles is not None:
            raise OptionError("boundary_scale and boundary_angles determine each other; pass one of them.")
        if self.refine and (scale is not None or angles is not None):
            raise OptionError("refine moves the boundary; leave out boundary_scale and boundary_angles, or refine.")
        if scale is not None and len(scale) and np.abs(scale).max() > MOST_SCALE:
            raise OptionError(f"boundary_scale goes up to {np.abs(scale).max():g}; pass logarithms of scale factors.")
        if angles is not None:
            if abs(angles.sum() - FULL_TURN) > TURN_ROUNDING:
                raise OptionError(f"boundary_angles sum to {angles.sum():.9g}; a closed boundary turns by 2 pi.")
            _set(self, boundary_angles=angles + (FULL_TURN - angles.sum()) / len(angles))


@dataclass(frozen=True, kw_only=True)
class RectangleOptions:
    """Which vertices become the corners of a rectangle; see `rectangle_map`.

    Vertices are those of the mesh; `rectangle.corners.given_corners` checks them against a surface.
    """

    corners: tuple[int, int, int, int] | None = None
    corner_choice: CornerChoice = CornerChoice.TURNING
    repair: Repair = Repair.AUTO

    def __post_init__(self) -> None:
        _set(
            self,
            corner_choice=CornerChoice.of("corner_choice", self.corner_choice),
            repair=Repair.of("repair", self.repair),
        )
        if self.corners is not None:
            _set(self, corners=_vertices("corners", self.corners, 4, "four"))
            if self.compares:
                raise OptionError('corners are given, so corner_choice="area" chooses nothing; leave out one of them.')

    @property
    def compares(self) -> bool:
        """Whether several maps are made, to take the best."""
        return self.corner_choice is CornerChoice.AREA


@dataclass(frozen=True, kw_only=True)
class ShapeOptions:
    """What charts become and how they are turned; see `unwrap`.

    `shape` is that of all charts, or one for each.
    """

    shape: Shape | tuple[Shape, ...] = Shape.DISK
    upright: Upright = Upright.Z
    refine: bool = False
    corner_choice: CornerChoice = CornerChoice.TURNING

    def __post_init__(self) -> None:
        shape: Any = self.shape
        if isinstance(shape, str) or not isinstance(shape, Sequence):
            shape = Shape.of("shape", shape)
        else:
            shape = tuple(Shape.of("shape", one) for one in shape)
        _set(
            self,
            shape=shape,
            upright=Upright.of("upright", self.upright),
            refine=_flag("refine", self.refine),
            corner_choice=CornerChoice.of("corner_choice", self.corner_choice),
        )

    def of_charts(self, count: int) -> list[Shape]:
        """The shape of each of so many charts.

        Raises
        ------
        OptionError
            There are not as many as charts.
        """
        if isinstance(self.shape, Shape):
            return [self.shape] * count
        if len(self.shape) != count:
            raise OptionError(f"{len(self.shape)} shapes for {count} charts; pass one for all, or one for each.")
        return list(self.shape)


@dataclass(frozen=True, kw_only=True, eq=False)
class ChartOptions:
    """What becomes of charts: all that `unwrap` takes but how they are split and where they go."""

    shape: ShapeOptions
    disk: DiskOptions
    rotation: float = 0.0

    @property
    def free(self) -> FreeOptions:
        """Of charts with a free boundary."""
        return FreeOptions(refine=self.shape.refine, repair=self.disk.repair)

    @property
    def rectangle(self) -> RectangleOptions:
        """Of charts that become rectangles."""
        return RectangleOptions(corner_choice=self.shape.corner_choice, repair=self.disk.repair)


def _whole(name: str, value: object, least: int, most: int) -> int:
    number = vertex_index(name, value) if not isinstance(value, bool) else least - 1
    if not least <= number <= most:
        raise OptionError(f"{name} is {value!r}; pass a whole number from {least} to {most}.")
    return number


def _flag(name: str, value: object) -> bool:
    if not isinstance(value, bool | np.bool_):
        raise OptionError(f"{name} is {value!r}; pass True or False.")
    return bool(value)


def _real_numbers(name: str, values: object) -> NDArray[np.float64]:
    """The values as a row of finite numbers of their own."""
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "iuf" or given.ndim != 1:
            raise TypeError(f"dtype {given.dtype}, shape {given.shape}")
        numbers = given.astype(np.float64)
    except (TypeError, ValueError) as error:
        raise OptionError(f"{name} is no row of numbers ({error}); pass one for each boundary vertex.") from error
    bad = np.flatnonzero(~np.isfinite(numbers))
    if len(bad):
        raise OptionError(f"{name} is NaN or infinite at places {listed(bad)}; pass finite numbers.", bad)
    return numbers


def _vertices(name: str, values: Sequence[int], count: int, word: str) -> tuple[int, ...]:
    try:
        found = list(values)
    except TypeError as error:
        raise OptionError(f"{name} is {values!r}; pass {word} boundary vertices.") from error
    if len(found) != count:
        raise OptionError(f"{len(found)} {name}; pass {word} boundary vertices.")
    return tuple(vertex_index(name, value) for value in found)


def _set(options: Any, **values: Any) -> None:
    """Give fields of a frozen object their checked values, while it is made."""
    for name, value in values.items():
        object.__setattr__(options, name, value)

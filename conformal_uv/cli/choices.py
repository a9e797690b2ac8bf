"""Values of the options that choose among names."""

from __future__ import annotations

from enum import StrEnum

__all__ = [
    "Backend",
    "Closed",
    "Holes",
    "Laplacian",
    "Method",
    "NonManifold",
    "Normalization",
    "Objective",
    "Orientation",
    "PinMode",
    "Place",
    "Repair",
    "Rotation",
    "SphereBoundary",
    "SphereLayout",
    "SphereMethod",
]


class Method(StrEnum):
    """--method"""

    NEWTON = "newton"
    LINEAR = "linear"
    AUGMENTED_LAGRANGIAN = "augmented-lagrangian"


class Objective(StrEnum):
    """--objective"""

    CONFORMAL = "conformal"
    DIRICHLET = "dirichlet"


class PinMode(StrEnum):
    """--pin-mode"""

    MOEBIUS = "moebius"
    CONSTRAINT = "constraint"


class Backend(StrEnum):
    """--backend"""

    AUTO = "auto"
    CHOLMOD = "cholmod"
    SUPERLU = "superlu"
    MULTIGRID = "multigrid"


class Laplacian(StrEnum):
    """--laplacian"""

    AUTO = "auto"
    COTAN = "cotan"
    INTRINSIC_DELAUNAY = "intrinsic-delaunay"


class Repair(StrEnum):
    """--repair"""

    AUTO = "auto"
    NEVER = "never"


class Holes(StrEnum):
    """--holes"""

    FILL = "fill"
    REFUSE = "refuse"


class Closed(StrEnum):
    """--closed"""

    REFUSE = "refuse"
    CUT = "cut"


class NonManifold(StrEnum):
    """--nonmanifold"""

    REFUSE = "refuse"
    CUT = "cut"


class Orientation(StrEnum):
    """--orientation"""

    REFUSE = "refuse"
    MEND = "mend"


class Place(StrEnum):
    """--place"""

    FIT = "fit"
    PACK = "pack"


class SphereMethod(StrEnum):
    """--method of the sphere"""

    NEWTON = "newton"
    LINEAR = "linear"
    AUGMENTED_LAGRANGIAN = "augmented-lagrangian"


class SphereBoundary(StrEnum):
    """--boundary"""

    REFUSE = "refuse"
    CAP = "cap"


class Normalization(StrEnum):
    """--normalization"""

    AREA = "area"
    CENTRE = "centre"
    NONE = "none"


class Rotation(StrEnum):
    """--rotation"""

    PRINCIPAL = "principal"
    SURFACE = "surface"
    NONE = "none"


class SphereLayout(StrEnum):
    """--uv"""

    NONE = "none"
    EQUIRECTANGULAR = "equirectangular"
    OCTAHEDRAL = "octahedral"

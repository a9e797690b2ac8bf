"""Who takes part: a name, the module that runs it, and what it needs.

Each module has ``run(arrays, stage, **options) -> Outcome``. Only the measured process imports it, so that no program
pays for the imports of another, and a missing one is told by name.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

__all__ = ["CONTESTANTS", "READERS", "Contestant", "named"]

Options = dict[str, object]
METHODS = ("linear", "newton")
READERS = ("trimesh", "meshio", "pymeshlab", "libigl")
MILLION, ANY = 10**6, 10**9


@dataclass(frozen=True)
class Contestant:
    """One line of the tables.

    Attributes
    ----------
    name : str
    module : str
        Within this package.
    options : dict
        Keyword arguments of its `run`.
    group : {"ours", "again", "limit", "peer"}
    target : {"circle", "free", "sphere", "none"}
        Where the boundary goes; the maps of "none" are not looked at, or there are none.
    kinds : tuple of str
        Families that it takes (`families.Family.kind`).
    largest : int
        Size of the largest mesh that it takes.
    input : {"mesh", "matrix", "obj", "ply"}
        The file that it is given.
    needs : str
        What to install.
    blender : bool
        Runs in Blender's Python.
    """

    name: str
    module: str
    options: Options = field(default_factory=dict)
    group: str = "peer"
    target: str = "circle"
    kinds: tuple[str, ...] = ("disk",)
    largest: int = ANY
    input: str = "mesh"
    needs: str = ""
    blender: bool = False


def _disks() -> list[Contestant]:
    found = []
    for backend, kinds, largest in (("cholmod", ("disk", "fan"), ANY), ("superlu", ("disk",), MILLION)):
        for method in METHODS:
            options: Options = {"method": method, "backend": backend}
            found.append(Contestant(f"{method}-{backend}", "disk", options, "ours", kinds=kinds, largest=largest))
    limit = partial(Contestant, group="limit", target="none", input="matrix")
    for backend, largest in (("cholmod", ANY), ("superlu", MILLION)):
        for ordered, name in ((False, f"limit-{backend}"), (True, f"limit-{backend}-ordered")):
            found.append(limit(name, f"limit_{backend}", {"ordered": ordered}, largest=largest))
    for method in METHODS:
        options = {"method": method, "backend": "cholmod"}
        found.append(Contestant(f"again-{method}", "again", options, "again", largest=MILLION))
    return found


def _peers() -> list[Contestant]:
    libigl = partial(Contestant, module="libigl", needs="libigl")
    meshlab = partial(Contestant, module="meshlab", needs="pymeshlab")
    return [
        meshlab("filter", options={"method": "conformal disk"}, group="ours", largest=MILLION),
        libigl("libigl-harmonic", options={"method": "harmonic"}, largest=MILLION),
        libigl("libigl-lscm", options={"method": "lscm"}, target="free", largest=100_000),
        meshlab("meshlab-harmonic", options={"method": "harmonic"}, largest=MILLION),
        meshlab("meshlab-lscm", options={"method": "lscm"}, target="free", largest=100_000),
    ]


def _blender() -> list[Contestant]:
    bpy = partial(Contestant, module="blender", largest=200_000, kinds=("disk", "atlas"), needs="bpy", blender=True)
    ours = [
        bpy(f"blender-ours-{method}", options={"method": method.upper(), "ours": True}, group="ours")
        for method in (*METHODS, "auto")
    ]
    ours.append(bpy("blender-ours-free", options={"shape": "FREE", "ours": True}, group="ours", target="free"))
    names = {"conformal": "CONFORMAL", "angle": "ANGLE_BASED"}
    return ours + [bpy(f"blender-{name}", options={"method": names[name]}, target="free") for name in names]


def _atlases() -> list[Contestant]:
    atlas = partial(Contestant, module="atlas", group="ours", target="none", kinds=("atlas", "triangles"))
    found = [atlas(f"atlas-{method}", options={"method": method}) for method in ("linear", "auto")]
    found.append(atlas("atlas-free", options={"shape": "free"}))
    options: Options = {"method": "linear", "backend": "auto", "prefix": "disk_"}
    return [*found, Contestant("one-disk", "disk", options, "limit", "none", ("atlas", "fan"))]


def _files() -> list[Contestant]:
    files = partial(Contestant, target="none", kinds=("files",))
    found = [files("command", "command", group="ours", input="obj")]
    for format in ("obj", "ply"):
        reading = partial(files, module="reading", input=format)
        found.append(reading(f"read-{format}", options={"program": "ours"}, group="ours"))
        for peer in READERS:
            found.append(reading(f"{peer}-read-{format}", options={"program": peer}, needs=peer))
    return found


def _spheres() -> list[Contestant]:
    sphere = partial(Contestant, target="sphere", kinds=("closed",))
    ours = [sphere(f"sphere-{method}", "sphere", {"method": method}, "ours") for method in METHODS]
    return [*ours, sphere("lapy", "lapy_sphere", needs="lapy")]


_PARTS = (_disks, _peers, _blender, _atlases, _files, _spheres)
CONTESTANTS = {contestant.name: contestant for part in _PARTS for contestant in part()}


def named(names: list[str]) -> list[Contestant]:
    """Contestants by name or by group.

    Raises
    ------
    KeyError
        A name that there is not.
    """
    chosen = []
    for contestant in CONTESTANTS.values():
        if not names or contestant.name in names or contestant.group in names:
            chosen.append(contestant)
    unknown = set(names) - set(CONTESTANTS) - {contestant.group for contestant in CONTESTANTS.values()}
    if unknown:
        raise KeyError(f"{', '.join(sorted(unknown))}: choose of {', '.join(CONTESTANTS)}")
    return chosen

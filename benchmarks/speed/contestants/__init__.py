"""Who takes part: a name, the module that runs it, and what it needs.

Each module has ``run(arrays, stage, **options) -> Outcome``. Only the measured process imports it, so that no program
pays for the imports of another, and a missing one is told by name.
"""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ["CONTESTANTS", "Contestant", "named"]


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
        Where the boundary goes; "sphere" is for closed meshes, "none" makes no map.
    needs : str
        What to install.
    blender : bool
        Runs in Blender's Python.
    """

    name: str
    module: str
    options: dict[str, object] = field(default_factory=dict)
    group: str = "peer"
    target: str = "circle"
    needs: str = ""
    blender: bool = False

    @property
    def closed(self) -> bool:
        """Whether it maps closed meshes."""
        return self.target == "sphere"


def _all() -> list[Contestant]:
    found = []
    for backend in ("cholmod", "superlu"):
        for method in ("linear", "newton"):
            options: dict[str, object] = {"method": method, "backend": backend}
            found.append(Contestant(f"{method}-{backend}", "disk", options, "ours"))
    for backend in ("cholmod", "superlu"):
        found.append(Contestant(f"limit-{backend}", f"limit_{backend}", {"ordered": False}, "limit", "none"))
        found.append(Contestant(f"limit-{backend}-ordered", f"limit_{backend}", {"ordered": True}, "limit", "none"))
    for method in ("linear", "newton"):
        found.append(Contestant(f"again-{method}", "again", {"method": method, "backend": "cholmod"}, "again"))
    found += [
        Contestant("filter", "meshlab", {"method": "conformal disk"}, "ours", needs="pymeshlab"),
        Contestant("libigl-harmonic", "libigl", {"method": "harmonic"}, needs="libigl"),
        Contestant("libigl-lscm", "libigl", {"method": "lscm"}, target="free", needs="libigl"),
        Contestant("meshlab-harmonic", "meshlab", {"method": "harmonic"}, needs="pymeshlab"),
        Contestant("meshlab-lscm", "meshlab", {"method": "lscm"}, target="free", needs="pymeshlab"),
        Contestant("blender-conformal", "blender", {"method": "CONFORMAL"}, target="free", needs="bpy", blender=True),
        Contestant("blender-angle", "blender", {"method": "ANGLE_BASED"}, target="free", needs="bpy", blender=True),
        Contestant("bff", "bff", target="free", needs="confmap from github.com/russelmann/confmap"),
        Contestant("sphere-linear", "sphere", {"method": "linear"}, "ours", "sphere"),
        Contestant("sphere-newton", "sphere", {"method": "newton"}, "ours", "sphere"),
        Contestant("lapy", "lapy_sphere", target="sphere", needs="lapy"),
    ]
    return found


CONTESTANTS = {contestant.name: contestant for contestant in _all()}


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

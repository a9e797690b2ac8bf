"""Which zips of the extension there are, and the wheels of others that each brings.

One for each platform and each Python of Blender: an extension that brings wheels for several is several times as large.
numpy is Blender's own everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["BUILDS", "DISTRIBUTION", "PLATFORMS", "PYTHONS", "Build"]

PLATFORMS = {  # Blender's name: pip's
    "linux-x64": ("manylinux_2_28_x86_64", "manylinux_2_17_x86_64"),
    "linux-arm64": ("manylinux_2_28_aarch64", "manylinux_2_17_aarch64"),
    "windows-x64": ("win_amd64",),
    "windows-arm64": ("win_arm64",),
    "macos-arm64": ("macosx_12_0_arm64",),
    "macos-x64": ("macosx_10_14_x86_64",),
}
PYTHONS = {  # the first Blender that has it, and the first that has it no more
    "cp311": ("4.2.0", "5.1.0"),
    "cp313": ("5.1.0", ""),
}
WHEELS = {
    # 1.15: the last that is quiet on the numpy 1.24 of Blender 4.2.
    "scipy": {"cp311": "1.15.3", "cp313": "1.18.1"},
    "cvxopt": {"cp311": "1.3.3", "cp313": "1.3.3"},
    "mapbox-earcut": {"cp311": "2.1.0", "cp313": "2.1.0"},
}
ELSE = {  # where there is another version, or none, on the oldest system that Blender runs on
    ("scipy", "cp311", "windows-arm64"): "",
    ("scipy", "cp313", "macos-x64"): "1.17.1",
    ("cvxopt", "cp311", "windows-arm64"): "",
    ("cvxopt", "cp313", "windows-arm64"): "",
    ("cvxopt", "cp311", "macos-arm64"): "1.3.2",
    ("cvxopt", "cp313", "macos-arm64"): "",
    ("cvxopt", "cp311", "macos-x64"): "1.3.2",
    ("cvxopt", "cp313", "macos-x64"): "",
}


@dataclass(frozen=True)
class Build:
    """One zip.

    Parameters
    ----------
    platform : str
        Blender's name of it; empty: any.
    python : str
        Tag of the wheels, such as "cp311"; empty: any.
    """

    platform: str
    python: str

    @property
    def blender(self) -> tuple[str, str]:
        """The first Blender that takes it, and the first that does not any more or empty."""
        return PYTHONS[self.python] if self.python else ("4.2.0", "")

    @property
    def requirements(self) -> list[str]:
        """Wheels to bring, as pip names them."""
        if not self.python:
            return []
        found = {name: ELSE.get((name, self.python, self.platform), of[self.python]) for name, of in WHEELS.items()}
        return [f"{name}=={version}" for name, version in found.items() if version]

    def version(self, version: str) -> str:
        """The extension's version: what is not self-contained has a suffix, as a version of its own."""
        return version if self.python else f"{version}+distribution"

    def filename(self, version: str) -> str:
        """Name of the zip, which tells who it is for."""
        if not self.python:
            return f"conformal_uv-{version}-distribution.zip"
        first, end = (number.rpartition(".")[0] for number in self.blender)
        blenders = f"blender{first}" + (f"_before{end}" if end else "")
        return f"conformal_uv-{version}-{blenders}-{self.platform.replace('-', '_')}.zip"


DISTRIBUTION = Build("", "")
BUILDS = [  # without scipy nothing runs
    build
    for python in PYTHONS
    for build in (Build(platform, python) for platform in PLATFORMS)
    if any(line.startswith("scipy==") for line in build.requirements)
]

"""In tests of an installed extension `blender_addon` and `conformal_uv` name what is installed, and nothing else.

The repository's own, or what pip installed, would be other modules with classes of their own: patching and comparing
would miss what the extension runs.
"""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.machinery import ModuleSpec


class InstalledNames:
    """Finds modules under their names in the repository.

    Parameters
    ----------
    extension : str
        Its module, such as "bl_ext.user_default.conformal_uv".
    """

    def __init__(self, extension: str) -> None:
        self.homes = {"blender_addon": extension, "conformal_uv": f"{extension}.conformal_uv"}

    def install(self) -> None:
        """Come before all other finders."""
        sys.meta_path.insert(0, self)

    def find_spec(self, name, path=None, target=None):
        top = name.partition(".")[0]
        return ModuleSpec(name, self) if top in self.homes else None

    def create_module(self, spec):
        top, dot, rest = spec.name.partition(".")
        module = import_module(self.homes[top] + dot + rest)
        spec.loader_state = module.__spec__
        return module

    def exec_module(self, module):
        module.__spec__ = module.__spec__.loader_state  # it keeps its own name

"""Imports of the core, as the add-on has them in a checkout, made relative, as they must be inside an extension.

In a checkout `blender_addon` and `conformal_uv` lie side by side; in the extension `conformal_uv` is a subpackage of
the add-on. Only statements `from conformal_uv... import ...` are changed. Whatever else names a package of ours
absolutely is refused, for it would find another copy, or none.
"""

from __future__ import annotations

import ast
import re
from pathlib import PurePosixPath

from .errors import ReleaseError

__all__ = ["absolute_imports", "with_relative_imports"]

CORE = "conformal_uv"
OURS = (CORE, "blender_addon", "meshlab_filter")
BY_NAME = ("import_module", "find_spec", "__import__", "getLogger")


def with_relative_imports(text: str, path: str) -> str:
    """The text of a file of the add-on with its imports of the core made relative.

    Parameters
    ----------
    text : str
        Python.
    path : str
        Within the extension, such as "worker.py".

    Raises
    ------
    ReleaseError
        If a package of ours is named absolutely in another way.
    """
    dots = "." * len(PurePosixPath(path).parts)
    lines = text.splitlines(keepends=True)
    for node in ast.walk(ast.parse(text, path)):
        if isinstance(node, ast.ImportFrom) and node.level == 0 and _top(node.module) == CORE:
            line = lines[node.lineno - 1]
            lines[node.lineno - 1] = re.sub(rf"\bfrom(\s+){CORE}\b", rf"from\g<1>{dots}{CORE}", line, count=1)
    changed = "".join(lines)
    for number, found in absolute_imports(changed, path):
        raise ReleaseError(
            f"{path}, line {number}: `{found}` would not find what the extension carries; "
            f"write `from {CORE}... import ...` for the core, and relative imports for the add-on's own files"
        )
    return changed


def absolute_imports(text: str, path: str) -> list[tuple[int, str]]:
    """Line and text of whatever names a package of ours absolutely, to import or look it up."""
    found = []
    for node in ast.walk(ast.parse(text, path)):
        if isinstance(node, ast.ImportFrom):
            named = [node.module] if node.level == 0 else []
        elif isinstance(node, ast.Import):
            named = [alias.name for alias in node.names]
        elif isinstance(node, ast.Call) and _name(node.func) in BY_NAME:
            named = [arg.value for arg in node.args if isinstance(arg, ast.Constant) and isinstance(arg.value, str)]
        else:
            continue
        if any(_top(name) in OURS for name in named):
            found.append((node.lineno, ast.unparse(node)))
    return sorted(found)


def _top(name: str | None) -> str:
    return (name or "").partition(".")[0]


def _name(function: ast.expr) -> str:
    return getattr(function, "attr", None) or getattr(function, "id", "")

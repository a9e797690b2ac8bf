"""Start of the conformal-uv command."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable

from ..console.interrupt import quiet_interrupt

__all__ = ["main"]


def main() -> None:
    """Run the command; say what to install when its libraries are missing."""
    with quiet_interrupt():
        app = _loaded()
    app()


def _loaded() -> Callable[[], None]:
    missing = [name for name in ("typer", "rich") if importlib.util.find_spec(name) is None]
    if missing:
        sys.stderr.write(f'conformal-uv: {" and ".join(missing)} not installed; run: pip install "conformal-uv[cli]"\n')
        raise SystemExit(1)
    from .app import app

    return app

"""Start of the conformal-uv-meshlab script."""

from __future__ import annotations

import importlib.util
import logging
import sys
from collections.abc import Callable

from conformal_uv.console.interrupt import quiet_interrupt

__all__ = ["main"]


def main() -> None:
    """Run the script; say what to install when its libraries are missing."""
    with quiet_interrupt():
        app = _loaded()
    app(prog_name="conformal-uv-meshlab")


def _loaded() -> Callable[..., None]:
    missing = [name for name in ("pymeshlab", "typer", "rich") if importlib.util.find_spec(name) is None]
    if missing:
        sys.stderr.write(
            f'conformal-uv-meshlab: {" and ".join(missing)} not installed; run: pip install "conformal-uv[meshlab]"\n'
        )
        raise SystemExit(1)
    from conformal_uv import ConformalUVError

    try:
        from .command import app
    except ConformalUVError as error:
        sys.stderr.write(f"conformal-uv-meshlab: {error}\n")
        raise SystemExit(1) from error
    logging.getLogger(__package__).addHandler(logging.NullHandler())  # the script tells all that is logged
    return app

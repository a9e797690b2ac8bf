"""The commands, and what they share: version, errors in one line, exit codes 0, 1 and 2."""

from __future__ import annotations

import functools
import os
from collections.abc import Callable
from typing import Annotated, ParamSpec

import typer

from .._version import __version__
from ..console.interrupt import interruptible
from ..console.terminal import plain
from ..errors import ConformalUVError, Remedy
from .batch import batch
from .disk import disk
from .free import free
from .rectangle import rectangle
from .report import report
from .sample import sample
from .sphere import sphere
from .view import view

__all__ = ["app"]

P = ParamSpec("P")
CLOSED_PIPE = 141  # what a shell says of a command that SIGPIPE ended

app = typer.Typer(
    name="conformal-uv",
    help="Flatten surfaces, or map them to the unit sphere, with their angles kept.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)


def _told(command: Callable[P, None]) -> Callable[P, None]:
    """Turn an error of ours into one line on stderr and exit code 1."""

    @functools.wraps(command)
    def run(*args: P.args, **kwargs: P.kwargs) -> None:
        try:
            command(*args, **kwargs)
        except ConformalUVError as error:
            message = " ".join(error.told(Remedy.as_flag).split())
            typer.echo(plain(f"{type(error).__name__}: {message}"), err=True)
            raise typer.Exit(1) from error
        except BrokenPipeError:  # whoever read standard output has had enough
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            raise typer.Exit(CLOSED_PIPE) from None
        except OSError as error:
            typer.echo(plain(f"{type(error).__name__}: {error}"), err=True)
            raise typer.Exit(1) from error

    return run


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"conformal-uv {__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Flatten surfaces, or map them to the unit sphere, with their angles kept."""


for command in (disk, free, rectangle, sphere, batch, view, report, sample):
    app.command()(interruptible(_told(command)))

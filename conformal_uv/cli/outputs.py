"""The files that a command writes: refused before any work where they can not be, each written for itself."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..console.stages import Stages
from ..errors import ConformalUVError
from ..files import check_distinct, check_place, check_writable, is_standard_output, replaced_file
from ..pictures.figure import check_drawable

__all__ = ["Outputs"]


@dataclass(frozen=True)
class Outputs:
    """Where a command's mesh, numbers, picture and page go; None for what is not asked for.

    Parameters
    ----------
    source : Path, optional
        The input.
    format : str, optional
        Of the mesh where its path does not say it, as a suffix without its dot.
    """

    source: Path | None = None
    mesh: Path | None = None
    json: Path | None = None
    plot: Path | None = None
    html: Path | None = None
    format: str | None = None

    def check(self) -> None:
        """Refuse what could not be written in the end.

        Raises
        ------
        OptionError, FileFormatError, MissingDependencyError
        """
        check_distinct(self.source, {"OUT": self.mesh, "--json": self.json, "--plot": self.plot, "--html": self.html})
        if self.mesh is not None:
            check_writable(self.mesh, format=self.format)
        if self.json is not None:
            check_place(self.json)
        if self.plot is not None:
            check_drawable(self.plot)
            check_place(self.plot)
        if self.html is not None:
            check_place(self.html)

    @property
    def on_stdout(self) -> bool:
        """Whether one of them goes to standard output, where nothing else may go then."""
        return any(is_standard_output(path) for path in (self.mesh, self.json, self.plot, self.html))

    def write(
        self,
        stages: Stages,
        summary: dict[str, Any],
        write_mesh: Callable[[Path], None],
        draw: Callable[[Path], None],
        write_page: Callable[[Path], None] | None = None,
    ) -> None:
        """Write what is asked for; one that fails does not keep the others from their files.

        Raises
        ------
        ConformalUVError
            Of those that failed, one after the other.
        """
        wanted = [("write", self.mesh, write_mesh), ("plot", self.plot, draw), ("page", self.html, write_page)]
        wanted.append(("numbers", self.json, lambda _: self.write_numbers(summary)))
        failures: list[ConformalUVError | OSError] = []
        for stage, path, writer in wanted:
            if path is None or writer is None:
                continue
            stages(stage, 0.0)
            try:
                writer(path)
            except BrokenPipeError:
                raise
            except (ConformalUVError, OSError) as error:
                failures.append(error)
        if len(failures) == 1:
            raise failures[0]
        if failures:
            raise ConformalUVError("; ".join(map(str, failures)))

    def write_numbers(self, summary: dict[str, Any]) -> None:
        """The numbers as JSON, where they are asked for."""
        if self.json is not None:
            with replaced_file(self.json) as out:
                out.write((json.dumps(summary, indent=2) + "\n").encode())

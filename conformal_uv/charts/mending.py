"""What unwrap may do to a mesh that does not fall into disks by itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError, listed
from .arguments import vertex_list

__all__ = ["Mending"]

CHOICES = {
    "holes": ("fill", "refuse"),
    "closed": ("refuse", "cut"),
    "nonmanifold": ("refuse", "cut"),
    "orientation": ("refuse", "mend"),
}


@dataclass(frozen=True, eq=False)
class Mending:
    """Options of `unwrap`; `outer_loop` (v,) int64 are vertices on loops that become circles."""

    holes: str
    closed: str
    nonmanifold: str
    orientation: str
    outer_loop: NDArray[np.int64]

    @classmethod
    def checked(
        cls, used: NDArray[np.bool_], *, holes: str, closed: str, nonmanifold: str, orientation: str, outer_loop: Any
    ) -> Mending:
        """Check the options against the vertices in use (n,).

        Raises
        ------
        OptionError
            A value that is not taken.
        """
        given = {"holes": holes, "closed": closed, "nonmanifold": nonmanifold, "orientation": orientation}
        for name, value in given.items():
            if value not in CHOICES[name]:
                raise OptionError(f"{name} is {value!r}; choose {' or '.join(CHOICES[name])}.")
        return cls(holes, closed, nonmanifold, orientation, vertex_list("outer_loop", outer_loop, used))

    def check_outer_loop(self, allowed: NDArray[np.int64]) -> None:
        """Raise OptionError where a vertex of `outer_loop` is none of those allowed."""
        bad = self.outer_loop[~np.isin(self.outer_loop, allowed)]
        if len(bad):
            raise OptionError(f"outer_loop: vertices {listed(bad)} are on no boundary loop.", bad)

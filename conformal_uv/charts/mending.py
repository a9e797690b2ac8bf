"""What unwrap may do to a mesh that does not fall into disks by itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError, listed
from ..options import SplitOptions

__all__ = ["Mending"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Mending(SplitOptions):
    """The options of `unwrap`; `outer_loop` (v,) int64 are vertices on loops that become circles."""

    outer_loop: NDArray[np.int64]

    def check_outer_loop(self, allowed: NDArray[np.int64]) -> None:
        """Raise OptionError where a vertex of `outer_loop` is none of those allowed."""
        bad = self.outer_loop[~np.isin(self.outer_loop, allowed)]
        if len(bad):
            raise OptionError(f"outer_loop: vertices {listed(bad)} are on no boundary loop.", bad)

"""The order of links along closed loops, by pointer doubling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["loop_order"]

Ints = NDArray[np.int64]


def loop_order(following: Ints) -> tuple[Ints, Ints]:
    """Loops of a permutation.

    Parameters
    ----------
    following : (k,)
        The link after each link; a permutation.

    Returns
    -------
    loop : (k,) int64
        Number of the loop, in the order of the loops' lowest links.
    steps : (k,) int64
        Steps from each link to the lowest link of its loop.
    """
    here = np.arange(len(following))
    root, jump = here.copy(), following.copy()
    rounds = int(max(len(here) - 1, 0)).bit_length()
    for _ in range(rounds):
        root = np.minimum(root, root[jump])
        jump = jump[jump]
    is_root = root == here
    jump = np.where(is_root, here, following)
    steps = (~is_root).astype(np.int64)
    for _ in range(rounds):
        steps += steps[jump]
        jump = jump[jump]
    return (np.cumsum(is_root) - 1)[root], steps

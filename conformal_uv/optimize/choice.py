"""Which of several maps of a surface is the best."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["best_map"]

UNSEEN = 0.01  # degrees of mean angle error, which fewer folds are worth
ALIKE = 1e-7  # degrees, within which the first of the maps is taken, whatever rounding says


def best_map(
    angle_means: Sequence[float], folds: Sequence[int], unfinished: Sequence[bool], *, folds_first: bool
) -> int:
    """The place of the one with the least angle error; of those within what nobody sees, of that with fewest folds.

    Parameters
    ----------
    angle_means : degrees
    folds : counts of folded faces
    unfinished : whether the iteration ended before its tolerance; of maps alike in folds the others are taken
    folds_first : bool
        Whether fewer folds are worth any angle error.
    """
    every = range(len(angle_means))
    near = [k for k in every if folds_first or angle_means[k] <= min(angle_means) + UNSEEN]
    rank = min((folds[k], unfinished[k] and not folds_first) for k in near)
    best = [k for k in near if (folds[k], unfinished[k] and not folds_first) == rank]
    least = min(angle_means[k] for k in best)
    return next(k for k in best if angle_means[k] <= least + ALIKE)

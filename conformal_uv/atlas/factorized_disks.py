"""Many small disks whose Laplacians are the blocks of one matrix, factorized once for all shapes they are mapped to."""

from __future__ import annotations

from ..operators.dirichlet import DirichletProblem
from ..options import Laplacian
from ..progress import Progress
from .block_laplacian import Blocks, block_laplacian
from .disks import Disks

__all__ = ["FactorizedDisks"]


class FactorizedDisks:
    """What `operators.factorized_disk` is for one disk.

    Parameters
    ----------
    disks : Disks
    laplacian : Laplacian
    backend : str
    progress : Progress

    Attributes
    ----------
    disks : Disks
    blocks : Blocks
    problem : DirichletProblem
        Of all boundaries.
    backend : str
        The one asked for.

    Raises
    ------
    SolverError
        A block is singular to working precision.
    """

    def __init__(self, disks: Disks, laplacian: Laplacian, backend: str, progress: Progress) -> None:
        progress("assembly", 0.0)
        self.disks, self.backend = disks, backend
        self.blocks: Blocks = block_laplacian(
            disks.corners, disks.edges, disks.geometry, disks.of_vertex, len(disks), laplacian
        )
        self.problem = DirichletProblem(self.blocks.laplacian, disks.loop, disks.n, backend=backend, progress=progress)

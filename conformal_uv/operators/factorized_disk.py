"""A surface with disk topology, checked once and factorized once for every shape that it is mapped to."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ..linear.backends import choose_backend
from ..mesh.mesh_objects import MeshObject, triangles_of
from ..mesh.surface import Surface
from ..options import Laplacian
from ..progress import Callback, Progress
from .dirichlet import DirichletProblem
from .edge_laplacian import EdgeLaplacian, edge_laplacian

__all__ = ["FactorizedDisk"]


class FactorizedDisk:
    """The surface, its Laplacians and the factorized Dirichlet problems of its boundary, each made when it is needed.

    Parameters
    ----------
    V, F : arrays
    laplacian, backend : str
    callback : callable, optional

    Attributes
    ----------
    surface : Surface
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.
    kind : Laplacian
        The one asked for.
    asked : str
        The backend asked for.
    backend : str
        What that came to.

    Raises
    ------
    MeshError
        Or the subclass that says why the mesh is no disk.
    OptionError
        An unknown Laplacian or backend.
    """

    def __init__(
        self,
        V: ArrayLike | MeshObject,
        F: ArrayLike | None = None,
        *,
        laplacian: str = "auto",
        backend: str = "auto",
        callback: Callback | None = None,
    ) -> None:
        self.kind = Laplacian.of("laplacian", laplacian)
        self.asked, self.backend = backend, choose_backend(backend)
        Progress(callback)("checks", 0.0)
        self.surface = Surface.from_arrays(*triangles_of(V, F))
        self.boundary = self.surface.require_disk()
        self.surface.require_extent()
        self._laplacians: dict[Laplacian, EdgeLaplacian] = {}
        self._problems: dict[Laplacian, DirichletProblem] = {}

    def laplacian(self, progress: Progress, kind: Laplacian | None = None) -> EdgeLaplacian:
        """The Laplacian of a kind, by default the one asked for."""
        kind = self.kind if kind is None else kind
        if kind not in self._laplacians:
            progress("assembly", 0.0)
            surface = self.surface
            self._laplacians[kind] = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n, kind)
        return self._laplacians[kind]

    def problem(self, progress: Progress, kind: Laplacian | None = None) -> DirichletProblem:
        """The Dirichlet problem of the boundary with that Laplacian; from now on it reports to `progress`."""
        kind = self.kind if kind is None else kind
        if kind in self._problems:
            self._problems[kind].report_to(progress)
        else:
            laplacian, surface = self.laplacian(progress, kind), self.surface
            self._problems[kind] = DirichletProblem(
                laplacian, self.boundary, surface.n, points=surface.V, backend=self.asked, progress=progress
            )
        return self._problems[kind]

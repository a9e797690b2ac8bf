"""What is told of one mesh of a batch."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, fields
from enum import StrEnum
from typing import Any, Self

__all__ = ["BatchRow", "Outcome"]


class Outcome(StrEnum):
    """How the work on a mesh ended."""

    DONE = "done"
    PARTIAL = "partial"  # some of its charts were mapped, and are written
    REFUSED = "refused"  # the mesh can not be mapped as it is; it would be the same again
    FAILED = "failed"  # something else came between: memory, a disk, a solver
    KILLED = "killed"  # workers died of it

    @property
    def lasts(self) -> bool:
        """Whether the same mesh with the same options would end so again."""
        return self in (Outcome.DONE, Outcome.PARTIAL, Outcome.REFUSED)


@dataclass(frozen=True, kw_only=True)
class BatchRow:
    """One mesh of a batch: what became of it, and its numbers; None for what there is none of.

    Attributes
    ----------
    input, output : str
        Paths of the mesh and of its map, which is there if the status is "done" or "partial".
    status : Outcome
        "done", "partial" (some charts), "refused" (the mesh can not be mapped), "failed" (anything else), "killed"
        (workers died of it; it is set aside).
    error, message : str
        The error's class and text.
    warnings : str
        What the library warned of.
    map, method, laplacian, backend, converged, boundary_vertices, modulus, modulus_low, modulus_high, crossings
        Of the map, where the mesh has one chart.
    vertices, triangles, charts, mapped_charts, converged_charts, conformal_energy, dirichlet_energy, flipped, ...
        As in `UnwrapNumbers` and `DistortionNumbers`, arrays counted.
    signed_volume : float
        Of a sphere.
    seconds : float
        Wall time of reading, mapping and writing.
    peak_memory : int
        Bytes that the worker's process has ever had resident.
    input_hash, output_hash : str
        SHA-256 of the files' content; the input's with that of its seams behind it.
    options : str
        Those given, as JSON.
    version : str
        Of conformal_uv where the mesh was mapped.
    kept : bool
        The row is that of an earlier run, and nothing was done again; not stored.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> row = cuv.BatchRow(input="a.obj", output="out/a.obj", status="done", map="disk")
    >>> row.ok, row.angle_mean is None
    (True, True)
    """

    input: str
    output: str
    status: Outcome
    map: str
    error: str | None = None
    message: str | None = None
    warnings: str | None = None
    vertices: int | None = None
    triangles: int | None = None
    charts: int | None = None
    mapped_charts: int | None = None
    converged_charts: int | None = None
    boundary_vertices: int | None = None
    method: str | None = None
    laplacian: str | None = None
    backend: str | None = None
    angle_mean: float | None = None
    angle_rms: float | None = None
    angle_sd: float | None = None
    angle_max: float | None = None
    quasi_conformal_median: float | None = None
    quasi_conformal_max: float | None = None
    area_ratio: float | None = None
    conformal_energy: float | None = None
    dirichlet_energy: float | None = None
    flipped: int | None = None
    lost_to_double: int | None = None
    lost_to_float32: int | None = None
    coverage: float | None = None
    modulus: float | None = None
    modulus_low: float | None = None
    modulus_high: float | None = None
    crossings: int | None = None
    signed_volume: float | None = None
    seconds: float | None = None
    peak_memory: int | None = None
    input_hash: str | None = None
    output_hash: str | None = None
    options: str = "{}"
    version: str | None = None
    kept: bool = field(default=False, compare=False)

    @property
    def ok(self) -> bool:
        """Whether all of the mesh was mapped and written."""
        return self.status == Outcome.DONE

    def stored(self) -> dict[str, Any]:
        """The fields that are stored, by their names."""
        told = asdict(self)
        del told["kept"]
        return told

    @classmethod
    def restored(cls, stored: dict[str, Any]) -> Self:
        """The row of stored fields; names of other versions are passed over.

        Raises
        ------
        KeyError, ValueError
            They are no row.
        """
        known = {one.name for one in fields(cls)}
        kept = {name: value for name, value in stored.items() if name in known}
        kept["status"] = Outcome(kept["status"])
        return cls(**{"input": stored["input"], "output": stored["output"], "map": stored["map"], **kept})

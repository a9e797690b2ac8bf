"""What a map is like, in numbers: as a dictionary for JSON and as a table for people."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .._version import __version__
from ..disk import DiskMap
from ..operators import Distortion

__all__ = ["disk_summary", "distortion_summary", "print_rows", "print_summary"]

MOST_LISTED = 1000  # flipped faces written to JSON


def distortion_summary(distortion: Distortion) -> dict[str, Any]:
    """Angle error in degrees, quasi-conformal ratio and flips."""
    return {
        "angle_error_degrees": {
            "mean": distortion.angle_mean,
            "sd": distortion.angle_sd,
            "max": distortion.angle_max,
        },
        "quasi_conformal_ratio": {
            "median": float(sorted(distortion.quasi_conformal)[len(distortion.quasi_conformal) // 2]),
            "max": _finite(float(distortion.quasi_conformal.max())),
        },
        "flipped_faces": len(distortion.flipped),
        "flipped": distortion.flipped[:MOST_LISTED].tolist(),
    }


def disk_summary(result: DiskMap, source: str, target: str, seconds: dict[str, float]) -> dict[str, Any]:
    """Everything that is told of a map to the disk."""
    return {
        "conformal_uv": __version__,
        "input": source,
        "output": target,
        "mesh": {
            "vertices": result.surface.n,
            "triangles": result.surface.m,
            "boundary_vertices": len(result.boundary),
        },
        "method": result.method,
        "objective": result.objective,
        "backend": result.backend,
        "converged": result.converged,
        "center": result.center,
        "pins": list(result.pins) if result.pins is not None else None,
        "iterations": len(result.history),
        "history": [dict(zip(row._fields, row, strict=True)) for row in result.history],
        "conformal_energy": result.conformal_energy,
        "dirichlet_energy": result.dirichlet_energy,
        **distortion_summary(result.distortion),
        "seconds": seconds,
    }


def print_summary(summary: dict[str, Any]) -> None:
    """The short table at the end of the command."""
    mesh, angle = summary["mesh"], summary["angle_error_degrees"]
    rows = [
        ("mesh", "{vertices} vertices, {triangles} triangles, {boundary_vertices} on the boundary".format(**mesh)),
        ("method", f"{summary['method']}, {summary['objective']} energy, {summary['backend']}"),
        ("iterations", _iterations(summary)),
        ("conformal energy", f"{summary['conformal_energy']:.6g}"),
        ("Dirichlet energy", f"{summary['dirichlet_energy']:.6g}"),
        ("angle error", f"mean {angle['mean']:.4g}, sd {angle['sd']:.4g}, max {angle['max']:.4g} degrees"),
        ("flipped faces", str(summary["flipped_faces"])),
        ("seconds", ", ".join(f"{stage} {spent:.2f}" for stage, spent in summary["seconds"].items())),
        ("output", summary["output"]),
    ]
    print_rows(rows)


def print_rows(rows: list[tuple[str, str]]) -> None:
    """Print names and texts in two columns."""
    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    for name, text in rows:
        table.add_row(name, escape(text))
    Console().print(table)


def _iterations(summary: dict[str, Any]) -> str:
    history = summary["history"]
    if not history:
        return "none needed"
    last = history[-1]
    if "gradient_norm" in last:
        steps = sum(row["cg_steps"] for row in history)
        text = f"{len(history) - 1} Newton, {steps} CG; projected gradient {last['gradient_norm']:.2g}"
    else:
        text = f"{len(history)}; constraints {last['constraint_norm']:.2g}"
    return text if summary["converged"] else f"{text} - NOT CONVERGED"


def _finite(value: float) -> float | None:
    return value if value < float("inf") else None

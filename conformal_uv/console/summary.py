"""What a map is like, in numbers: as a dictionary for JSON and as a table for people."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .._version import __version__
from ..charts import Chart, Unwrapped
from ..disk import DiskMap
from ..errors import Remedy
from ..free import FreeMap
from ..rectangle import RectangleMap
from ..report import DistortionNumbers, distortion_numbers, shape_name, unwrap_numbers
from .terminal import plain

__all__ = [
    "angles_text",
    "distortion_summary",
    "iterations_text",
    "print_rows",
    "print_summary",
    "unwrapped_summary",
]

MOST_LISTED = 1000  # faces written to JSON
MOST_CHARTS = 20  # rows printed
INFINITE = float("inf")


def distortion_summary(numbers: DistortionNumbers) -> dict[str, Any]:
    """Angle error in degrees and quasi-conformal ratio."""
    return {
        "angle_error_degrees": {
            "mean": numbers.angle_mean,
            "rms": numbers.angle_rms,
            "sd": numbers.angle_sd,
            "max": numbers.angle_max,
        },
        "quasi_conformal_ratio": {
            "median": _finite(numbers.quasi_conformal_median),
            "max": _finite(numbers.quasi_conformal_max),
        },
        "area_ratio": numbers.area_ratio,
    }


def unwrapped_summary(result: Unwrapped, source: str, target: str, seconds: dict[str, float]) -> dict[str, Any]:
    """Everything that is told of an unwrapped mesh; with one chart its fields stand on top as well."""
    numbers = unwrap_numbers(result)
    assert numbers.distortion is not None
    lost = numbers.lost_to_float32.tolist()
    charts = [_chart_summary(number, chart, lost[number]) for number, chart in enumerate(result.charts)]
    summary: dict[str, Any] = {
        "conformal_uv": __version__,
        "input": source,
        "output": target,
        "summary": result.told(Remedy.as_flag),
        "mesh": {
            "triangles": numbers.triangles,
            "vertices": numbers.vertices,
            "faces": len(result.mapped),
            "mapped_faces": int(result.mapped.sum()),
        },
        **distortion_summary(numbers.distortion),
        "coverage": numbers.coverage,
        "flipped_faces": len(numbers.flipped),
        "flipped": numbers.flipped[:MOST_LISTED].tolist(),
        "charts": charts,
        "seconds": seconds,
    }
    if len(charts) == 1:
        summary = {**charts[0], **summary}
        summary["mesh"]["boundary_vertices"] = charts[0]["boundary_vertices"]
    return summary


def _chart_summary(number: int, chart: Chart, lost_to_float32: int) -> dict[str, Any]:
    told: dict[str, Any] = {
        "chart": number,
        "faces": len(chart.faces),
        "triangles": len(chart.F),
        "status": chart.status,
        "notes": chart.notes,
    }
    if chart.error is not None:
        return {**told, "error": f"{type(chart.error).__name__}: {chart.error.told(Remedy.as_flag)}"}
    assert chart.map is not None and chart.distortion is not None
    told.update(_map_summary(chart.map), lost_to_float32=lost_to_float32)
    return {**told, **distortion_summary(distortion_numbers([chart.distortion]))}


def _map_summary(result: DiskMap | FreeMap | RectangleMap) -> dict[str, Any]:
    told: dict[str, Any] = {
        "boundary_vertices": len(result.boundary),
        "shape": shape_name(result) if not isinstance(result, DiskMap) else "disk",
    }
    if isinstance(result, FreeMap):
        told["crossings"] = len(result.crossings)
    elif isinstance(result, RectangleMap):
        told["modulus"] = result.modulus
        told["modulus_bounds"] = [_finite(bound) for bound in result.modulus_bounds]
        told["corners"] = result.corners.tolist()
    else:
        told |= {
            "method": result.method,
            "objective": result.objective,
            "center": result.center,
            "pins": list(result.pins) if result.pins is not None else None,
            "iterations": len(result.history),
            "history": [dict(zip(row._fields, row, strict=True)) for row in result.history],
        }
    return told | {
        "map_status": str(result.status),
        "laplacian": result.laplacian,
        "backend": result.backend,
        "converged": result.converged,
        "conformal_energy": result.conformal_energy,
        "dirichlet_energy": result.dirichlet_energy,
        "flipped_triangles": len(result.flipped),
        "lost_to_double": len(result.lost_to_double),
        "repair": vars(result.repair) if result.repair is not None else None,
    }


def print_summary(summary: dict[str, Any], *, stderr: bool = False) -> None:
    """The short table at the end of the command; a row for each of several charts."""
    mesh, angle = summary["mesh"], summary["angle_error_degrees"]
    charts = summary["charts"]
    rows = [("mesh", f"{mesh['vertices']} vertices, {mesh['triangles']} triangles")]
    if len(charts) == 1:
        rows[0] = ("mesh", f"{rows[0][1]}, {mesh['boundary_vertices']} on the boundary")
        rows += _map_rows(charts[0])
    else:
        rows += [("charts", summary["summary"])]
        rows += [(f"chart {chart['chart']}", _chart_line(chart)) for chart in charts[:MOST_CHARTS]]
        rows += [("", f"and {len(charts) - MOST_CHARTS} more")] if len(charts) > MOST_CHARTS else []
    rows += [("angle error", angles_text(angle)), ("flipped faces", str(summary["flipped_faces"]))]
    if summary["coverage"] is not None:
        rows.append(("coverage", f"{100.0 * summary['coverage']:.3g} % of the texture"))
    rows += [("warning", text) for text in _warnings(charts)]
    rows += [
        ("seconds", ", ".join(f"{stage} {spent:.2f}" for stage, spent in summary["seconds"].items())),
        ("output", summary["output"]),
    ]
    print_rows(rows, stderr=stderr)


def print_rows(rows: list[tuple[str, str]], *, stderr: bool = False) -> None:
    """Print names and texts in two columns."""
    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    for name, text in rows:
        table.add_row(name, escape(plain(text)))
    Console(stderr=stderr).print(table)


def _map_rows(chart: dict[str, Any]) -> list[tuple[str, str]]:
    rows = [("shape", "{shape}, {laplacian} Laplacian, {backend}".format(**chart))]
    if chart["shape"] == "disk":
        rows = [
            ("method", "{method}, {objective} energy, {laplacian} Laplacian, {backend}".format(**chart)),
            ("iterations", iterations_text(chart)),
        ]
    elif chart["shape"] == "rectangle":
        rows.append(("modulus", _modulus_text(chart)))
    rows += [
        ("conformal energy", f"{chart['conformal_energy']:.6g}"),
        ("Dirichlet energy", f"{chart['dirichlet_energy']:.6g}"),
    ]
    if chart["repair"] is not None:
        told = "{flipped_before} folded triangles before, {flipped_after} after; {moved_vertices} vertices moved; "
        told += "mean angle error {angle_mean_before:.4g} before, {angle_mean_after:.4g} after"
        rows.append(("repair", told.format(**chart["repair"])))
    return rows + [("note", note) for note in chart["notes"]]


def _chart_line(chart: dict[str, Any]) -> str:
    if chart["status"] == "failed":
        return f"{chart['faces']} faces, not mapped"
    what = iterations_text(chart) if chart["shape"] == "disk" else chart["shape"]
    text = f"{chart['faces']} faces; {what}; energy {chart['conformal_energy']:.4g}; angle error "
    text += angles_text(chart["angle_error_degrees"])
    return "; ".join([text, *chart["notes"]])


def _modulus_text(chart: dict[str, Any]) -> str:
    low, high = chart["modulus_bounds"]
    return f"{chart['modulus']:.7g}, certainly between {low:.7g} and " + ("infinity" if high is None else f"{high:.7g}")


def angles_text(angle: dict[str, float]) -> str:
    """Mean, root mean square and maximum of the angle error in words."""
    return "mean {mean:.4g}, rms {rms:.4g}, max {max:.4g} degrees".format(**angle)


def iterations_text(chart: dict[str, Any]) -> str:
    """What the iteration took and where it ended."""
    history = chart["history"]
    if not history:
        return "no iterations needed"
    last = history[-1]
    if "gradient_norm" in last:
        steps = sum(row["cg_steps"] for row in history)
        text = f"{len(history) - 1} Newton, {steps} CG; projected gradient {last['gradient_norm']:.2g}"
    else:
        text = f"{len(history)}; constraints {last['constraint_norm']:.2g}"
    return text if chart["converged"] else f"{text} - NOT CONVERGED"


def _warnings(charts: list[dict[str, Any]]) -> list[str]:
    """Faces too small for doubles or for the single precision in which programs keep UVs; charts over themselves."""
    double = sum(chart.get("lost_to_double", 0) for chart in charts)
    single = sum(chart.get("lost_to_float32", 0) for chart in charts)
    told = []
    if double:
        told.append(f"crowded: {double} triangles are too small in the map for double precision")
    if single > double:
        told.append(f"crowded: {single} triangles vanish where UVs are kept in single precision; cut the surface")
    crossing = sum(chart.get("crossings", 0) > 0 for chart in charts)
    if crossing:
        who = "the boundary" if len(charts) == 1 else f"that of {crossing} charts"
        told.append(
            f"overlap: {who} crosses itself, and parts share their texture; cut the surface, or map it to disks"
        )
    return told


def _finite(value: float) -> float | None:
    return float(value) if value < INFINITE else None

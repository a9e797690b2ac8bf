"""The table of the runs."""

from __future__ import annotations

__all__ = ["markdown"]


def markdown(runs: dict[str, dict[str, float]], count: int) -> str:
    """A row for each run; throughput after the first mesh, without the start of the workers."""
    columns = ["run", "seconds", "processor seconds", "meshes a second", "of one process", "largest process", "all"]
    lines = [f"{count} meshes", "", f"| {' | '.join(columns)} |", "|" + "---|" * len(columns)]
    alone = _rate(next(iter(runs.values())))
    for name, run in runs.items():
        rate = "" if run["kept"] else f"{_rate(run):.2f}"
        times = "" if run["kept"] else f"{_rate(run) / alone:.2f}"
        memory = f"{run['largest_process'] / 1e6:.0f} MB | {run['together'] / 1e6:.0f} MB"
        lines.append(
            f"| {name} | {run['seconds']:.1f} | {run['processor_seconds']:.1f} | {rate} | {times} | {memory} |"
        )
    kept = [
        f"{name}: {run['kept']:.0f} rows kept, {run['lines']:.0f} lines" for name, run in runs.items() if run["kept"]
    ]
    return "\n".join([*lines, "", *kept])


def _rate(run: dict[str, float]) -> float:
    return run["meshes_after_first"] / run["seconds_after_first"]

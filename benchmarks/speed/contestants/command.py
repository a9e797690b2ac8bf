"""Ours: ``conformal-uv disk IN OUT``, from file to file; the stages are the command's own figures."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from conformal_uv.cli.entry import main

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage) -> Outcome:
    """As the shell would call it."""
    source = Path(str(arrays["path"]))
    target, numbers = source.with_suffix(".out.obj"), source.with_suffix(".json")
    sys.argv = ["conformal-uv", "disk", str(source), str(target), "--quiet", "--json", str(numbers)]
    try:
        main()
    except SystemExit as end:
        if end.code:
            raise RuntimeError(f"exit code {end.code}") from None
    target.unlink()
    return Outcome(stages=json.loads(numbers.read_text())["seconds"])

"""The documentation site as one archive, to be put onto a server or read from a folder."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from .errors import ReleaseError
from .reproducible import write_zip

__all__ = ["build_site"]


def build_site(repository: Path, version: str, output: Path, date: int) -> Path:
    """Build the site, a warning being an error, and put it into a zip.

    Raises
    ------
    ReleaseError
        If it can not be built; the extra `docs` is needed.
    """
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", folder],
            cwd=repository,
            env={**os.environ, "SOURCE_DATE_EPOCH": str(date), "NO_MKDOCS_2_WARNING": "1"},
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            raise ReleaseError(f"the site could not be built:\n{done.stdout}{done.stderr}")
        made = Path(folder)
        files = {path.relative_to(made).as_posix(): path.read_bytes() for path in made.rglob("*") if path.is_file()}
    target = output / f"conformal_uv-{version}-site.zip"
    write_zip(target, files, date)
    return target

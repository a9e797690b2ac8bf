"""A recipe for conda-forge, made of pyproject.toml and the source distribution that was built."""

from __future__ import annotations

import hashlib
import re
import tomllib
from pathlib import Path

from .errors import ReleaseError

__all__ = ["write_recipe"]

CONDA_NAMES = {"mapbox-earcut": "mapbox_earcut"}  # where conda-forge spells a requirement in another way
RECIPE = """\
# For conda-forge, made by tools/conda_recipe.py: `source` is to name the address that the sdist was uploaded to.
{{% set version = "{version}" %}}

package:
  name: conformal-uv
  version: {{{{ version }}}}

source:
  url: {sdist}
  sha256: {sha256}

build:
  noarch: python
  number: 0
  script: python -m pip install . -vv --no-deps --no-build-isolation
  entry_points:
{scripts}

requirements:
  host:
    - python {python}
    - pip
    - {backend}
  run:
    - python {python}
{run}

test:
  imports:
    - conformal_uv
    - meshlab_filter
  commands:
    - python -c "import conformal_uv as c, conformal_uv.samples as s; assert c.disk_map(*s.mask(500)).converged"

about:
  summary: {summary}
  license: {license}
  license_file: LICENSE
"""


def write_recipe(repository: Path, version: str, sdist: Path, target: Path) -> Path:
    """Write meta.yaml for a source distribution.

    Requirements with a marker come without it: conda-forge builds cvxopt for every system.

    Raises
    ------
    ReleaseError
        If pyproject.toml has a requirement that can not be read.
    """
    told = tomllib.loads((repository / "pyproject.toml").read_text(encoding="utf-8"))
    project = told["project"]
    python = project["requires-python"]
    text = RECIPE.format(
        version=version,
        sdist=sdist.name,
        sha256=hashlib.sha256(sdist.read_bytes()).hexdigest(),
        scripts="\n".join(f"    - {name} = {place}" for name, place in project["scripts"].items()),
        python=python,
        backend=_conda(told["build-system"]["requires"][0]),
        run="\n".join(f"    - {_conda(requirement)}" for requirement in project["dependencies"]),
        summary=project["description"],
        license=project["license"],
    )
    target.write_text(text, encoding="utf-8")
    return target


def _conda(requirement: str) -> str:
    """A requirement of pip's in conda's spelling."""
    match = re.fullmatch(r"([A-Za-z0-9._-]+)([<>=!~,.0-9a-z]*)(?:;.*)?", requirement.replace(" ", "", 1).strip())
    if match is None:
        raise ReleaseError(f"pyproject.toml requires {requirement!r}, which is not understood")
    name, versions = match.groups()
    return f"{CONDA_NAMES.get(name, name)} {versions}".strip()

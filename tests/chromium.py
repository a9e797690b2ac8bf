"""A headless Chromium for tests, drawing by software."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


@contextmanager
def launched() -> Iterator[Any]:
    """The browser; the test is skipped where there is none."""
    playwright = pytest.importorskip("playwright.sync_api")
    found = os.environ.get("CONFORMAL_UV_CHROMIUM") or shutil.which("chromium") or shutil.which("google-chrome")
    if found is None:
        pytest.skip("no Chromium: apt-get install chromium, or set CONFORMAL_UV_CHROMIUM")
    with playwright.sync_playwright() as run:
        chromium = run.chromium.launch(executable_path=found, args=FLAGS)
        yield chromium
        chromium.close()

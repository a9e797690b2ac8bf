"""The site is built without a warning, loads nothing from elsewhere, and built again it is the same, byte for byte."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pytest
from chromium import launched

from tools.errors import ReleaseError
from tools.site import build_site

ROOT = Path(__file__).resolve().parent.parent
DATE = 1_750_000_000


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    for name in ("mkdocs", "material", "mkdocstrings", "latex2mathml"):
        pytest.importorskip(name, reason="the extra docs is not installed")
    return build_site(ROOT, "1.2.3", tmp_path_factory.mktemp("site"), DATE)


def test_pages_load_nothing_from_elsewhere(site: Path) -> None:
    loads = re.compile(
        r"""(?:<(?:script|img|iframe|source)\b[^>]*\bsrc|<link\b[^>]*\bhref)=["']?(?:https?:)?//[^"' >]+"""
    )
    with zipfile.ZipFile(site) as archive:
        pages = [name for name in archive.namelist() if name.endswith(".html")]
        assert len(pages) > 20
        assert not {name: found for name in pages if (found := loads.findall(archive.read(name).decode()))}
        sheets = [archive.read(name).decode() for name in archive.namelist() if name.endswith(".css")]
        assert not any(re.search(r"""(?:@import|url\()\s*["']?(?:https?:)?//""", sheet) for sheet in sheets)


def test_formulas_are_mathml_and_none_is_left(site: Path) -> None:
    with zipfile.ZipFile(site) as archive:
        page = archive.read("method.html").decode()
    assert page.count("<math ") > 40
    assert r"\(" not in page and r"\[" not in page


def test_the_search_works_without_a_server(site: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(site) as archive:
        archive.extractall(tmp_path)
    with launched() as chromium:
        page, complaints = chromium.new_page(), []
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
        page.goto((tmp_path / "index.html").as_uri())
        page.fill(".md-search__input", "crowding")
        page.wait_for_selector(".md-search-result__item")
        assert "Crowding" in page.inner_text(".md-search-result__list") and not complaints


def test_built_again_it_is_the_same(site: Path, tmp_path: Path) -> None:
    assert build_site(ROOT, "1.2.3", tmp_path, DATE).read_bytes() == site.read_bytes()


def test_what_is_missing_is_told(tmp_path: Path) -> None:
    with pytest.raises(ReleaseError, match="site could not be built"):
        build_site(tmp_path, "1.2.3", tmp_path, DATE)

"""What the site does beyond MkDocs: formulas become MathML, files beside docs/ that pages link to come along, and the
start page shows a map that can be dragged."""

from __future__ import annotations

import posixpath
import re
from html import unescape
from pathlib import Path
from tempfile import TemporaryDirectory

from latex2mathml.converter import convert
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

import conformal_uv as cuv
from conformal_uv.samples import mask

REPOSITORY = Path(__file__).resolve().parent.parent
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)
LINK = re.compile(r"\]\(((?:\.\./)+)([\w./-]+?)(#[\w-]+)?\)")


def outside(source: str, up: str, path: str) -> str | None:
    """The path from the repository's root of a linked file that lies beside docs/, else None."""
    target = posixpath.normpath(posixpath.join("docs", posixpath.dirname(source), up, path))
    return target if not target.startswith(("docs/", "..")) and (REPOSITORY / target).is_file() else None


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Files beside docs/ that pages link to become files of the site."""
    found = {
        target
        for file in files.documentation_pages()
        for up, path, _ in LINK.findall(file.content_string)
        if (target := outside(file.src_uri, up, path)) and target != "CHANGELOG.md"
    }
    log = (REPOSITORY / "CHANGELOG.md").read_text(encoding="utf-8").replace("](docs/", "](")
    files.append(File.generated(config, "changelog.md", content=log))
    files.append(File.generated(config, "demo.html", content=demo()))
    for target in sorted(found):
        files.append(File.generated(config, f"files/{target}", content=(REPOSITORY / target).read_bytes()))
    return files


def demo() -> bytes:
    """The page that `disk --html` writes, of a mask."""
    with TemporaryDirectory() as folder:
        page = Path(folder) / "demo.html"
        cuv.disk_map(*mask(6000)).to_html(page, title="A mask and its disk")
        return page.read_bytes()


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Links to them lead there."""

    def there(match: re.Match[str]) -> str:
        up, path, _ = match.groups()
        target = outside(page.file.src_uri, up, path)
        if target is None:
            return match[0]
        inside = "changelog.md" if target == "CHANGELOG.md" else f"files/{target}"
        return f"]({posixpath.relpath(inside, posixpath.dirname(page.file.src_uri) or '.')})"

    return LINK.sub(there, markdown)


def on_page_content(html: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Formulas as MathML, which browsers draw themselves."""

    def drawn(match: re.Match[str]) -> str:
        tag, bracket, formula = match.groups()
        display = "block" if bracket == "[" else "inline"
        return f'<{tag} class="arithmatex">{convert(unescape(formula), display=display)}</{tag}>'

    return FORMULA.sub(drawn, html)

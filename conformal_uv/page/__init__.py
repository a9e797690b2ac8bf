"""A map as one self-contained web page."""

from .html import page_html, write_page

__all__ = ["page_html", "write_page"]

"""The site: ``sphinx-build -W docs site``. Sphinx reads this; the pages are Markdown, and readable as they stand.

Rule: nothing is fetched, neither while it is built nor by who reads it. A warning is an error (``-W``).
"""

from typing import Any

from pygments.lexers.special import TextLexer

project = "drillctl"
extensions = ["myst_parser"]
html_theme = "furo"  # its fonts are the reader's own
html_title = "drillctl"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
myst_heading_anchors = 4  # anchors as forges make them, so that a link holds in both places
exclude_patterns = ["lab/*/*", "_site"]
README_OF_THE_CLONE = "../../README.md"  # is no page of the site; its front page says how to set up too


def _within_the_site(app: Any, page: str, source: list[str]) -> None:
    source[0] = source[0].replace(f"({README_OF_THE_CLONE})", "(../index.md#set-up)")


def setup(app: Any) -> None:
    """Called by Sphinx."""
    app.add_lexer("mermaid", TextLexer)  # a diagram for forges; here its text
    app.connect("source-read", _within_the_site)

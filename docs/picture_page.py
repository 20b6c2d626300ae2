"""The page that shows the pictures of all screens side by side, for a person to look through."""

from collections.abc import Sequence
from html import escape

HEAD = """<!doctype html>
<meta charset="utf-8">
<title>drillctl: every screen</title>
<style>
body { font-family: sans-serif; margin: 1em; background: #eee; color: #111 }
figure { display: inline-block; margin: 0 1em 1em 0; vertical-align: top }
img { max-width: 46em; border: 1px solid #888 }
</style>
"""


def page(names: Sequence[str], sizes: Sequence[str], themes: Sequence[str]) -> str:
    """Returns HTML: a heading for each screen, and below it a picture of each size in each theme, as a link to itself.

    The pictures are files NAME-SIZE-THEME.svg beside the page.
    """
    links = " ".join(f'<a href="#{escape(name)}">{escape(name)}</a>' for name in names)
    return f"{HEAD}<p>{links}</p>\n" + "".join(_screen(name, sizes, themes) for name in names)


def _screen(name: str, sizes: Sequence[str], themes: Sequence[str]) -> str:
    figures = "".join(_figure(f"{name}-{size}-{theme}", f"{size}, {theme}") for size in sizes for theme in themes)
    return f'<h2 id="{escape(name)}">{escape(name)}</h2>\n{figures}'


def _figure(file: str, told: str) -> str:
    link = f'<a href="{escape(file)}.svg"><img loading="lazy" src="{escape(file)}.svg" alt="{escape(file)}"></a>'
    return f"<figure>{link}<figcaption>{escape(told)}</figcaption></figure>\n"

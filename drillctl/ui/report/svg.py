"""Pieces of SVG that the drawings of a report share: the frame of a drawing, and a text in it."""

from html import escape

WIDTH, MARGIN = 720.0, 46.0


def label(x: float, y: float, words: str, anchor: str = "start") -> str:
    """Returns a text that begins, ends (``end``) or has its middle (``middle``) at this place."""
    where = "" if anchor == "start" else f' text-anchor="{anchor}"'
    return f'<text x="{x:.1f}" y="{y:.1f}"{where}>{escape(words)}</text>'


def svg(inner: str, width: float, height: float, title: str) -> str:
    """Returns a drawing of its own."""
    head = f'<svg role="img" aria-label="{escape(title)}" viewBox="0 0 {width:.0f} {height:.0f}">'
    return f"{head}{inner}</svg>"

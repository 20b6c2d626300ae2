"""The colours of curves and tools in pictures, for light and dark paper.

Rule: any two of a theme are told apart by people with deuteranopia and protanopia too, and each is seen on its paper;
tests/ui/test_series_colours.py holds the distances. Nothing is told by colour alone. Who changes one changes page.css.
"""

from typing import Literal, NamedTuple

Theme = Literal["light", "dark"]


class Look(NamedTuple):
    """Paper, ink and lines of a picture, and the colours of its series, used again from the first where they end."""

    paper: str
    ink: str
    line: str
    series: tuple[str, ...]

    def of(self, number: int) -> str:
        """The colour of a series, counted from 0."""
        return self.series[number % len(self.series)]


LOOKS: dict[Theme, Look] = {
    "light": Look("#ffffff", "#1a1a1a", "#b0b0b0", ("#004488", "#d55e00", "#009e73", "#785ef0", "#6699cc", "#000000")),
    "dark": Look("#16181c", "#e6e6e6", "#5a5f69", ("#56b4e9", "#d55e00", "#f0e442", "#009e73", "#e8ecfb", "#ddcc77")),
}

"""The number formats by the names that people know, the paper's four first. A table; used by menus.py and files.py.

What the names stand for: docs/DRILL-FILES.md. EXCELLON *adding zero* leaves trailing zeros out, so that they are to be
added; the *ASCII drill format* is written at full width.
"""

from typing import NamedTuple

from drillctl.language.words import N_


class Format(NamedTuple):
    """A name, its hot letter marked by ``&``, and the option it stands for; an empty one: recognised."""

    name: str
    option: str


RECOGNISED = Format(N_("&Recognised"), "")
FORMATS = (
    RECOGNISED,
    Format(N_("&ASCII drill format"), "inch,2:4,none"),
    Format(N_("EXCELLON &decimal"), "inch,decimal"),
    Format(N_("EXCELLON adding &zero"), "inch,2:4,trailing"),
    Format(N_("EXCELLON &metric"), "mm,3:3,trailing"),
    Format(N_("EXCELLON, &leading zeros left out"), "inch,2:4,leading"),
    Format(N_("EXCELLON metric, leading zeros le&ft out"), "mm,3:3,leading"),
    Format(N_("EXCELLON metric, de&cimal"), "mm,decimal"),
    Format(N_("EXCELLON metric, f&ull width"), "mm,4:2,none"),
)
BY_OPTION = {entry.option: entry for entry in FORMATS}

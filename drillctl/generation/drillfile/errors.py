"""What the reader can complain about, and the words it uses.

Rule: every complaint is a code out of the two tables below, with the source line and a shortened
piece of the file; a message never carries more of the file than TEXT_LIMIT characters.
Refusals stop the file, warnings travel with the result (line-too-long is either). Every module of this package uses it.
"""

from __future__ import annotations

from typing import NamedTuple

from drillctl.language import Message, Refusal

TEXT_LIMIT = 60
PROBLEM_LIMIT = 20

REFUSALS = {
    "ambiguous-tool": Message(
        "four digits behind T can mean two of the file's tools; write the number with fewer digits"
    ),
    "archive": Message("this is an archive; unpack it and give the drill file inside"),
    "bad-diameter": Message("the tool's diameter is not a usable number; correct the tool's definition"),
    "bad-format": Message("the --format given cannot be understood; write for instance inch,2:4,leading or mm,decimal"),
    "bad-number": Message("a coordinate is not a number; correct the line or export the file again"),
    "bad-pattern": Message("M25, M01 and M02 do not make a closed pattern; export without step and repeat"),
    "bad-repeat-count": Message("R needs a whole count from 1 up; correct the line or export without repeats"),
    "bad-setting": Message("the setting's value is not understood; correct or delete it"),
    "bad-tool-number": Message("tool numbers go from 0 to 9999"),
    "contradictory-units": Message("the header declares inch and metric both; delete the wrong one"),
    "coordinate-out-of-range": Message("the hole lies further out than any board; check the number, units and format"),
    "cut-short": Message(
        "the last line has no end and the end of the program is missing: the file was cut short; get it anew"
    ),
    "diameter-without-point": Message("a diameter with leading zeros needs a decimal point; write for instance C0.8"),
    "duplicate-axis": Message("the same axis is written twice in one line; correct the line"),
    "empty-file": Message("the file holds no commands"),
    "file-too-large": Message("the file is larger than any drill file; is it the right one?"),
    "gcode-not-drill": Message("this is G-code for a milling machine; export an Excellon drill file"),
    "gerber-not-drill": Message("this is a Gerber picture; export the drill data (Excellon) instead"),
    "holes-after-end": Message(
        "holes follow the end of the program (M30); say --after-end ignore or --after-end drill"
    ),
    "hpgl-not-drill": Message("this is an HPGL plot; export the drill data (Excellon) instead"),
    "line-too-long": Message("the line is longer than any in a drill file; a comment is cut, a command refused"),
    "misplaced-word": Message("the word can not stand there; give it a line of its own"),
    "no-tool-selected": Message("a hole is drilled while no tool is selected; select a tool before it"),
    "not-a-drill-file": Message("nothing in it looks like a drill file; is it the right one?"),
    "not-text": Message("this is a binary file, not a drill file"),
    "repeat-too-large": Message("repeats or patterns make more holes than the limit"),
    "repeat-without-hole": Message("R repeats the hole before it, and there is none"),
    "repeat-without-offset": Message("R needs the distance between the holes, as X or Y"),
    "pattern-without-start": Message("M02 repeats a pattern, and no M25 began one"),
    "rout-or-hole": Message("after a tool change in rout mode this may be a hole or the router's way; add G05 or G00"),
    "sieb-meyer-not-drill": Message("this is a Sieb & Meyer program; export Excellon instead"),
    "torn-number": Message(
        "two numbers with a space between could be one or two; delete the space or write the letter"
    ),
    "too-many-holes": Message("the file has more holes than the limit"),
    "tool-redefined": Message("the header defines the same tool with two diameters; delete the wrong one"),
    "tool-report-not-drill": Message("this is a drill report; keep it beside the drill file, which is the one to load"),
    "undefined-tool": Message("the tool is selected but defined nowhere; add it to the header"),
    "unknown-command": Message("the command is not known; correct or delete the line"),
    "unsupported-command": Message("the command is known but not drilled by this program; export without it"),
    "zero-moved": Message(
        "the zero point moves between holes, which this program does not follow; export without G92 or G93"
    ),
}

WARNINGS = {
    "axis-version": Message(
        "X and Y of another axis version (VER) are read as version 1; the board may come out turned"
    ),
    "bad-diameter-unused": Message("a tool has no usable diameter, but drills nothing"),
    "block-deleted": Message("lines with / are left out, as BLKD,ON says"),
    "block-not-deleted": Message("lines with / are carried out, as block delete (BLKD) is off"),
    "comma-decimal": Message("commas are read as decimal points"),
    "contradictory-format": Message("the file declares its number format twice, differently; the stronger one is used"),
    "contradictory-mode": Message(
        "the header and a later word differ about incremental coordinates; the later one is followed"
    ),
    "count-mismatch": Message("the file announces another number of holes for this tool than it drills"),
    "default-digits-left": Message(
        "the numbers cannot have their unit's default digits; check the board, or give --format"
    ),
    "digits-of-other-unit": Message(
        "digits declared for one unit do not hold for the other, which has its default digits"
    ),
    "data-after-end": Message("what follows the end of the program is ignored"),
    "diameter-unlikely": Message("a drill so thin or so thick is rare; are its units right?"),
    "duplicate-hole": Message("the same hole is drilled twice"),
    "eia-rs244-tape-code": Message("the file is punched-tape code (EIA RS-244) and was decoded"),
    "format-guessed": Message("the number format is a guess; settle it with --format if the board looks wrong"),
    "header-not-closed": Message("holes begin before the header is closed by % or M95"),
    "holes-after-stop": Message("holes follow a stop (M00 or M02) and are drilled"),
    "inner-spaces": Message("spaces inside coordinate lines are passed over"),
    "missing-diameter": Message("a tool has no diameter, neither here nor in a file beside it"),
    "missing-tools": Message("no tool is ever selected; every hole belongs to one tool of unknown diameter"),
    "missing-units": Message("neither inch nor metric is declared; the units are a guess"),
    "mixed-decimal-implied": Message("some coordinates have a decimal point and some have none"),
    "no-end-of-program": Message("the end of the program (M30) is missing; the file may be cut short"),
    "no-holes": Message("the file drills no holes"),
    "odd-board": Message("the board is very small or very large for its drills; if the format is wrong, give --format"),
    "overlapping-holes": Message("two holes overlap; if many do, the number format is wrong"),
    "place-from-before": Message(
        "an axis not written after a stop or a copied pattern keeps the value of the line before it"
    ),
    "routs-not-drilled": Message("milled cuts (M15 to M16) are read but not drilled"),
    "rout-move": Message(
        "a line without a G code moves the router, it drills nothing; G05 is missing if a hole was meant"
    ),
    "scaling-ignored": Message("the machine's scaling (M60) is not applied"),
    "second-header": Message("a second header begins inside the program"),
    "side-file-cut": Message("a report beside the file is too long: only its beginning is read"),
    "size-mismatch": Message(
        "a tool's diameter differs from what a comment or a report beside the file says; the file counts"
    ),
    "slot-without-length": Message("a slot of no length is drilled as a hole"),
    "tool-size-changes": Message("a tool is defined again with another diameter; from there on it counts"),
    "units-from-report": Message("only a report beside the file says in which units its diameters are"),
    "units-change-in-body": Message("the units change inside the program"),
    "utf-16": Message("the file is UTF-16 text and was decoded"),
    "zero-set-ignored": Message("the zero point set by G92 or G93 is not applied"),
    "zeros-contradict-data": Message("the declared zero suppression contradicts the numbers"),
}


class Remark(NamedTuple):
    """One complaint: code of a table above, source line (1-based) or None, the offending text; it may stand for others
    of its kind, ``alike`` of them with itself.
    """

    code: str
    line: int | None = None
    text: str = ""
    alike: int = 1

    @property
    def reason(self) -> Message:
        """The complaint as a sentence, with the offending text quoted."""
        words = REFUSALS.get(self.code) or WARNINGS[self.code]
        said = Message("{sentence} ({text!r})", sentence=words, text=self.text) if self.text else words
        if self.alike > 1:
            said = Message("{reason}; {count} in all", reason=said, count=self.alike)
        return said.at(self.code)

    def as_dict(self) -> dict[str, object]:
        """Code, line, text and reason, as `inspect --json` prints them."""
        found: dict[str, object] = {"code": self.code, "line": self.line, "text": self.text, "reason": self.reason}
        return found | {"count": self.alike} if self.alike > 1 else found


class Complaint(Exception):
    """Raised inside the package by whoever finds a fault; the loop above knows name and line."""

    def __init__(self, code: str, text: str = "", *, fatal: bool = False) -> None:
        super().__init__(code)
        self.code, self.text, self.fatal = code, shorten(text), fatal


class DrillFileError(Refusal):
    """A file that cannot be drilled. str() is one line, `NAME:LINE: reason`.

    code, line, text, reason: the first problem; problems: all that were found, at most PROBLEM_LIMIT.
    """

    kind = "drill-file"

    def __init__(self, name: str, problems: tuple[Remark, ...]) -> None:
        first = problems[0]
        self.name = shorten(name)
        self.problems = problems[:PROBLEM_LIMIT]
        self.code, self.line, self.text, self.reason = first.code, first.line, first.text, first.reason
        super().__init__(first.reason.at(self.name, first.line))

    def as_dict(self) -> dict[str, dict[str, object]]:
        """The object `inspect --json` prints for a refused file."""
        return {"error": self.problems[0].as_dict()}


def shorten(text: str) -> str:
    """The text on one printable line of at most TEXT_LIMIT characters."""
    line = "".join(c if c.isprintable() else "?" for c in text[: TEXT_LIMIT + 1].strip())
    return line if len(line) <= TEXT_LIMIT else line[: TEXT_LIMIT - 3] + "..."

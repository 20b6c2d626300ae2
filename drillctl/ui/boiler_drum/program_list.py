"""The part program as a list with the sentence in execution, and what it says of itself: times, holes, what comes next.

Rule: functions of the program and of how far it is; ``>`` marks the sentence in execution.
"""

import textwrap

from drillctl.language.number_text import clock
from drillctl.language.words import _, ngettext, translated
from drillctl.ui.widgets.texts import Line, around, width_of
from drillctl.viewmodel.records import Progress
from drillctl.viewmodel.workpieces import PartView, SentenceView

LABEL_COLUMNS = 8


def list_lines(part: PartView | None, sentence: int, done: int, columns: int, rows: int) -> list[Line]:
    """As many sentences as there are rows, those around the one in execution; in words too where all have room, and
    without their cells where there is none for these.
    """
    if part is None:
        advice = (_("No workpiece is called."), _("Type its number, 01 to 99,"), _("then P (PROG). L lists them."))
        return [[text] for text in advice[:rows]]
    current = max(sentence, min(done + 1, len(part.sentences))) - 1
    shown = around(current, len(part.sentences), rows)
    lines = [_sentence(index + 1, part.sentences[index], sentence, done, part) for index in shown]
    told: list[Line] = [
        [*line, f"  {translated(part.sentences[index].words)}"] for index, line in zip(shown, lines, strict=True)
    ]
    without: list[Line] = [line[:1] for line in lines]
    return next((each for each in (told, lines) if max(map(width_of, each), default=0) <= columns), without)


def heading(part: PartView | None) -> Line:
    """The workpiece with its number, its store, and how many sentences it has."""
    if part is None:
        return [("title", _("Workpiece"))]
    count = len(part.sentences)
    text = ngettext(
        "Workpiece {number:02} ({store}), {count} sentence", "Workpiece {number:02} ({store}), {count} sentences", count
    )
    return [("title", text.format(number=part.number, store=part.store, count=count))]


def facts(part: PartView | None, progress: Progress | None, sentence: int, done: int, columns: int) -> list[Line]:
    """Time, holes, the sentence in execution in words, and the one that follows it."""
    if part is None:
        return []
    running = progress if sentence else None
    total_s = part.estimate.ticks / max(part.estimate.tick_hz, 1)
    drilled = sum(hole.sentence <= done for hole in part.holes)
    time = _("{whole} in all").format(whole=clock(total_s))
    if running is not None and running.seconds_left is not None:
        gone, left = clock(running.machine_seconds), clock(running.seconds_left)
        time = _("{gone}, {left} left of {whole}").format(gone=gone, left=left, whole=clock(total_s))
    following = part.sentences[sentence : sentence + 1] if sentence else part.sentences[:1]
    now = part.sentences[sentence - 1 : sentence] if sentence else ()
    return [
        *_labelled(_("Time"), time, columns),
        *_labelled(_("Holes"), _("{done} of {total}").format(done=drilled, total=len(part.holes)), columns),
        *_labelled(_("Now"), translated(now[0].words) if now else "-", columns),
        *_labelled(_("Next"), translated(following[0].words) if following else _("the end"), columns),
        [("warning", translated(part.warnings[0]) if part.warnings else "")],
    ]


def _sentence(number: int, one: SentenceView, sentence: int, done: int, part: PartView) -> Line:
    mark = ">" if number == sentence else " "
    role = "accent" if number == sentence else "dark" if number <= done else "body"
    seconds = one.ticks / max(part.estimate.tick_hz, 1)
    move = f"{one.axis.upper()}{one.way_mm:+8.1f}"
    figures = f"{mark}{number:4} {one.text} {move} {one.m_min:5.3g} {seconds:6.2f} s"
    return [(role, figures), (role, f"  {one.cell:04X}")]


def _labelled(label: str, text: str, columns: int) -> list[Line]:
    """A label with its text behind it, on as many lines as the text needs."""
    first, *others = textwrap.wrap(text, max(columns - LABEL_COLUMNS, 1)) or [""]
    indent = " " * LABEL_COLUMNS
    further: list[Line] = [[indent, other] for other in others]
    return [[("title", f"{label:{LABEL_COLUMNS}}"), first], *further]

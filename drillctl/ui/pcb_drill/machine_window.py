"""The machine's window where there is room: how far the job is, the commands to come, and the place in large figures.

Rule: a function of the machine's view and the job's progress; nothing is told by colour alone.
"""

from drillctl.language.words import _, ngettext
from drillctl.ui.screens.window_lines import hole_text, labelled, lamps, tick_lines, time_text, tool_text
from drillctl.ui.widgets.pages import apart, numbered_pages
from drillctl.ui.widgets.text_graphics import gauge, large
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import AxisView, BoardView, MachineView
from drillctl.viewmodel.records import Progress

FIGURES = 8  # signs of a place: -999.999
NAME_COLUMNS = 3


def machine_pages(
    view: MachineView, progress: Progress | None, board: BoardView | None, columns: int, rows: int, plain: bool = False
) -> list[list[Line]]:
    """The pages of a window of ``columns`` and ``rows``, at least one; the motors are not on them."""
    lamp_lines = [*lamps(_("Sensors"), view.sensors, columns), *lamps(_("Outputs"), view.outputs, columns)]
    job = [*_job(view, progress, board, columns, plain), *_commands(view)]
    places = [line for axis in view.axes[:3] for line in _place(axis, plain)]
    further = [line for axis in view.axes[3:] for line in _place(axis, plain)]
    blocks = [block for block in (job, places, [*tick_lines(view), *lamp_lines], further) if block]
    return numbered_pages([*apart(blocks[:-1]), blocks[-1]], columns, rows)


def _job(
    view: MachineView, progress: Progress | None, board: BoardView | None, columns: int, plain: bool
) -> list[Line]:
    done, total = (progress.holes_done, progress.holes_total) if progress else (0, 0)
    return [
        labelled(_("Hole"), hole_text(view, progress)),
        [("good", gauge(done, total, columns, plain))],
        labelled(_("Time"), time_text(progress)),
        labelled(_("Tool"), tool_text(view, board)),
    ]


def _commands(view: MachineView) -> list[Line]:
    """The command in execution, and those of the program that follow it; always as many lines."""
    then = [*view.following, "", "", ""][:3]
    heads = [_("then") if then[0] else "", "", ""]
    following: list[Line] = [[("dark", f"{head:9}{text}")] for head, text in zip(heads, then, strict=True)]
    return [labelled(_("Command"), view.command or "-"), *following, labelled(_("Queue"), str(view.queued))]


def _place(axis: AxisView, plain: bool) -> list[Line]:
    """An axis in three rows: where it is in large figures, beside them where it goes and how far that is."""
    top, middle, bottom = large(f"{axis.position_mm:{FIGURES}.3f}", plain)
    to_go = axis.target_mm - axis.position_mm
    names = (axis.name.upper(), _("mm"), "")
    beside = (
        _("to {mm:8.3f}").format(mm=axis.target_mm),
        _("go {mm:8.3f}").format(mm=to_go),
        ngettext("{count} step", "{count} steps", axis.position_steps).format(count=axis.position_steps),
    )
    return [
        [("title", f"{name:{NAME_COLUMNS}}"), ("accent", figure), f"  {words}"]
        for name, figure, words in zip(names, (top, middle, bottom), beside, strict=True)
    ]

"""The boxes in which the Files screen asks how a board is read, placed and drilled.

Rule: a box shows what holds now, and hands on what was accepted; nothing is read or changed here.
"""

import os
from collections.abc import Callable, Sequence
from typing import Any

from drillctl.files.inputs import real_path
from drillctl.language.number_text import pair_mm
from drillctl.language.words import _
from drillctl.ui.pcb_drill.board_facts import format_name
from drillctl.ui.pcb_drill.typed import FORMATS, accepted, is_yes, length_mm, panel_of, pins_of, tool_numbers
from drillctl.ui.screens.shell import Shell
from drillctl.ui.widgets.dialogs import Answered, Field
from drillctl.viewmodel.job_options import JobOptions, PanelOf

Changes = Callable[[dict[str, Any], Answered], None]  # options by their names, and what is called with the problems


def choose_format(shell: Shell, options: JobOptions, chosen: Callable[[str], None]) -> None:
    """Offers the formats by name, and to type one as the command line has it; an empty text means: recognise it."""
    lines = [*(format_name(entry.option) for entry in FORMATS), _("&Typed...").replace("&", "")]

    def of_the_list(index: int) -> None:
        if index < len(FORMATS):
            chosen(FORMATS[index].option)
        else:
            type_format(shell, options, chosen)

    shell.choose(_("Format"), lines, of_the_list)


def type_format(shell: Shell, options: JobOptions, chosen: Callable[[str], None]) -> None:
    """Asks for a format as it is written on the command line."""
    prompt = _("Units, digits and zeros left out, as in inch,2:4,leading:")
    shell.ask_text(_("Format"), prompt, options.format or "", chosen)


def ask_offset(shell: Shell, options: JobOptions, chosen: Callable[[tuple[float, float]], None]) -> None:
    """Asks for the offset from the base; what is no pair of numbers is told and not handed on."""

    def typed(text: str) -> None:
        pair = pair_mm(text)
        if pair is None:
            wanted = _("two numbers are wanted, such as 12.7 25.4, not {text!r}").format(text=text)
            shell.message(_("Offset"), [wanted])
        else:
            chosen(pair)

    now = "{:g} {:g}".format(*options.offset_mm)
    shell.ask_text(_("Offset"), _("X and Y in mm from the base:"), now, typed)


def ask_panel(shell: Shell, options: JobOptions, changes: Changes) -> None:
    """Asks for columns and rows of a panel of the same board; one of each is no panel."""
    now = options.panel or PanelOf(1, 1, 0.0, 0.0)
    fields = (
        Field(_("Columns (along X):"), str(now.columns)),
        Field(_("Rows (along Y):"), str(now.rows)),
        Field(_("From board to board in X, mm:"), f"{now.pitch_x_mm:g}"),
        Field(_("From board to board in Y, mm:"), f"{now.pitch_y_mm:g}"),
    )
    shell.ask_fields(_("Panel"), fields, accepted(lambda texts: {"panel": panel_of(texts)}, changes))


def ask_how_to_drill(shell: Shell, options: JobOptions, changes: Changes) -> None:
    """Asks for peck depth, spot depth, tools to leave out, the file of the drills at hand, pins, and if slots are
    milled.
    """
    fields = (
        Field(_("Pecks of so many mm (empty: at once):"), _typed_mm(options.peck_mm)),
        Field(_("Spot first, mm deep (empty: none):"), _typed_mm(options.spot_mm)),
        Field(_("Tools to leave out, by number:"), " ".join(map(str, options.skip_tools))),
        Field(_("File of the drills at hand:"), options.drills or ""),
        Field(_("Pins to turn it over on, MM:WHERE:MM (empty: none):"), str(options.pins or "")),
        Field(_("Mill slots: yes (empty: holes that overlap):"), _("yes") if options.mill else ""),
    )
    shell.ask_fields(_("How to drill"), fields, accepted(_how_to_drill, changes))


def _how_to_drill(texts: Sequence[str]) -> dict[str, Any]:
    drills = str(real_path(os.path.expanduser(texts[3].strip()))) if texts[3].strip() else None
    depths = {"peck_mm": length_mm(texts[0]), "spot_mm": length_mm(texts[1])}
    kinds = {"pins": pins_of(texts[4]), "mill": is_yes(texts[5])}
    return {**depths, **kinds, "skip_tools": tool_numbers(texts[2]), "drills": drills}


def _typed_mm(value_mm: float | None) -> str:
    return "" if value_mm is None else f"{value_mm:g}"

"""What F1 says of each screen before it lists the keys: what is shown, what the signs mean, how one begins.

Rule: ten lines at most, none longer than a dialog is wide; every sign that a screen draws is explained here or, behind
the keys, in SIGNS. By a screen's title.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.frame import screen_keys
from drillctl.ui.models.fault_effects import PLANTS_IN_WORDS
from drillctl.ui.widgets.dialogs import nothing
from drillctl.ui.widgets.keys import FRAME_KEYS, help_lines

Link = tuple[str, Callable[[], object]]  # a line, and what a click on it does

EXPLAINED: Mapping[str, tuple[str, ...]] = {
    "Drilling": (
        N_("The machine at work. I makes the position known, S drills the board."),
        N_("Board: the dots are holes to drill, as large as they are; bright"),
        N_("ones are for the tool that is in. ○ (o) drilled, ◎ (@) in work,"),
        N_("× (x) failed, + the drill and its trail (~), ⊕ (0) the base."),
        N_("The dotted line is the way to the next 60 holes; the frame (:)"),
        N_("stands 2.54 mm outside the outermost holes. Y shows tool numbers,"),
        N_("* where several meet. Wheel or Z zooms, drag or Shift-arrows move,"),
        N_("a click on a hole tells its number, its tool and its place."),
        N_("The bar shows how much is drilled; below it the command in execution"),
        N_("and the next three. Large figures: where an axis is, in mm."),
    ),
    "Machine": (
        N_("The machine at work. 2 finds the origins, 1 drills the board."),
        N_("The seven buttons: their digits, or a click. Tab: the next page."),
        N_("absolute: from the origin of the parameters; relative: from theirs,"),
        N_("or from the working base. Bottom: the bottom dead centre."),
        N_("Offset +-: how far a hole's diameter may be from the tool's."),
        N_("Tools: > is in use; +- the offset; left: holes it is good for."),
        N_("Magazine: place, tool, bits by spindle: o there, . not, ? unknown."),
        N_("Signals: in brackets while on. Tests > Signals switches outputs."),
        N_("Board: dots to do, ○ (o) drilled, ◎ (@) in work, + the drill."),
    ),
    "Parameters": (
        N_("The parameters of one group, as the machine's file has them."),
        N_("Below: what the field under the cursor may be, means and does."),
        N_("What can't be is said as it is typed; F2 saves all or nothing."),
        N_("unset: not entered yet; a board is refused until nothing is unset."),
        N_("Saved parameters start the machine anew: initialise it again."),
    ),
    "Panel": (
        N_("The machine's keys and display of six figures; click or type."),
        N_("Four digits and MEM show a cell; two more digits write it. Two"),
        N_("digits and PROG call a workpiece; AUTO runs it. Arrows: one step."),
        N_("There is no origin switch: to initialise means: this is zero."),
        N_("Set the tool there first. ZERO returns to it, the tool first."),
        N_("accumulator: steps from zero; steps left: of this sentence."),
        N_("List: > in execution; X or Y, mm, m/min, seconds, cell."),
        N_("Wall: ○ (o) to drill, ◎ (@) in work, ● (#) drilled, ▼ (v) the tool."),
        N_("X 10 +0 a b: column of the phase table, ramp state, [a] is on."),
    ),
    "Files": (
        N_("Left, the drill files of a folder; right, what the chosen one says."),
        N_("A file of up to 64 KiB is drawn before it is loaded."),
        N_("Enter loads a file; Esc goes back to the machine, where S drills it."),
        N_("The format of the numbers is recognised, and the reason is shown."),
        N_("Every change of placing or order reads the file anew."),
        N_("Placing and drilling: each option behind the key that changes it;"),
        N_("in a smaller window above the facts. Tab and arrows scroll them."),
        N_("█░ (#.) behind a tool: its share of the time. The way is that of"),
        N_("the drill from hole to hole; another order may be shorter."),
    ),
    "Measured holes": (
        N_("Drive the drill over a hole of the board and press Enter: found."),
        N_("Two holes fix shift and turn, three also scale and shear."),
        N_("In the file: where the hole should be; found: where it is."),
        N_("> marks the hole in question; off by: how far it is from its place."),
        N_("- at the beginning of a line is a warning: measure once more."),
        N_("F2 places the board by the holes that were found."),
    ),
    "Phase tables": (
        N_("The phase tables that there are; Enter opens one."),
        N_("A phase table says which wire of a motor is on in which column;"),
        N_("one column after another, in turn, moves the rotor on."),
        N_("* marks a table in use, with the names of the motors that have it."),
        N_("A shipped table stays: what is changed is saved as your own copy."),
        N_("In a large window the table under the cursor is shown beside."),
    ),
    "Ramps": (
        N_("The ramp tables that there are; Enter opens one."),
        N_("A ramp says how many ticks a motor waits from step to step while it"),
        N_("speeds up, goes on and brakes: too few, and it loses steps."),
        N_("* marks a table in use, with the names of the motors that have it."),
        N_("A shipped table stays: what is changed is saved as your own copy."),
        N_("In a large window the table under the cursor is shown beside."),
    ),
    "Machines": (
        N_("The machines that there are; Enter opens the file of one."),
        N_("A machine's file has its card, axes, sensors, limits, and names"),
        N_("the tables of its motors."),
        N_("* marks the machine in use."),
        N_("A shipped file stays: what is changed is saved as your own copy."),
        N_("In a large window the file under the cursor is shown beside."),
    ),
    "Phase table": (
        N_("A row for each wire, a column for each step of the cycle."),
        N_("x: the wire is on in that column; . it is off. Space switches it."),
        N_("Wires above the lowest voltage force: they are on for one column."),
        N_("Rotor: where it rests in each column; a higher bar pulls harder."),
        N_("No bar: nothing holds it. One cycle should turn it by all columns."),
        N_("Enter tries the table on bench motors, with moves of many lengths,"),
        N_("and tells how many steps they lose; the machine doesn't move."),
        N_("In a large window the saved table stands beside the changed one."),
        N_("Problems and warnings stand below; one with a problem isn't saved."),
    ),
    "Ramp": (
        N_("A row for each state of the ramp: how many ticks a step takes there,"),
        N_("and how many steps are needed to stop from it. The bar is the speed."),
        N_("State 0 is rest; signs + and - are the two directions."),
        N_("accelerate, brake: steps to go from which the state rises or falls;"),
        N_("interval: ticks from step to step. stop: what braking takes."),
        N_("[3] is the number under the cursor; type over it."),
        N_("Enter tries the table on bench motors, with moves of many lengths,"),
        N_("and tells how many steps they lose; the machine doesn't move."),
        N_("In a large window the saved table stands beside the changed one."),
    ),
    "Configuration": (
        N_("The machine's file as fields: value, unit, range, and its meaning."),
        N_("Type over a value; F6 lists those it can have. F2 saves it."),
        N_("1..100 is a range, A | B are choices; locked: it can't be changed."),
        N_("A wrong value is told at once and never saved. Below, in a large"),
        N_("window beside: what the field means, and what the changes will do."),
        N_("F12 on the interrupt frequency measures what this computer carries."),
        N_("On an axis's scale it moves the axis, and asks how far it went."),
        N_("It is in force when the machine starts anew; the position is lost."),
    ),
    "Queue of commands": (
        N_("Type commands, one a line; Tab completes a word."),
        N_("F5 runs all, Ctrl-D to the cursor, Ctrl-N a line, Ctrl-T a tick."),
        N_("A wrong line says what is wrong, with its line and column."),
        N_("Ctrl-T shows phases, column and ramp state, the port's outputs as"),
        N_("a number a card, sensors reached. [name] is on. In a large window"),
        N_("each tick is a column: ▔ (-) on, ▁ (_) off, ┊ (:) ticks let through."),
    ),
    "Signals": (
        N_("Every input and output of the port as it is; a section a motor."),
        N_("A cell: name, bit of the port, level of the wire, what that means:"),
        N_("a sensor is REACHED or clear, an output or motor's wire ON or off."),
        N_("> is the cursor; the line below tells card and bit of its signal."),
        N_("Below, if there is room: each card's bits, x high, . low, blank: no"),
        N_("wire; then the same as a number, as the port has it."),
        N_("Space switches the output under the cursor, while nothing moves."),
        N_("A motor's wire costs the position, and is asked about first."),
        N_("A forcing wire goes off by itself after a second: it would burn."),
    ),
    "Scope": (
        N_("A run as a logic analyser shows it: time goes to the right."),
        N_("A cell is one character of a wave; the heading tells its ticks."),
        N_("▁ (_) off, ▔ (-) on, │ (|) an edge, ▒ (#) several in one cell."),
        N_("▼ (v) the cursor; A and B are marks; · (.) a number, no room for it."),
        N_("Tab chooses a kind of event; N goes to the next one, Shift N back."),
        N_("Y draws the row's numbers as a curve, a position's speed below it;"),
        N_("its least and greatest value in view stand at the left."),
        N_("From A to B the lowest line tells ticks, ms and each axis's steps."),
        N_("/ finds a command by a part of its text. The mouse wheel zooms."),
    ),
    "Port": (
        N_("The port that the machine's file names, and the one in use."),
        N_("Mode SIMULATED moves a simulation; REAL drives the port's card."),
        N_("> is the port that the machine's file names; what each port needs"),
        N_("is told beside it in a large window."),
        N_("A test opens the port and asks it; nothing moves."),
        N_("Behind a sensor's name: REACHED or clear, as it answers now."),
        N_("A real machine is driven only after a question."),
        N_("Its position is not known then: initialise it first."),
    ),
    "Plant and faults": PLANTS_IN_WORDS,
    "Lab sheet": (N_("A task of the laboratory, to be read; arrows and PgDn scroll it."),),
}

# What stands behind the keys, where the signs of a screen need more than its ten lines.
SIGNS: Mapping[str, tuple[str, ...]] = {
    "Drilling": (
        N_("Motors: X is a forcing wire's pulse (24 V); bars for ramp and speed."),
        N_("Rotor: ● (o) where it is, | where it is thought to be, in steps;"),
        N_("◇ (%) on the board: where the bit really is."),
        N_("now mm, steps: where an axis is, from the working base;"),
        N_("to mm, steps: where it goes."),
        N_("12 +0 after an axis: column 12 of its phase table, ramp state 0."),
        N_("[24a]: the wire is on. Names in brackets are on, others are off."),
        N_("The column that is out, in a table: [x] its wire is on, |x| or |.|"),
        N_("its wire is off. At rest 24 V is off, whatever the table has there."),
        N_("Ticks: interrupts a second, and how many of them came late."),
        N_("Lost: steps that the simulated rotors did not follow, by axis."),
    ),
}


def explanation_of(
    screen: urwid.Widget, press: Callable[[str], object]
) -> tuple[str, Sequence[str], Sequence[Link], Sequence[str]]:
    """Returns what F1 shows of a screen: title, explanation, its keys, and the rest of its signs. A click on a key's
    line calls ``press`` with urwid's name of the key.
    """
    keys = [*screen_keys(screen), *FRAME_KEYS]
    acts = [partial(press, key.names[0]) if key.names else nothing for key in keys]
    title = getattr(screen, "title", "")
    first, last = ([*map(_, table.get(title, ()))] for table in (EXPLAINED, SIGNS))
    return _(title) or _("Keys"), first, [*zip(help_lines(keys), acts, strict=True)], last

"""What F1 says of each screen before it lists the keys: what is shown, what the signs mean, how one begins.

Rule: ten lines at most, none longer than a dialog is wide; every sign that a screen draws is explained here or, behind
the keys, in SIGNS. By a screen's title.
"""

from collections.abc import Mapping

from drillctl.language.words import N_
from drillctl.ui.models.fault_effects import PLANTS_IN_WORDS

EXPLAINED: Mapping[str, tuple[str, ...]] = {
    "Drilling": (
        N_("The machine at work. I makes the position known, S drills the board."),
        N_("Board: the dots are holes to drill, as large as they are; bright"),
        N_("ones are for the tool that is in. ○ (o) drilled, ◎ (@) in work,"),
        N_("× (x) failed, + the drill and its trail (~), ⊕ (0) the base."),
        N_("The dotted line is the way to the next 60 holes; the frame (:)"),
        N_("stands 2.54 mm outside the outermost holes. V shows tool numbers,"),
        N_("* where several meet. Wheel or Z zooms, drag or Shift-arrows move,"),
        N_("a click on a hole tells its number, its tool and its place."),
        N_("The bar shows how much is drilled; below it the command in execution"),
        N_("and the next three. Large figures: where an axis is, in mm."),
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
        N_("Enter loads a file; Esc goes back to the machine, where S drills it."),
        N_("The format of the numbers is recognised, and the reason is told."),
        N_("Every change of placing or order reads the file anew."),
        N_("- at the beginning of a line is a warning."),
    ),
    "Measured holes": (
        N_("Drive the drill over a hole of the board and press Enter: found."),
        N_("Two holes fix shift and turn, three also scale and shear."),
        N_("> marks the hole in question; off by: how far it is from its place."),
        N_("F2 places the board by the holes that were found."),
    ),
    "Phase tables": (
        N_("The phase tables that there are; Enter opens one."),
        N_("* marks a table in use, with the names of the motors that have it."),
        N_("A shipped table stays: what is changed is saved as your own copy."),
    ),
    "Ramps": (
        N_("The ramp tables that there are; Enter opens one."),
        N_("* marks a table in use, with the names of the motors that have it."),
        N_("A shipped table stays: what is changed is saved as your own copy."),
    ),
    "Machines": (
        N_("The machines that there are; Enter opens the file of one."),
        N_("* marks the machine in use."),
        N_("A shipped file stays: what is changed is saved as your own copy."),
    ),
    "Phase table": (
        N_("A row for each wire, a column for each step of the cycle."),
        N_("x: the wire is on in that column; . it is off. Space turns it over."),
        N_("Wires above the lowest voltage force: they are on for one column."),
        N_("Rotor: where it rests in each column; a higher bar pulls harder."),
        N_("No bar: nothing holds it. One cycle should turn it by all columns."),
        N_("F5 tries the table on bench motors, with moves of many lengths,"),
        N_("and tells how many steps they lose; the machine doesn't move."),
        N_("In a large window the saved table stands beside the changed one."),
        N_("Problems and warnings stand below; one with a problem isn't saved."),
    ),
    "Ramp": (
        N_("A row for each state of the ramp: how many ticks a step takes there,"),
        N_("and how many steps are needed to stop from it. The bar is the speed."),
        N_("State 0 is rest; signs + and - are the two directions."),
        N_("Type a number over the one under the cursor."),
        N_("F5 tries the table on bench motors, with moves of many lengths,"),
        N_("and tells how many steps they lose; the machine doesn't move."),
        N_("In a large window the saved table stands beside the changed one."),
    ),
    "Configuration": (
        N_("The machine's file as fields: value, unit, range, and its meaning."),
        N_("Type over a value, or choose the next with F6; F2 saves it."),
        N_("A wrong value is told at once and never saved. Below, in a large"),
        N_("window beside: what the field means, and what the changes will do."),
        N_("F12 on the interrupt frequency measures what this computer carries."),
    ),
    "Queue of commands": (
        N_("Type commands, one a line; Tab completes a word."),
        N_("F5 runs all, F6 down to the cursor, F7 one line, F8 one tick."),
        N_("A wrong line says what is wrong, with its line and column."),
        N_("After F8: phases with column and ramp state, the port's outputs as"),
        N_("a number a card, sensors reached. [name] is on. In a large window"),
        N_("each tick is a column: ▔ (-) on, ▁ (_) off, ┊ (:) ticks let through."),
    ),
    "Signals": (
        N_("Every input and output of the port as it is now."),
        N_("[name] is on. Space switches what the cursor is on, at rest."),
        N_("A motor's wire costs the position, and is asked about first."),
    ),
    "Scope": (
        N_("A run as a logic analyser shows it: time goes to the right."),
        N_("▁ (_) off, ▔ (-) on, ▒ (#) changes too close to be drawn apart."),
        N_("▼ (v) the cursor; A and B are marks; · (.) no change since before."),
        N_("A letter goes to the next event of its kind, a capital to the last."),
        N_("Y draws the row's numbers as a curve, a position's speed below it;"),
        N_("its least and greatest value in view stand at the left."),
        N_("From A to B the lowest line tells ticks, ms and each axis's steps."),
        N_("/ finds a command by a part of its text. The mouse wheel zooms."),
    ),
    "Port": (
        N_("The port that the machine's file names, and the one in use."),
        N_("A test opens the port and asks it; nothing moves."),
        N_("A real machine is driven only after a question."),
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

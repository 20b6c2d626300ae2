"""The scale of an axis measured, step by step: the machine moves, the operator measures, the new scale is shown.

Rule: what counts is how many steps were made, not how many were asked for; nothing is saved before a yes.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from drillctl.language.number_text import number
from drillctl.language.words import _, ngettext
from drillctl.ui.screens.shell import Shell
from drillctl.ui.screens.table_actions import TableActions
from drillctl.viewmodel.console import AxisView, Console
from drillctl.viewmodel.tables import FieldView, TableEditing

PROPOSED_STEPS = 2400
SCALE, PER_STEP = "columns_per_inch", "columns_per_step"
MM_PER_INCH = 25.4
LEAST_TRAVEL_MM = 5.0
GREATEST_CHANGE = 2.0  # beyond that the steps or the ruler were another's, not the scale
READING_MM = 0.1  # how well a person reads a ruler


@dataclass(frozen=True, slots=True)
class Measurement:
    """``old``: columns per inch as configured; ``steps`` made either way, each of ``columns_per_step`` columns."""

    steps: int
    columns_per_step: int
    old: int
    travel_mm: float

    @property
    def columns_per_inch(self) -> int:
        """The measured scale, rounded to the whole column."""
        return round(abs(self.steps) * self.columns_per_step * MM_PER_INCH / self.travel_mm)

    @property
    def change_percent(self) -> float:
        """By how much the measured scale differs from the configured one, in percent."""
        return 100 * (self.columns_per_inch / self.old - 1)

    @property
    def doubt_percent(self) -> float:
        """The error of the scale, in percent, if the reading is wrong by a tenth of a millimetre."""
        return 100 * READING_MM / self.travel_mm

    def problem(self) -> str:
        """Why the measurement gives no scale; an empty text where it does."""
        if not self.steps:
            return _("the axis has not moved")
        if self.travel_mm < LEAST_TRAVEL_MM:
            return _("{mm:g} mm is too short to measure by: {least:g} mm at least").format(
                mm=self.travel_mm, least=LEAST_TRAVEL_MM
            )
        ratio = self.columns_per_inch / self.old
        if not 1 / GREATEST_CHANGE <= ratio <= GREATEST_CHANGE:
            return _("{new} columns/inch instead of {old} is not plausible: see what was measured").format(
                new=self.columns_per_inch, old=self.old
            )
        return ""


class ScaleGuide:
    """One measurement of ``axis`` on the machine called ``name``; ``then`` follows once a scale was saved."""

    def __init__(
        self, console: Console, shell: Shell, tables: TableEditing, name: str, axis: str, then: Callable[[], None]
    ):
        self._console, self._shell, self._tables = console, shell, tables
        self._actions = TableActions(console, shell, tables, "machines")
        self._name, self._axis, self._then = name, axis, then
        self._from_steps = 0

    def begin(self) -> None:
        """Asks how far to move; refused where the machine does not run by the file as it is saved."""
        if refusal := self._refusal():
            self._tell(refusal)
            return
        prompt = _("Mark where {axis} stands. Steps to move, as far as can be measured:")
        self._shell.ask_text(self._title, prompt.format(axis=self._axis.upper()), str(PROPOSED_STEPS), self._move)

    @property
    def _title(self) -> str:
        return _("Scale of {axis}").format(axis=self._axis.upper())

    def _refusal(self) -> str:
        view, axis = self._console.view(), self._now()
        if view.machine != self._name or axis is None:
            return _("The scale is measured on the machine itself: drive this one first (F5).")
        columns_per_mm = self._number(SCALE) / MM_PER_INCH
        if not math.isclose(axis.steps_per_mm, columns_per_mm / self._number(PER_STEP)):
            return _("The machine runs by another scale than its file has: drive it anew first (F5).")
        if self._field(SCALE).locked:
            return " ".join(self._changed(self._number(SCALE))[1])
        return _("The machine must be at rest first.") if view.moving or view.command else ""

    def _move(self, typed: str) -> None:
        axis = self._now()
        try:
            steps = int(typed)
        except ValueError:
            self._tell(_("{typed!r} is not a whole number").format(typed=typed))
            return
        self._from_steps = axis.position_steps if axis else 0
        if problems := self._console.jog(self._axis, steps):
            self._tell(*map(_, problems))
        else:
            self._ask_travel()

    def _ask_travel(self, remark: str = "") -> None:
        prompt = _("When {axis} rests, measure how far it went. In mm:").format(axis=self._axis.upper())
        self._shell.ask_text(self._title, remark + prompt, "", self._measured)

    def _measured(self, typed: str) -> None:
        view, axis = self._console.view(), self._now()
        if view.moving or view.command:
            self._ask_travel(_("It still moves. "))
            return
        travel_mm = number(typed)
        if travel_mm is None:
            self._tell(_("{typed!r} is not a number").format(typed=typed))
            return
        steps = axis.position_steps - self._from_steps if axis else 0
        self._judge(Measurement(steps, self._number(PER_STEP), self._number(SCALE), abs(travel_mm)))

    def _judge(self, found: Measurement) -> None:
        """Shows old and new scale and their difference; saves the new one on a yes."""
        if problem := found.problem():
            self._tell(problem)
            return
        text, problems = self._changed(found.columns_per_inch)
        if problems:
            self._tell(*problems)
            return
        text_with_fields = _("{moved}, {mm:g} mm: {new} columns/inch instead of {old} ({change:+.2f} %). "
                  "A reading wrong by 0.1 mm makes {doubt:.2f} %. Save it?")  # fmt: skip
        moved = ngettext("{count} step", "{count} steps", found.steps).format(count=found.steps)
        question = text_with_fields.format(
            moved=moved, mm=found.travel_mm, new=found.columns_per_inch, old=found.old,
            change=found.change_percent, doubt=found.doubt_percent,
        )  # fmt: skip
        self._shell.ask(question, lambda: self._actions.save(self._name, text, self._name, self._then))

    def _changed(self, columns_per_inch: int) -> tuple[str, tuple[str, ...]]:
        text = self._tables.read("machines", self._name)
        return self._tables.with_field(text, self._field(SCALE).place, str(columns_per_inch))

    def _now(self) -> AxisView | None:
        return next((axis for axis in self._console.view().axes if axis.name == self._axis), None)

    def _field(self, key: str) -> FieldView:
        """The axis's field of this key in the saved file."""
        fields = self._tables.fields(self._tables.read("machines", self._name))
        return next(field for field in fields if field.axis == self._axis and field.place[-1] == key)

    def _number(self, key: str) -> int:
        return int(self._field(key).value)

    def _tell(self, *lines: str) -> None:
        self._shell.message(_("Not measured"), lines)

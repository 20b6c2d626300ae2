"""The fields of a machine's file: how they are called, counted and explained, and what is typed over them.

Rule: the new text is sound in every field or it is not offered for saving.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from drillctl.language import Message, joined
from drillctl.language.words import N_
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.tables import Checked, FieldPath, FieldView, TableEditing


class ConfigurationDraft:
    """The fields of one machine's text. ``typed`` holds what was changed, by place."""

    def __init__(self, tables: TableEditing, text: str):
        self._tables, self._text = tables, text
        self.fields: tuple[FieldView, ...] = tables.fields(text)
        self.typed: dict[FieldPath, str] = {}

    @property
    def changed(self) -> bool:
        """Whether anything differs from the text."""
        return bool(self.typed)

    def shown(self, field: FieldView) -> str:
        """What stands in a field on the screen: what was typed, else the file's value."""
        return self.typed.get(field.place, field.value)

    def type(self, field: FieldView, typed: str) -> None:
        """Takes a field's new content; the file's value typed again counts as no change."""
        if typed == field.value:
            self.typed.pop(field.place, None)
        else:
            self.typed[field.place] = typed

    def problem(self, field: FieldView) -> Message | None:
        """Why a field's content can't be taken; None where it can."""
        refused = self.refusal(field, self.typed[field.place]) if field.place in self.typed else ()
        return joined(" ", refused) if refused else None

    def refusal(self, field: FieldView, typed: str) -> Problems:
        """The reasons why a field would not take this text; none where it would."""
        return self._tables.with_field(self._text, field.place, typed)[1]

    def candidate(self) -> tuple[str, Problems]:
        """The text with all that was typed, and the reasons why some of it is not in it."""
        text = self._text
        refused: list[Message] = []
        for place, typed in self.typed.items():
            text, problems = self._tables.with_field(text, place, typed)
            refused += problems
        return text, tuple(refused)

    def effects(self) -> Sequence[Message]:
        """What saving what was typed will do."""
        return self._tables.effects(self._text, self.candidate()[0]) if self.changed else ()

    def check(self) -> Checked:
        """What the whole would be: fields may each be right and yet not fit together."""
        return self._tables.check("machines", self.candidate()[0])


class FieldWords(NamedTuple):
    """A field's label, unit and explanation, to be translated where they are shown."""

    label: str
    unit: str
    meaning: str


# By a field's place; that of an axis's field without the axis.
FIELD_WORDS: Mapping[FieldPath, FieldWords] = {
    ("configuration", "card"): FieldWords(
        N_("Card"), "", N_("The name of the I/O card that the motors' drivers and the sensors are wired to.")
    ),
    ("configuration", "card_address"): FieldWords(
        N_("Card's address"), "", N_("Where the card answers on the bus; hexadecimal as in 0x2A0, or decimal.")
    ),
    ("configuration", "mode"): FieldWords(
        N_("Mode"),
        "",
        N_("The ticks move a simulation, or (REAL) they drive the card, on its port; --port wins."),
    ),
    ("columns_per_inch",): FieldWords(
        N_("scale"), N_("columns/inch"), N_("Columns of the phase table to an inch of travel, as measured.")
    ),
    ("columns_per_step",): FieldWords(
        N_("columns of a step"), N_("columns"), N_("How many columns of the phase table make one step of the ramp.")
    ),
    ("range", 0): FieldWords(
        N_("lowest position"), N_("steps"), N_("Of the work range, from machine zero; a position below is a fault.")
    ),
    ("range", 1): FieldWords(
        N_("highest position"), N_("steps"), N_("Of the work range, from machine zero; a position above is a fault.")
    ),
    ("phase",): FieldWords(
        N_("phase table"), "", N_("The table that drives this motor, edited under Tests; a table of the same wires.")
    ),
    ("ramp",): FieldWords(
        N_("ramp"), "", N_("How this motor accelerates and brakes, edited under Tests; each motor may have its own.")
    ),
    ("configuration", "longest_drilling_s"): FieldWords(
        N_("Longest drilling time"), "s", N_("A stroke that takes longer is a fault: the drill may be blunt.")
    ),
    ("configuration", "spin_up_s"): FieldWords(
        N_("Spindle's run-up"), "s", N_("Waited after the spindle was switched on, before the first stroke.")
    ),
    ("configuration", "tool_change"): FieldWords(
        N_("Tool change"),
        "",
        N_("MANUAL: the screen asks for each tool. AUTOMATIC: on a real port only; --tools wins."),
    ),
    ("tick_hz",): FieldWords(
        N_("Interrupt frequency"), "Hz", N_("Ticks a second; with the ramp it decides how fast the motors turn.")
    ),
    ("description",): FieldWords(N_("Description"), "", N_("Anything that helps to know the machine again.")),
}


def words_of(field: FieldView) -> FieldWords:
    """Label, unit and meaning of a field; a field that has none is labelled with its key in the file."""
    place = field.place[2:] if field.axis else field.place
    return FIELD_WORDS.get(place, FieldWords(str(place[-1]), "", ""))

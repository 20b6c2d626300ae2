"""Two tables compared: machines field by field, others line by line. Used by the list of tables."""

import difflib

from drillctl.panel.tables import FieldView, Kind, TableDesk
from drillctl.ui.screens.field_words import words_of
from drillctl.ui.words import _

LABEL_COLUMNS, VALUE_COLUMNS = 26, 18


def differences(desk: TableDesk, kind: Kind, name: str, other: str) -> list[str]:
    """A line a difference, empty for two that are alike."""
    here, there = desk.read(kind, name), desk.read(kind, other)
    if kind == "machines" and desk.fields(here) and desk.fields(there):
        return _of_fields(desk.fields(here), desk.fields(there), name, other)
    return list(difflib.unified_diff(here.splitlines(), there.splitlines(), name, other, lineterm=""))


def label_of(field: FieldView) -> str:
    """What a field is called on the screen, its axis first."""
    label = _(words_of(field).label)
    return f"{field.axis.upper()}: {label}" if field.axis else label


def _of_fields(first: tuple[FieldView, ...], second: tuple[FieldView, ...], name: str, other: str) -> list[str]:
    here, there = ({label_of(field): field.value for field in fields} for fields in (first, second))
    labels = [*here, *(label for label in there if label not in here)]
    pairs = [(label, here.get(label, "-"), there.get(label, "-")) for label in labels]
    told = [_row(*pair) for pair in pairs if pair[1] != pair[2]]
    return [_row("", name, other), *told] if told else []


def _row(label: str, value: str, other: str) -> str:
    return f"{label:{LABEL_COLUMNS}} {value:{VALUE_COLUMNS}} {other}"

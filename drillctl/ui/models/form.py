"""A machine's fields being typed over: which are changed, which can't be taken, and the text that they would make.

Rule: the text is sound in every field or it is not offered for saving. Used by the configuration screen.
"""

from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.tables import Checked, FieldView, Place, TableEditing


class ConfigurationDraft:
    """The fields of one machine's text. ``typed`` holds what was changed, by place."""

    def __init__(self, desk: TableEditing, text: str):
        self._desk, self._text = desk, text
        self.fields: tuple[FieldView, ...] = desk.fields(text)
        self.typed: dict[Place, str] = {}

    @property
    def changed(self) -> bool:
        """Whether anything differs from the text."""
        return bool(self.typed)

    def shown(self, field: FieldView) -> str:
        """What stands in a field on the screen."""
        return self.typed.get(field.place, field.value)

    def type(self, field: FieldView, typed: str) -> None:
        """A field's new content; the old one again is no change."""
        if typed == field.value:
            self.typed.pop(field.place, None)
        else:
            self.typed[field.place] = typed

    def problem(self, field: FieldView) -> str:
        """Why a field's content can't be taken; empty where it can."""
        return " ".join(self.refusal(field, self.typed[field.place])) if field.place in self.typed else ""

    def refusal(self, field: FieldView, typed: str) -> Problems:
        """Why a field would not take this."""
        return self._desk.with_field(self._text, field.place, typed)[1]

    def candidate(self) -> tuple[str, Problems]:
        """The text with all that was typed, and the reasons why some of it is not in it."""
        text = self._text
        refused: list[str] = []
        for place, typed in self.typed.items():
            text, problems = self._desk.with_field(text, place, typed)
            refused += problems
        return text, tuple(refused)

    def check(self) -> Checked:
        """What the whole would be: fields may each be right and yet not fit together."""
        return self._desk.check("machines", self.candidate()[0])

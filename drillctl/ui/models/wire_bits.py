"""The bits that switch the wires of a phase table, for each motor of a machine that uses it (paper, Table 1).

Rule: a value; what it makes is a new text of the machine's file, in which no two wires share a bit. Used by the phase
editor.
"""

from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.tables import FieldView, TableEditing


class WireBits:
    """``motors`` are the axes that use the phase table, in the order of the machine's file; none for no machine."""

    def __init__(self, desk: TableEditing, text: str, phase: str):
        self._desk, self._text = desk, text
        self._wires = {str(wire.place[-1]): wire for wire in desk.wires(text)}
        fields = desk.fields(text)
        self.motors = tuple(field.axis for field in fields if field.place[-1] == "phase" and field.value == phase)

    def of(self, axis: str, wire: str) -> FieldView | None:
        """A motor's wire; None where the machine has none of this name."""
        return self._wires.get(f"{axis}.{wire}")

    def taken_by(self, typed: str, wire: FieldView) -> FieldView | None:
        """The other wire that a bit switches already; None for a free bit, and for what is no number."""
        bit = typed.strip()
        return next((other for other in self._wires.values() if other.value == bit and other != wire), None)

    def with_bit(self, wire: FieldView, typed: str, taken: FieldView | None) -> tuple[str, Problems]:
        """The machine's text with the new bit, and ``taken``, where given, on the old one; or as it was, with why."""
        text, problems = self._desk.with_field(self._text, wire.place, typed)
        if problems or taken is None:
            return (self._text if problems else text), problems
        exchanged, problems = self._desk.with_field(text, taken.place, wire.value)
        return (self._text if problems else exchanged), problems

"""Which variables a VCD file has, and what of which signal each shows.

Rule: this room knows no machine, so the caller makes the layout.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from drillctl.trace.values import WIDEST_BITS, is_word

# kind and part of a variable: what there is
SHOWN = (
    ("wire", None), ("integer", None), ("integer", "seq"), ("integer", "opcode"),
    ("string", None), ("string", "running"),
)  # fmt: skip


@dataclass(frozen=True)
class VcdVar:
    """One variable of the file.

    `kind`: `wire` (bit `bit` of the value), `integer` (the value, signed 32 bits, or `bits` of it from `bit` on) or
    `string` (its word, or `labels[value]`). `source`: name of the signal. `part`, of a command signal only: `seq` or
    `opcode` (integers), `running` (a string). `invert`: the wire is 1 where the bit is 0. A scope `a.b` is b within a.
    Raises ValueError for a combination that does not exist.
    """

    scope: str
    name: str
    kind: str
    source: str
    bit: int | None = None
    part: str | None = None
    invert: bool = False
    labels: tuple[str, ...] | None = None
    bits: int | None = None

    def __post_init__(self) -> None:
        if (self.kind, self.part) not in SHOWN:
            raise ValueError(f"{self.scope}.{self.name}: no {self.kind} can show part {self.part}")
        if self.kind == "wire" and (self.bit is None or not 0 <= self.bit < WIDEST_BITS):
            raise ValueError(f"{self.scope}.{self.name}: a wire needs a bit, 0..{WIDEST_BITS - 1}, not {self.bit}")
        if not is_word(self.scope) or not is_word(self.name):
            raise ValueError(f"{self.scope!r} {self.name!r}: scopes and names are printable words without blanks")


VcdLayout = Sequence[VcdVar]

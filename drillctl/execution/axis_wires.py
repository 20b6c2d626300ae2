"""What an axis's tables put out: its wires and the columns of its phase table as bits of the port image."""

from drillctl.machine import AxisTable
from drillctl.machine.hazards import opposite_halves


def forcing_bits(table: AxisTable) -> int:
    """The bits of the forcing wires."""
    return sum(1 << bit for wire, bit in zip(table.phase.wires, table.wire_bits, strict=True) if wire.forcing)


def winding_halves(table: AxisTable) -> tuple[int, ...]:
    """The bits of both halves of a winding, for each winding that has two."""
    bits = dict(zip(table.phase.wire_names(), table.wire_bits, strict=True))
    return tuple(1 << bits[one] | 1 << bits[other] for one, other in opposite_halves(table.motor))


def column_images(table: AxisTable, forcing: bool) -> tuple[tuple[int, ...], ...]:
    """Port images of all columns: index 1 for forward, -1 for backward (0 unused); one tuple where they agree."""
    wires = [(w, bit) for w, bit in zip(table.phase.wires, table.wire_bits, strict=True) if forcing or not w.forcing]
    columns = range(table.phase.columns)
    forward = tuple(sum(1 << bit for wire, bit in wires if wire.forward[column]) for column in columns)
    backward = tuple(sum(1 << bit for wire, bit in wires if wire.backward[column]) for column in columns)
    return ((), forward, forward if backward == forward else backward)

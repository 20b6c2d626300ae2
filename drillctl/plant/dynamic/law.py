"""The law of motion of the dynamic plant: what a tick does to motors, carriages and the bits of the heads.

Rule: that of motors.py, which has the motors' part of it. Both are run as they stand, or compiled from the same text.

Each axis is a row of ``rows``; row n begins at ``n * ROW``. A row has the columns of motors.py, then those of the belt:

    ZERO .. PLACE  degrees at power-up, columns of a cycle, steps at power-up, steps of a column, half the play in
                   steps, and where the carriage is, in steps
    SCALE          steps of a millimetre
    MOVED          1 where the last tick changed something
    CARRIES        1 where the axis carries a bit: a hole's place doesn't depend on it

Between LOW and HIGH no sensor changes, and no bit meets or leaves the board. Behind the last wire of ``wires`` stands
the last image. ``bits`` begins with what ``run`` says of its last tick, LEFT and STILL. From FIRST on it has a row for
each head, HOLE + axes numbers long:

    MOUNTED        1 where there is a bit and a board for it
    HEAD           the axis that carries it, which goes down through a screw of LEVER metres a radian
    IN_BOARD       1 where the bit is in the board
    INVERTED       1 where the motor turns backward on the way down
    SURFACE, BOTTOM     of the board, and of the present hole, in steps of the head
    BEGUN          1 once there was a hole
    WEAR, METRES   metres of board that it has cut, and those of a step
    THRUST, GROWTH      N that it needs when sharp, and the part of that by which a metre of board adds to it
    SAME           millimetres within which a place is that of the present hole
    BEARS          N at which it breaks, 0 where nothing breaks it; SHORT: steps that have broken off
    BROKEN         1 where it has broken in this stretch
    HOLE ..        by axis, in millimetres, where the present hole is
"""

from collections.abc import MutableSequence, Sequence

from drillctl.plant.dynamic import motors

Rows = MutableSequence[float]

ZERO, COLUMNS, START, PITCH, PLAY, PLACE = 41, 42, 43, 44, 45, 46
SCALE, MOVED, CARRIES = 47, 48, 49
ROW = 50

LEFT, STILL = 0, 1
FIRST = 2
MOUNTED, HEAD, IN_BOARD, INVERTED, SURFACE, BOTTOM, BEGUN = 0, 1, 2, 3, 4, 5, 6
WEAR, METRES, THRUST, GROWTH, LEVER, SAME = 7, 8, 9, 10, 11, 12
BEARS, SHORT, BROKEN = 13, 14, 15
HOLE = 16

TURN = 360.0


def run(
    rows: Rows, axes: int, heads: int, wires: MutableSequence[int], bits: Rows, images: Sequence[int], ticks: int,
    sine: Sequence[float], slope: Sequence[float],
) -> int:  # fmt: skip
    """Runs the machine on output images, one a tick, at most ``ticks`` of them; returns how many. It stops early after
    a tick in which a carriage left LOW .. HIGH, or a bit broke; LEFT is 1 then. STILL is 1 where the last tick changed
    nothing.
    """
    still = False
    seen = axes * motors.WIRES
    for tick in range(ticks):
        image = images[tick]
        if image != wires[seen]:
            wires[seen] = image
            for axis in range(axes):
                motors.supply(rows, axis * ROW, wires, axis * motors.WIRES, image)
        elif still:
            continue
        still = True
        left = False
        for head in range(heads):
            if resist(rows, axes, bits, FIRST + head * (HOLE + axes)):
                left = True
        for axis in range(axes):
            rows[axis * ROW + MOVED] = 0.0
            if motors.step(rows, axis * ROW, sine, slope):
                rows[axis * ROW + MOVED] = 1.0
                still = False
                if carry(rows, axis * ROW):
                    left = True
        if left:
            bits[LEFT] = 1.0
            bits[STILL] = 0.0
            return tick + 1
    bits[LEFT] = 0.0
    bits[STILL] = 1.0 if still else 0.0
    return ticks


def resist(rows: Rows, axes: int, bits: Rows, at: int) -> bool:
    """Sets the board's resistance to a head for the next tick, from where it is now; returns whether its bit broke."""
    if bits[at + MOUNTED] == 0.0:
        return False
    thrust = 0.0
    if bits[at + IN_BOARD] != 0.0:
        thrust = cut(rows, axes, bits, at)
    torque = thrust * bits[at + LEVER]
    head = int(bits[at + HEAD])
    if bits[at + INVERTED] != 0.0:
        motors.load(rows, head * ROW, 0.0, torque)
    else:
        motors.load(rows, head * ROW, torque, 0.0)
    if bits[at + BEARS] == 0.0 or bits[at + SHORT] != 0.0 or thrust <= bits[at + BEARS]:
        return False
    bits[at + BROKEN] = 1.0
    return True


def cut(rows: Rows, axes: int, bits: Rows, at: int) -> float:
    """Returns the thrust [N] that a bit in the board needs on the way down; the hole gets deeper and the bit wears."""
    off = 0.0
    for axis in range(axes):
        if rows[axis * ROW + CARRIES] == 0.0:
            away = rows[axis * ROW + PLACE] / rows[axis * ROW + SCALE] - bits[at + HOLE + axis]
            off += away * away
    if bits[at + BEGUN] == 0.0 or off > bits[at + SAME] * bits[at + SAME]:
        for axis in range(axes):
            bits[at + HOLE + axis] = rows[axis * ROW + PLACE] / rows[axis * ROW + SCALE]
        bits[at + BEGUN] = 1.0
        bits[at + BOTTOM] = bits[at + SURFACE]
    head = int(bits[at + HEAD])
    depth = rows[head * ROW + PLACE] - bits[at + SHORT]
    if depth < bits[at + BOTTOM]:
        return 0.0
    bits[at + WEAR] += (depth - bits[at + BOTTOM]) * bits[at + METRES]
    bits[at + BOTTOM] = depth
    return bits[at + THRUST] * (1.0 + bits[at + GROWTH] * bits[at + WEAR])


def carry(rows: Rows, at: int) -> bool:
    """Moves a carriage after its rotor, as far as the play of its belt; returns whether it has left LOW .. HIGH."""
    columns = (rows[at + motors.CYCLES] * TURN - rows[at + ZERO]) * rows[at + COLUMNS] / TURN
    rotor = rows[at + START] + columns * rows[at + PITCH]
    place = rows[at + PLACE]
    place = max(place, rotor - rows[at + PLAY])
    place = min(place, rotor + rows[at + PLAY])
    rows[at + PLACE] = place
    return not rows[at + motors.LOW] < place < rows[at + motors.HIGH]

"""What a tick does to one motor: currents, speed and place, on plain floats. law.py calls it for each axis.

The equations stand in coefficients.py, with the numbers that a substep multiplies with. This module and law.py are run
as they stand, or compiled from the same text (their .pxd have the C types, kernel.py chooses): the same results to the
bit.

Rule: only + - * and comparisons of floats, a floor, and one division by a whole number; no call out of the two modules.
So every statement means the same in C, without contraction.

A motor is a part of ``rows``, a flat sequence of floats; a function is told where it begins, as ``at``. Its columns:

    CURRENTS       of up to MOST windings [A], in the order of their degrees (machine/dynamics.py)
    SPEED          rad/s of the shaft
    CYCLES         electrical cycles
    SUPPLY         the currents [A] that the present image drives towards without back-EMF
    OFF, NORMAL, FORCED   what SUPPLY is for a winding that is off, on the normal supply, on the forcing one
    DECAY .. KIND  as in coefficients.Coefficients
    FORWARD, BACKWARD     rad/s that friction and load take off in a substep, by direction
    RESTING        1 where a tick more would change nothing
    BEFORE         the currents before the present tick
    STIFF, DAMP, TRIP   of a drive, as in coefficients.Coefficients
    LOW, HIGH      places of its carriage between which (neither included) nothing changes that others see; a drive
                   that trips takes them away

A drive has one winding. From CURRENTS on it keeps, behind the current, the pulses that it has COUNTed, the level of its
pulse wire as last SEEN, and 1 where it has TRIPPED. SUPPLY is NORMAL where its pulse wire is high, and the next column
where its direction wire is; FORCED is what that is on the way forward.

``wires`` has WIRES whole numbers for each motor: for each of MOST windings the bit that switches it on (0 where the
motor has fewer), then for each the bits of the forcing wires that feed it.
"""

from collections.abc import MutableSequence, Sequence

Rows = MutableSequence[float]

CURRENTS = 0
SPEED, CYCLES = 5, 6
SUPPLY = 7
OFF, NORMAL, FORCED = 12, 13, 14
DECAY, EMF, KEEP, PUSH, DETENT, STOP, GAIN, ADVANCE, SUBSTEPS = 15, 16, 17, 18, 19, 20, 21, 22, 23
LIMIT, SPACING, WINDINGS, KIND = 24, 25, 26, 27
FORWARD, BACKWARD, RESTING = 28, 29, 30
BEFORE = 31
STIFF, DAMP, TRIP = 36, 37, 38
LOW, HIGH = 39, 40
MOTOR = 41  # columns of a motor; those of its carriage follow (law.py)

MOST = 5  # windings of a motor
WIRES = 10

UNIPOLAR, RELUCTANCE, DRIVE = 0, 1, 2  # the kinds of motors
COUNT, SEEN, TRIPPED = 1, 2, 3  # of a drive, from CURRENTS on: its other state

SINES = 1024
QUARTER = 256


def unipolar(  # noqa: PLR0915  one loop over locals: most of a simulated second is spent in it
    rows: Rows, at: int, sine: Sequence[float], slope: Sequence[float]
) -> None:
    """One tick of a unipolar motor of two phases: all its substeps. ``sine`` and ``slope`` as in coefficients.py.

    A substep takes as long as the chain of operations from one place to the next. So the place is kept in entries of
    ``sine`` (a power of two: the same bits), and which entry comes next is worked out beside the chain, from the
    present speed; where that is wrong, it is worked out again.
    """
    decay = rows[at + DECAY]
    emf = rows[at + EMF]
    keep = rows[at + KEEP]
    push = rows[at + PUSH]
    detent = rows[at + DETENT]
    forward = rows[at + FORWARD]
    backward = rows[at + BACKWARD]
    advance = rows[at + ADVANCE]
    to_a = rows[at + SUPPLY]
    to_b = rows[at + SUPPLY + 1]
    to_c = rows[at + SUPPLY + 2]
    to_d = rows[at + SUPPLY + 3]
    a = rows[at + CURRENTS]
    b = rows[at + CURRENTS + 1]
    c = rows[at + CURRENTS + 2]
    d = rows[at + CURRENTS + 3]
    speed = rows[at + SPEED]
    places = SINES
    quarter = QUARTER
    cycle = 1.0 * places
    pace = advance * places
    place = rows[at + CYCLES] * places
    base = place // cycle * places
    entry = 0
    for _ in range(int(rows[at + SUBSTEPS])):
        turned = place - base
        if turned < 0.0 or turned >= cycle:
            base = place // cycle * places
            turned = place - base
        part = turned - entry
        if part < 0.0 or part >= 1.0:
            entry = int(turned)
            part = turned - entry
        sin = sine[entry] + slope[entry] * part
        cos = sine[entry + quarter] + slope[entry + quarter] * part
        entry = int(turned + pace * speed)

        back = emf * speed
        goal = to_a + back * sin
        a = goal + (a - goal) * decay
        goal = to_b - back * sin
        b = goal + (b - goal) * decay
        goal = to_c + back * cos
        c = goal + (c - goal) * decay
        goal = to_d - back * cos
        d = goal + (d - goal) * decay
        a = a if a > 0.0 else 0.0
        b = b if b > 0.0 else 0.0
        c = c if c > 0.0 else 0.0
        d = d if d > 0.0 else 0.0

        pull = (a - b) * sin + (c - d) * cos
        hold = sin * cos * (1.0 - 2.0 * sin * sin)
        speed = speed * keep - push * pull - detent * hold
        if speed > forward:
            speed -= forward
        elif speed < -backward:
            speed += backward
        else:
            speed = 0.0
        place += pace * speed
    rows[at + CURRENTS] = a
    rows[at + CURRENTS + 1] = b
    rows[at + CURRENTS + 2] = c
    rows[at + CURRENTS + 3] = d
    rows[at + SPEED] = speed
    rows[at + CYCLES] = place / cycle


def reluctance(rows: Rows, at: int, sine: Sequence[float], slope: Sequence[float]) -> None:
    """One tick of a motor of variable reluctance, its windings evenly apart. A chopper holds a current at LIMIT.

    Friction is written out as in ``unipolar``: a function of its own would cost the plain form a call a substep.
    """
    decay = rows[at + DECAY]
    emf = rows[at + EMF]
    keep = rows[at + KEEP]
    push = rows[at + PUSH]
    limit = rows[at + LIMIT]
    spacing = rows[at + SPACING]
    forward = rows[at + FORWARD]
    backward = rows[at + BACKWARD]
    advance = rows[at + ADVANCE]
    speed = rows[at + SPEED]
    cycles = rows[at + CYCLES]
    windings = int(rows[at + WINDINGS])
    for _ in range(int(rows[at + SUBSTEPS])):
        turned = cycles - cycles // 1.0
        back = emf * speed
        pull = 0.0
        for winding in range(windings):
            place = turned - winding * spacing
            if place < 0.0:
                place += 1.0
            place *= SINES
            entry = int(place)
            part = place - entry
            sin = sine[entry] + slope[entry] * part
            current = rows[at + CURRENTS + winding]
            goal = rows[at + SUPPLY + winding] + back * sin * current
            current = goal + (current - goal) * decay
            current = min(max(current, 0.0), limit)
            rows[at + CURRENTS + winding] = current
            pull += current * current * sin
        speed = speed * keep - push * pull
        if speed > forward:
            speed -= forward
        elif speed < -backward:
            speed += backward
        else:
            speed = 0.0
        cycles += advance * speed
    rows[at + SPEED] = speed
    rows[at + CYCLES] = cycles


def drive(rows: Rows, at: int) -> None:
    """One tick of a motor in its drive: a pulse moves its goal by a cycle, and current pulls it there. Farther than
    TRIP from its goal the drive trips: no current from then on, and a place without LOW .. HIGH, so that ``run`` ends.
    """
    level = rows[at + SUPPLY]
    if level > rows[at + CURRENTS + SEEN]:
        rows[at + CURRENTS + COUNT] += 1.0 if rows[at + SUPPLY + 1] == rows[at + FORCED] else -1.0
    rows[at + CURRENTS + SEEN] = level
    goal = rows[at + CURRENTS + COUNT]
    decay = rows[at + DECAY]
    emf = rows[at + EMF]
    keep = rows[at + KEEP]
    push = rows[at + PUSH]
    limit = rows[at + LIMIT]
    most = rows[at + NORMAL]
    stiff = rows[at + STIFF]
    damp = rows[at + DAMP]
    trip = rows[at + TRIP]
    forward = rows[at + FORWARD]
    backward = rows[at + BACKWARD]
    advance = rows[at + ADVANCE]
    tripped = rows[at + CURRENTS + TRIPPED]
    current = rows[at + CURRENTS]
    speed = rows[at + SPEED]
    cycles = rows[at + CYCLES]
    for _ in range(int(rows[at + SUBSTEPS])):
        behind = goal - cycles
        if behind > trip or behind < -trip:
            tripped = 1.0
        wanted = 0.0
        if tripped == 0.0:
            wanted = stiff * behind - damp * speed
            wanted = min(wanted, limit, most - emf * speed)
            wanted = max(wanted, -limit, -most - emf * speed)
        current = wanted + (current - wanted) * decay
        speed = speed * keep + push * current
        if speed > forward:
            speed -= forward
        elif speed < -backward:
            speed += backward
        else:
            speed = 0.0
        cycles += advance * speed
    if tripped != rows[at + CURRENTS + TRIPPED]:
        rows[at + LOW] = rows[at + HIGH] = 0.0
    rows[at + CURRENTS + TRIPPED] = tripped
    rows[at + CURRENTS] = current
    rows[at + SPEED] = speed
    rows[at + CYCLES] = cycles


def step(rows: Rows, at: int, sine: Sequence[float], slope: Sequence[float]) -> bool:
    """One tick of a motor on its present supply; returns False where it rests and nothing was to be done."""
    if rows[at + RESTING] != 0.0:
        return False
    for winding in range(MOST):
        rows[at + BEFORE + winding] = rows[at + CURRENTS + winding]
    speed = rows[at + SPEED]
    cycles = rows[at + CYCLES]
    if rows[at + KIND] == RELUCTANCE:
        reluctance(rows, at, sine, slope)
    elif rows[at + KIND] == DRIVE:
        drive(rows, at)
    else:
        unipolar(rows, at, sine, slope)
    moved = speed != rows[at + SPEED] or cycles != rows[at + CYCLES]
    for winding in range(MOST):
        moved = moved or rows[at + BEFORE + winding] != rows[at + CURRENTS + winding]
    rows[at + RESTING] = 0.0 if moved else 1.0
    return True


def supply(rows: Rows, at: int, wires: MutableSequence[int], first: int, image: int) -> None:
    """Sets what an output image drives the currents of an axis towards; its wires begin at ``first``."""
    for winding in range(MOST):
        if not image & wires[first + winding]:
            level = rows[at + OFF]
        elif image & wires[first + MOST + winding]:
            level = rows[at + FORCED]
        else:
            level = rows[at + NORMAL]
        if level != rows[at + SUPPLY + winding]:
            rows[at + SUPPLY + winding] = level
            rows[at + RESTING] = 0.0


def load(rows: Rows, at: int, forward_nm: float, backward_nm: float) -> None:
    """Sets the torque that resists an axis besides the table's friction, by direction."""
    forward = rows[at + STOP] + forward_nm * rows[at + GAIN]
    backward = rows[at + STOP] + backward_nm * rows[at + GAIN]
    if forward != rows[at + FORWARD] or backward != rows[at + BACKWARD]:
        rows[at + FORWARD] = forward
        rows[at + BACKWARD] = backward
        rows[at + RESTING] = 0.0

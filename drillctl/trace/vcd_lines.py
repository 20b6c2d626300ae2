"""The changes of VCD variables as text, tick by tick: the loop that is compiled (vcd_lines.pxd has the C types).

Rule: a line is written where what a variable shows changes, in the variables' order, below one time stamp a time. As
Python it gives the same bytes, but many times more slowly than vcd_pages.py. vcd_compiled.py hands it what it needs.

What a variable shows is ``(value >> SHIFT & MASK) ^ INVERT`` of its signal. It is written as the text at that place
behind FIRST of ``texts``, of which a variable has COUNT; one that has none is a number, in binary, of 32 bits, before
its text at FIRST.
"""

from collections.abc import MutableSequence, Sequence

SHIFT = 1
MASK = 2
INVERT = 3
FIRST = 4
COUNT = 5
BITS = 6
FIELDS = 7
STAMP_BYTES = 24  # at most, of a time stamp
NUMBER_BYTES = 33  # at most, of a number before its text

DONE = 0  # what WHY of the state says of the end: all is written, or the ticks of ``times`` are
FULL = 1  # ``out`` may have no room for one more tick
NO_TEXT = 2  # a variable, by its number in WHICH, has no text for what it shows

TIME = 0
WHY = 1
WHICH = 2


def stamp(out: MutableSequence[int], used: int, time: int) -> int:
    """Puts the line of a time into ``out`` from ``used`` on; returns how much of it is used then."""
    digits = 1
    power = 10
    while power <= time:
        digits += 1
        power *= 10
    out[used] = 35
    at = used + digits
    while at > used:
        out[at] = 48 + time % 10
        time //= 10
        at -= 1
    out[used + digits + 1] = 10
    return used + digits + 2


def number(out: MutableSequence[int], used: int, value: int) -> int:
    """Puts ``b`` and a value of 32 bits, without zeros before it, into ``out``, as ``stamp`` does."""
    out[used] = 98
    used += 1
    bit = 0
    half = 16
    while half:
        if value >> (bit + half):
            bit += half
        half >>= 1
    while bit >= 0:
        out[used] = 48 + (value >> bit & 1)
        used += 1
        bit -= 1
    return used


def text(out: MutableSequence[int], used: int, texts: Sequence[int], begin: int, end: int) -> int:
    """Puts some of ``texts`` into ``out``, as ``stamp`` does."""
    for at in range(begin, end):
        out[used] = texts[at]
        used += 1
    return used


def come(ticks: Sequence[int], at: Sequence[int], ends: Sequence[int], beyond: int,
         coming: MutableSequence[int]) -> int:  # fmt: skip
    """Puts the tick of each signal's next change into ``coming``, ``beyond`` where it has none; returns the least."""
    least = beyond
    for signal in range(len(at)):
        coming[signal] = ticks[at[signal]] if at[signal] < ends[signal] else beyond
        least = min(least, coming[signal])
    return least


def take(tick: int, beyond: int, ticks: Sequence[int], values: Sequence[int], at: MutableSequence[int],
         ends: Sequence[int], coming: MutableSequence[int], present: MutableSequence[int],
         changed: MutableSequence[int]) -> int:  # fmt: skip
    """Puts the values of a tick into ``present`` and passes them; of several of one signal the last counts. Returns
    the tick of the change that comes next.
    """
    least = beyond
    for signal in range(len(at)):
        changed[signal] = 0
        while coming[signal] == tick:
            changed[signal] |= present[signal] ^ values[at[signal]]
            present[signal] = values[at[signal]]
            at[signal] += 1
            coming[signal] = ticks[at[signal]] if at[signal] < ends[signal] else beyond
        least = min(least, coming[signal])
    return least


def lines(ticks: Sequence[int], values: Sequence[int], at: MutableSequence[int], ends: Sequence[int],
          coming: MutableSequence[int], present: MutableSequence[int], changed: MutableSequence[int],
          variables: Sequence[int], shown: MutableSequence[int], texts: Sequence[int], begins: Sequence[int],
          first: int, times: Sequence[int], out: MutableSequence[int], room: int,
          state: MutableSequence[int]) -> int:  # fmt: skip
    """Writes changes into ``out`` and returns how many bytes of it are used.

    ticks, values  (n,) the changes of all signals, one signal after the other: rising ticks
    at, ends  (signals,) where in them each signal's next change is, and where its last is passed
    coming, present, changed  (signals,) the tick of the next change, values, and their bits that change in a tick: all
               three are overwritten
    variables  FIELDS whole numbers a variable
    shown  (variables,) what each shows
    texts, begins  bytes of all texts, and where each begins; the last one's end behind them
    first, times  the times of the ticks from ``first`` on
    room  bytes that a tick may need
    state  TIME of the last stamp, WHY it ended, WHICH variable
    """
    used = 0
    count = len(shown)
    beyond = first + len(times)
    full = len(out) - room
    state[WHY] = DONE
    tick = come(ticks, at, ends, beyond, coming)
    while tick < beyond:
        if used > full:
            state[WHY] = FULL
            return used
        time = times[tick - first]
        tick = take(tick, beyond, ticks, values, at, ends, coming, present, changed)
        row = -FIELDS
        for variable in range(count):
            row += FIELDS
            source = variables[row]
            if not changed[source] & variables[row + BITS]:
                continue
            now = (present[source] >> variables[row + SHIFT] & variables[row + MASK]) ^ variables[row + INVERT]
            if now == shown[variable]:
                continue
            shown[variable] = now
            if time != state[TIME]:
                state[TIME] = time
                used = stamp(out, used, time)
            place = variables[row + FIRST]
            if variables[row + COUNT] == 0:
                used = number(out, used, now)
            elif 0 <= now < variables[row + COUNT]:
                place += now
            else:
                state[WHY] = NO_TEXT
                state[WHICH] = variable
                return used
            used = text(out, used, texts, begins[place], begins[place + 1])
    return used

"""A trace's output images as the messages that must reach the AVR's pins.

Rule: the image of a tick goes out a port at a time, the lowest first, and only the ports that changed; so an image
that changes two bytes is two messages in a row, and what the pins show in between is no image of the trace. What is
compared is therefore the messages: all of them, each once, in order. Used by tests/firmware alone.
"""

from itertools import pairwise

from drillctl.trace import Trace, dense

PORTS = (2, 3, 4)  # Firmata's, of a Mega: x, y, z, a byte of the image each
Update = tuple[int, int]  # Firmata port, value


def updates_of(trace: Trace) -> list[Update]:
    """A message for each byte of the output image that changed, in order."""
    found = []
    for was, word in pairwise([0, *dense(trace, "out.0").tolist()]):
        for place, port in enumerate(PORTS):
            value = word >> 8 * place & 0xFF
            if value != was >> 8 * place & 0xFF:
                found.append((port, value))
    return found


def check_seen(sent: list[Update], seen: list[Update]) -> None:
    """Low while the pins are made ready, then exactly what was sent, then low."""
    first = next(at for at, (_, value) in enumerate(seen) if value)
    assert seen[first : first + len(sent)] == sent
    after = seen[first + len(sent) :]
    assert after and not any(value for _, value in after), f"not switched off, and nothing else, at the end: {after}"

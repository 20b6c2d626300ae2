"""One INT8. Inputs are latched first and outputs flushed last, so no layer ever sees half a tick.

    latch -> gap -> requests -> guard -> current command -> every axis one count -> completion -> image -> flush

docs/SPEC.md, section 1, has the order to the letter. No container is built here, nothing grows.
"""

from drillctl.execution.clock import apply_gap
from drillctl.execution.commands import finish, start_next
from drillctl.execution.conditions import Event, occur, serve
from drillctl.execution.controller import Controller, Stage
from drillctl.execution.lifted_travel import go_once_clear
from drillctl.execution.limit_checks import guard
from drillctl.execution.motion import MOVING, SETTLES
from drillctl.execution.stops import cut_off

RUNNING, LATCHED = Stage.RUNNING.value, Stage.LATCHED.value


def tick(m: Controller) -> None:
    """One interrupt. While a job's next command is missing and all rests, it is a wake and not a tick."""
    look(m)
    m.late = m.gap
    if m.late:
        apply_gap(m)
    m.served = m.requests.take() | m.unseen
    m.unseen = 0
    if m.served:
        serve(m)
    if m.hot_until and m.tick >= m.hot_until:
        cut_off(m)
    if m.stage != LATCHED:
        guard(m)
    command_missing = False
    if not m.busy and m.stage <= RUNNING:
        command_missing = not start_next(m)
    for axis in m.axes:
        if axis.motion in SETTLES:
            axis.cool()
    if command_missing and m.job:
        m.underruns += 1
        m.unseen = m.served  # a resume is recorded in the tick to come, which serves it again without effect
        _put_out(m)  # a winding must not keep its 24 V for as long as the next command takes to come
        return
    if m.lifting:
        go_once_clear(m)
    m.running = m.command.sequence if m.busy else 0
    if m.busy and m.stage == RUNNING:
        m.elapsed += 1
    m.moving = _count(m)
    if not m.moving:
        _at_rest(m)
    _put_out(m)
    m.tick += 1


def look(m: Controller) -> None:
    """Latches the inputs. Between ticks it shows what the sensors say, and nothing acts on that."""
    m.inputs = m.port.latch()
    m.sensors = (m.inputs ^ m.polarity) & m.sensor_mask


def drop_forcing(m: Controller) -> None:
    """Puts out what is on without its forcing: the clock stands still, and windings must not keep their 24 V."""
    image = m.switched
    for axis in m.axes:
        image |= axis.hold_bits
    m.port.flush(image)


def _count(m: Controller) -> int:
    """Every axis that moves counts one interrupt. Returns how many of them still count afterwards."""
    moving = 0
    for axis in m.axes:
        if axis.motion >= MOVING:
            moving += axis.interrupt()
    return moving


def _at_rest(m: Controller) -> None:
    if m.busy and m.stage == RUNNING:
        finish(m)
    else:
        occur(m, Event.REST)


def _put_out(m: Controller) -> None:
    image = m.switched
    for axis in m.axes:
        image |= axis.bits
    m.image = image
    m.port.flush(image)

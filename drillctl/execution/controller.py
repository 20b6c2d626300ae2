"""All that a tick works on: axes, current command, sensors, the stage. Allocated once, changed in place.

Rule: this module only holds. What changes the stage, and how, is the table in conditions.py.
"""

from enum import IntEnum

from drillctl.execution.axis import Axis
from drillctl.execution.line import Line
from drillctl.kmd import Command, CommandQueue, Condition, Fault, Mailbox
from drillctl.kmd.faults import reactions_of
from drillctl.machine import Machine, ways
from drillctl.machine.head_lines import CHUCK, CONTACT, alarm_input, answering_inputs, head_input, head_output
from drillctl.machine.levels import ESTOP, FAULT, POWER_ON, SPEED_ACTUAL, SPEED_WANTED, STOP, masks_at
from drillctl.machine.parameters import Parameters
from drillctl.ports import Driver


class Stage(IntEnum):
    """What a controller is about: the stages of the table in conditions.py."""

    IDLE = 0
    ZERO_ONLY = 1
    RUNNING = 2
    HOLDING = 3
    STOPPING = 4
    FAULT_STOPPING = 5
    RETURN_STOPPING = 6
    RETURNING = 7
    LATCHED = 8


CONDITIONS = (
    Condition.READY, Condition.ZERO_ONLY, Condition.READY, Condition.HOLDING, Condition.STOPPING, Condition.STOPPING,
    Condition.STOPPING, Condition.RETURNING, Condition.LATCHED,
)  # fmt: skip
NO_LIMIT = 1 << 40  # steps
ACTIONS = ("pause", "stop", "estop")  # of an ``[[input]]``


class Controller:
    """The state of execution for one machine.

    stage     a Stage; ``condition`` is what the status record shows of it, ``job`` whether a job is on. Only ``enter``
              changes the three
    inputs    the input image as latched
    sensors   the same, 1 = reached or on, whatever the line's polarity
    estops    inputs that asked for an emergency stop in the tick before, none once it was acknowledged
    roughness by axis, the square of half a step, as a part of the square of the accuracy that a line must keep
    shared    input bits that several end sensors share; ``shared_on`` those that were on in the tick before
    reactions what this machine does on each fault
    lifting   KMD_GORA_X_Y is current, and X and Y wait until the heads are clear of the board
    zero_first  a fault has come after which only the return to zero is taken; it ends with that, or with the position
    indexes   input bits of the encoders' indexes, by axis; 0 of an axis without one
    surfaces  by axis, the place in steps in which a head's bit has touched; ``descents`` the deepest place in which it
              is looked for, ``breakage_ranges`` how much deeper than before it may touch, ``depths`` how far below it a
              hole goes, 0 where that is not entered
    watched   contacts that a stroke down looks at; ``touching`` those that were on in the tick before, ``touched`` by
              axis the place in steps of its bit's first touch in this stroke
    blamed    as a mask, the axes that the fault which is raised next is about; ``fault_axes`` those of the fault shown
    alarms    inputs of drives that had tripped in the tick before, none once that was acknowledged; of ``alarm_mask``
    contacts  the same of the inputs that say that a head's bit touches
    answered  the outputs beside the axes that inputs answer to
    homing_ways   by row of the homing table, how each of its axes goes
    homing_fault  why the current row of the homing table could not begin
    return_rows the axes of the return to zero, in the order in which they go
    switched  output bits that are no axis's: spindle and the like
    levels    by event (machine/levels.py) the bits of these that it keeps, and those that it sets
    speed_word  where the spindle's speed is put out, in rev/min; None on a machine that only switches it;
              ``actual_word`` where it is read
    speed_reached  the speed that was reached and is watched, 0 for none; ``dip_ticks`` for how long it is missed now
    stopped_by  the gravest of these events since the last acknowledgement: STOP, FAULT or ESTOP
    elapsed   ticks of the current command, hold not counted
    step      the row of the tool change that is carried out, or was last, from 1
    step_limit, step_fault  its time limit in ticks and its fault, 0 outside a step
    underruns wakes in which a job's next command was missing
    running   sequence of the command that was current in this tick, 0 = none
    served    the requests served in this tick, as bits; unseen: the same of a wake that was no tick
    tick_hz   ticks a second, for what is limited in seconds; set_rate changes it
    hot_until the tick in which what was switched on by hand and would burn a winding goes off (stops.py), 0 for none
    cut_off   1: that has happened, and no output was set since
    gap       whole periods by which the next tick begins too late, set by whoever paces; late: the same, applied
    caught    the last gap stopped an axis that was too fast to be stopped without losing steps
    """

    def __init__(self, machine: Machine, queue: CommandQueue, requests: Mailbox, port: Driver):
        self.machine = machine
        self.queue = queue
        self.requests = requests
        self.port = port
        self.axes = tuple(
            Axis(table, _limits(machine, index), machine.reach(index)) for index, table in enumerate(machine.axes)
        )
        self.drill_axes = tuple(self.axes[index] for index in machine.drill_axes)
        self.head_mask = sum(1 << index for index in machine.drill_axes)
        others = tuple(axis for axis in self.axes if axis not in self.drill_axes)
        self.return_rows = (self.drill_axes, others)
        self.line = Line(self.axes)
        self.polarity = sum(1 << line.bit for line in machine.input_lines if line.active_level == 0)
        self.sensor_mask = sum(1 << line.bit for line in machine.input_lines)
        self.sensor_mask |= sum(word.mask for word in machine.input_words)
        self.pause_mask, self.stop_mask, self.estop_mask = (_asking(machine, what) for what in ACTIONS)
        self.action_mask = self.pause_mask | self.stop_mask | self.estop_mask
        self.shared = sum({1 << sensor.bit for sensor in machine.sensors if sensor.line})
        self.pairs = tuple(filter(None, (_pair(axis, self.shared) for axis in self.axes)))
        chosen = ((row.fault, row.do, row.position_kept) for row in machine.reactions)
        self.reactions = reactions_of(machine.emergency_stop, chosen)
        self.only_zero_after = frozenset(Fault[name] for name in machine.only_zero_after)
        self.roughness = _roughness(machine)
        self.output_mask = sum(1 << bit for _, bit in machine.outputs)
        self.spindle_mask = sum(1 << bit for name, bit in machine.outputs if name == "spindle")
        self.spindle = machine.spindle
        self.speed_word, self.actual_word = machine.output_word(SPEED_WANTED), machine.input_word(SPEED_ACTUAL)
        self.levels = tuple(masks_at(machine.levels, event) for event in (POWER_ON, STOP, FAULT, ESTOP))
        numbers = range(len(machine.axes))
        self.indexes, self.contacts, self.alarm_bits = (
            tuple(bit_of(machine, axis) for axis in numbers) for bit_of in (_index_bit, _contact_bit, _alarm_bit)
        )
        self.descents, self.breakage_ranges, self.depths = _detection(machine)
        self.alarm_mask = sum(self.alarm_bits)
        self._forget_findings()
        self.answered = _answered(machine)
        self.homes_by_sensor = machine.homes_by_sensor
        self.set_rate(machine.tick_hz)

        self.command = Command()
        self.enter(Stage.IDLE)
        self.busy = False
        self.elapsed = self.time_limit = 0
        self.homing_row = self.homing_fault = self.return_row = 0
        self.step = self.step_limit = self.step_fault = 0

        self.tick = self.underruns = self.moving = self.running = self.served = self.gap = self.late = 0
        self.unseen = self.hot_until = self.cut_off = 0
        self.inputs = self.sensors = self.estops = self.shared_on = 0
        self.image = self.switched = machine.switched_at(POWER_ON)
        self.stopped_by = STOP

        self.epoch = 0
        self.fault = self.fault_axes = self.blamed = 0
        self.fault_kept = self.caught = self.zero_first = self.lifting = False
        self.position_known = False

        self.done = self.hole_begun = self.holes_done = self.tool = 0

    def _forget_findings(self) -> None:
        """No speed has been reached yet, no drive has tripped, and no bit has touched."""
        self.speed_reached = self.dip_ticks = self.alarms = 0
        self.surfaces: dict[int, int] = {}
        self.watched = self.touching = 0
        self.touched: dict[int, int] = {}

    def enter(self, stage: Stage) -> None:
        """Goes to this stage, and keeps condition and job in step with it."""
        self.stage: int = stage.value
        self.condition: int = CONDITIONS[stage]
        self.job = stage in (Stage.RUNNING, Stage.HOLDING)

    @property
    def safe_image(self) -> int:
        """What makes the outputs safe now: those beside the axes at their levels for an emergency stop."""
        kept, on = self.levels[ESTOP]
        return self.switched & kept | on

    def set_rate(self, tick_hz: int) -> None:
        """Sets the ticks a second; what is limited in seconds keeps its seconds."""
        self.tick_hz = tick_hz
        self.longest_drilling = self.machine.drilling_ticks_at(tick_hz)
        self.homing_ways = ways(self.machine, tick_hz)
        if self.spindle is not None:
            self.reach_ticks = round(self.spindle.reached_s * tick_hz)
            self.most_dip_ticks = round(self.spindle.dip_s * tick_hz)


def _asking(machine: Machine, action: str) -> int:
    """Input bits that ask for an action."""
    return sum(1 << line.bit for line in machine.inputs if line.action == action)


def _index_bit(machine: Machine, axis: int) -> int:
    """The input bit of the index of an axis's encoder, 0 where it has none."""
    index = machine.index_of(axis)
    return 0 if index is None else 1 << index.bit


def _detection(machine: Machine) -> tuple[tuple[int, ...], tuple[int, ...], tuple[int, ...]]:
    """The detection descent and the breakage range of each axis in steps, more than any travel where it has none; and
    the depth below a surface that was found, 0 where it has none.
    """
    known = machine.parameters or Parameters()
    range_mm = known.number("machining", "breakage_range_mm")
    depth_mm = known.number("system", "depth_detection_depth_mm")
    found = []
    for table in machine.axes:
        descent_mm = known.of_axis(table.name).number("depth_detection_descent_mm")
        lengths = ((descent_mm, NO_LIMIT), (range_mm, NO_LIMIT), (depth_mm, 0))
        found.append(tuple(none if mm is None else round(mm * table.steps_per_mm) for mm, none in lengths))
    descents, ranges, depths = zip(*found, strict=True)
    return descents, ranges, depths


def _alarm_bit(machine: Machine, axis: int) -> int:
    """The input bit that is on where the drive of an axis has tripped, 0 of an axis without one."""
    line = alarm_input(machine, machine.axes[axis].name)
    return 0 if line is None else 1 << line.bit


def _answered(machine: Machine) -> int:
    """The output bits that inputs answer to: those of the chucks, and of what has a switch of its own."""
    bits = sum({head_output(machine, CHUCK, head) for head in machine.drill_axes})
    for _, outputs, _ in answering_inputs(machine):
        bits |= outputs
    return bits


def _contact_bit(machine: Machine, axis: int) -> int:
    """The input bit that is on while the bit of a head touches the board, 0 of an axis without one."""
    line = head_input(machine, CONTACT, axis)
    return 0 if line is None else 1 << line.bit


def _pair(axis: Axis, shared: int) -> int:
    """The bits of an axis's two end sensors, which contradict each other when both are on; 0 where there are not two,
    or one of them answers for others too.
    """
    far, near = axis.limits[1], axis.limits[-1]
    return far | near if far and near and not (far | near) & shared else 0


def _limits(machine: Machine, axis: int) -> tuple[int, int, int]:
    """Input bits of an axis's end sensors, indexed by direction: 1 for the far end, -1 for the near one."""
    ends = (machine.sensor_at(axis, end) for end in ("max", "min"))
    far, near = (1 << sensor.bit if sensor else 0 for sensor in ends)
    return (0, far, near)


def _roughness(machine: Machine) -> tuple[float, ...]:
    """By axis, how much of what a line may be off a follower's half steps use up; 0 where no accuracy is set."""
    allowed = machine.parameters and machine.parameters.number("system", "interpolation_accuracy_mm")
    return tuple((0.5 / axis.steps_per_mm / allowed) ** 2 if allowed else 0.0 for axis in machine.axes)

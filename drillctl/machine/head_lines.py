"""The inputs and outputs that a drilling head or an axis has of its own, by name: ``tool_1`` is the first head's.

    chuck_N    output: its chuck is open where it is 1
    tool_N     input: a tool is in its chuck
    contact_N  input: its bit touches the board
    chuck_open_N  input: its chuck is open
    foot_up    input: the presser foot, which the output presser_foot puts down, is all the way up
    xy_in_place  input: the drives of X and Y say that their motors stand where the pulses have sent them
    AXIS_alarm  input: the drive of that axis has tripped
"""

from drillctl.machine.model import Input, Machine

CHUCK, TOOL, CONTACT, OPEN = "chuck", "tool", "contact", "chuck_open"
FOOT, FOOT_UP, IN_PLACE = "presser_foot", "foot_up", "xy_in_place"


def head_input(machine: Machine, kind: str, axis: int) -> Input | None:
    """Returns the input of this kind of a drilling head, or None where it has none."""
    return next((line for line in machine.inputs if line.name == _name(machine, kind, axis)), None)


def alarm_input(machine: Machine, axis_name: str) -> Input | None:
    """Returns the input that says that an axis's drive has tripped, or None where the machine has none."""
    return next((line for line in machine.inputs if line.name == f"{axis_name}_alarm"), None)


def head_output(machine: Machine, kind: str, axis: int) -> int:
    """Returns the bit of a drilling head's output of this kind in the output image, 0 where it has none."""
    return sum(1 << bit for name, bit in machine.outputs if name == _name(machine, kind, axis))


def answering_inputs(machine: Machine) -> list[tuple[str, int, int]]:
    """Returns the inputs that a machine has of those that answer to outputs: name, the outputs as a mask of the output
    image (0: to none, it is always on), and the level of these at which it is on.
    """
    foot = sum(1 << bit for name, bit in machine.outputs if name == FOOT)
    found = [(FOOT_UP, foot, 0), (IN_PLACE, 0, 1)]
    found += [(_name(machine, OPEN, head), head_output(machine, CHUCK, head), 1) for head in machine.drill_axes]
    names = {line.name for line in machine.inputs}
    return [answer for answer in found if answer[0] in names]


def _name(machine: Machine, kind: str, axis: int) -> str:
    number = machine.drill_axes.index(axis) + 1 if axis in machine.drill_axes else 0
    return f"{kind}_{number}"

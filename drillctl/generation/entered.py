"""The gate before a board's program: on a machine with parameters all of them must be entered.

Rule: read from the machine alone. A queue of commands written by hand needs no parameters and does not come here.
"""

from drillctl.generation.errors import JobError
from drillctl.language import Message
from drillctl.machine import Machine

POSITIONING = ("x", "y")  # the axes without which no hole is come to


def check_entered(machine: Machine) -> None:
    """Raises JobError with a line for each parameter that is unset, and for X or Y where they are not in use. A machine
    without parameters passes.
    """
    parameters = machine.parameters
    if parameters is None:
        return
    problems = [
        Message("parameter {name} is unset; it must be entered first", name=name) for name in parameters.missing()
    ]
    if not problems:
        unused = [axis for axis in POSITIONING if not parameters.in_use(axis)]
        problems = [
            Message("axis {axis} is not installed or not enabled; no hole can be reached", axis=axis) for axis in unused
        ]
    if problems:
        raise JobError(*(problem.at(machine.file) for problem in problems))

"""``drillctl latency``: how punctual ticks are on this computer, whose fault it is when not, and what that is good for.

Nothing is driven: a machine on the simulated card, idle or moving, is ticked in a process of its own, as a job is.
"""

import argparse

from drillctl.cli import options, streams
from drillctl.jobs.interrupts import caught, exit_code
from drillctl.language import Message, json_text

LONGEST_S = 3600
FASTEST_HZ = 20_000


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("latency", help="measure how punctual ticks are here", description=__doc__)
    verb.add_argument("--machine", default=options.DEFAULT_MACHINE, metavar="NAME|FILE", help="default: %(default)s")
    options.add_tables(verb)
    verb.add_argument("--hz", type=options.up_to(FASTEST_HZ), metavar="N", help="tick rate; default: the machine's own")
    verb.add_argument(
        "--seconds", type=options.up_to(LONGEST_S), default=10, metavar="S", help="duration; default: %(default)s"
    )
    verb.add_argument("--moving", action="store_true", help="move all axes all the time; else the machine is idle")
    verb.add_argument("--json", action="store_true", help="print one JSON object")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Measures and prints the report; Ctrl-C ends it early, with what was measured until then (exit 130)."""
    from drillctl.generation.queues import there_and_back
    from drillctl.lab.latency import LatencyError, a_moment, measure
    from drillctl.ui.terminal.reports import latency_lines

    machine = options.library(arguments).machine(arguments.machine)
    if arguments.hz is None and machine.tick_hz > FASTEST_HZ:
        reason = Message("{name} ticks at {hz} Hz, and at most {most} can be measured; choose a rate with --hz",
                         name=machine.name, hz=machine.tick_hz, most=FASTEST_HZ)  # fmt: skip
        raise LatencyError(reason)
    machine = machine.at_rate(arguments.hz or machine.tick_hz)
    moves = there_and_back(machine) if arguments.moving else None
    signals: list[int] = []
    with caught(lambda number, frame: signals.append(number)):
        try:
            report = measure(machine, arguments.seconds, lambda: a_moment() or bool(signals), moves)
        except LatencyError:
            if signals:
                return exit_code(signals[0])
            raise
    text = json_text(report.as_dict(), 2) if arguments.json else "\n".join(latency_lines(report))
    return streams.delivered(exit_code(signals[0]) if signals else 0, text + "\n")

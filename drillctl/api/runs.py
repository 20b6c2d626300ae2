"""Runs a job for another program: on the simulated machine, as fast as it goes."""

import signal
from collections.abc import Mapping
from math import inf
from typing import Any

from drillctl.api.arguments import Whole, decimals, named, number, whole
from drillctl.api.jobs import MachineGiven, Source, job
from drillctl.api.machines import DEFAULT
from drillctl.api.result import Run
from drillctl.jobs.session import Session
from drillctl.language import Message, Refusal
from drillctl.plant import PlantChoice
from drillctl.plant.choice import GREATEST_SEED
from drillctl.ticker.launch import RunSettings, in_batches
from drillctl.trace.files import MOST_CARDS
from drillctl.viewmodel.records import Progress

PLANTS = ("ideal", "dynamic")


def run(
    source: Source,
    machine: MachineGiven = DEFAULT,
    *,
    plant: str = "ideal",
    faults: Mapping[str, float] | None = None,
    seed: Whole = 0,
    tick_hz: Whole | None = None,
    trace: bool = True,
    **options: Any,
) -> Run:
    """Runs a job from the machine's start position to its end, and returns what happened.

    source, machine, options  as of ``job``
    plant    ``"ideal"``: a rotor follows its columns; ``"dynamic"``: motors with inertia, which lose steps, see
             docs/PLANT.md
    faults   of the dynamic plant, by name: ``{"blunt": 20, "loose.x": 0.4}``
    seed     of the dynamic plant's scatter, 0 to 2**31 - 1
    tick_hz  interrupt frequency in Hz in place of the machine's own
    trace    False keeps no record of the ticks: only outcome and holes; takes less memory

    A fault of the machine is no error: ``Run.fault`` has it. Raises Refused for what can't be run at all, as is a run
    of more than 100,000,000 ticks (3,000,000 on the dynamic plant) with its record. Ctrl-C brings the machine to a
    stop first.

    >>> import drillctl
    >>> moved = drillctl.run(["KMD_GOTOdXdY 30 0", "KMD_GOTOdXdY 0 -10"])
    >>> moved.positions("x")[[0, -1]].tolist(), moved.fault
    ([0, 30], None)
    """
    if plant not in PLANTS:
        raise Refusal(Message("no plant {plant!r}; there are {plants}", plant=plant, plants=", ".join(PLANTS)))
    made = job(source, machine, tick_hz=tick_hz, **options)
    choice = PlantChoice(plant, _written({} if faults is None else faults), whole(seed, "seed", 0, GREATEST_SEED))
    running = RunSettings(traced=trace, plant=choice)
    taped = trace and in_batches(running) and made.machine.cards <= MOST_CARDS
    running = RunSettings(traced=trace, plant=choice, taped=taped)
    done = Run(made, choice, Session(made, running).run(_unwatched))
    if done.result.signal is not None:
        signal.raise_signal(done.result.signal)  # the machine stands: now the caller's own handler has it
    return done


def _written(faults: object) -> tuple[str, ...]:
    """The faults as texts, sorted by name."""
    values = {name: number(value, name, -inf, inf) for name, value in named(faults, "faults").items()}
    return tuple(f"{name}={decimals(value)}" for name, value in sorted(values.items()))


def _unwatched(progress: Progress) -> None:
    """Nobody looks at the progress."""

"""Where a job runs (port, pace, plant), as its journal names it, and whether a resumed run is at the same site.

Rule: a job goes on where it ran; on another port, at another pace or with another plant only where a person said so.
"""

import os
from dataclasses import dataclass

from msgspec.structs import replace

from drillctl.language import Message
from drillctl.plant import IDEAL_PLANT, PlantChoice, PlantRefused
from drillctl.plant.choice import DYNAMIC, NONE
from drillctl.portio.registry import select
from drillctl.ports import PortRefused
from drillctl.ticker.launch import RunSettings, files_of, pace_of
from drillctl.viewmodel.jobs import Site


@dataclass(frozen=True)
class SiteOptions:
    """What the command line says of the site of a resumed run; None: as the job ran."""

    port: str | None = None
    pace: str | None = None
    plant: PlantChoice | None = None


def site_of(running: RunSettings) -> Site:
    """The site of a run. Raises PortRefused for a port or a pace that can't be had."""
    port, pace = _whole(running.port), pace_of(running)
    converter = "" if running.converter is None else running.converter.text
    if select(port)[0].real:
        return Site(port, pace, NONE, converter=converter)
    choice = running.plant
    seed = choice.seed if choice.kind == DYNAMIC else 0
    return Site(port, pace, " ".join((choice.kind, *sorted(choice.faults))), seed, converter)


def running_at(site: Site, options: SiteOptions) -> RunSettings:
    """The settings of a run at this site, changed by the options. On another port pace and plant are that port's own,
    unless the options name them too. Raises PortRefused.
    """
    port = site.port if options.port is None else _whole(options.port)
    same = port == site.port
    real = select(port)[0].real
    plant = options.plant or (IDEAL_PLANT if real else _plant_at(site))
    return RunSettings(port, options.pace or (site.pace if same else None), plant=plant)


def moved(ran: Site, here: Site) -> Message | None:
    """A sentence that says in what the two sites differ; None where they are the same. The converter may be another:
    its device has another name whenever it is plugged in.
    """
    if replace(ran, converter=here.converter) == here:
        return None
    if ran.real and not here.real:
        return Message(
            "the job ran with {ran}; what {here} drills is simulated, and would count as drilled",
            ran=ran.message,
            here=here.message,
        )
    return Message("the job ran with {ran}, and not with {here}", ran=ran.message, here=here.message)


def _whole(spec: str) -> str:
    """A port ``NAME[:ADDRESS]`` with its address absolute, where that is a file. Raises PortRefused."""
    files = files_of(spec)
    return f"{spec.partition(':')[0]}:{os.path.abspath(files[0])}" if files else spec


def _plant_at(site: Site) -> PlantChoice:
    try:
        return PlantChoice.of_header(site.plant, str(site.seed))
    except PlantRefused as error:
        raise PortRefused(site.port, error.message) from error

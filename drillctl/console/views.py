"""Status record, machine and board as the records that screens draw (viewmodel/console.py)."""

from functools import lru_cache
from pathlib import Path

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from drillctl.files.inputs import real_path
from drillctl.generation.job import Job, names_of
from drillctl.kmd import Condition, to_text
from drillctl.machine import AxisTable, Library, Machine, TableError
from drillctl.machine.settings import Setting
from drillctl.plant import PlantChoice
from drillctl.plant.choice import IDEAL
from drillctl.ticker.link import Link
from drillctl.viewmodel.console import AxisView, BoardView, MachineView, ToolView
from drillctl.viewmodel.fault_texts import axes_blamed, fault_report
from drillctl.viewmodel.records import Estimate
from drillctl.viewmodel.tables import FieldView

CONDITIONS = {
    Condition.READY: "ready",
    Condition.HOLDING: "holding",
    Condition.STOPPING: "stopping",
    Condition.RETURNING: "returning",
    Condition.LATCHED: "latched",
    Condition.ZERO_ONLY: "zero_only",
}

FOLLOWING = 3  # commands that are shown behind the one in execution


def machine_list(library: Library) -> list[tuple[str, str]]:
    """Name and description of every machine, or why it can't be loaded."""
    found = []
    for name in library.machine_names():
        try:
            found.append((name, library.machine(name).description))
        except TableError as error:
            found.append((name, str(error)))
    return found


def machine_view(
    machine: Machine, port: str, link: Link, status: np.void, program: NDArray[np.void] | None, done_before: int,
    base_steps: list[int],
) -> MachineView:  # fmt: skip
    """The machine as ``status`` has it. ``program``: the one that runs, with the commands done before it began."""
    condition = CONDITIONS[Condition(int(status["condition"]))]
    moving = bool(status["moving"])
    image = int(status["image"])
    commands = iter(_command_texts(machine, status, program, done_before))
    code = link.lost() or int(status["fault"])
    blamed = axes_blamed(int(status["fault_axes"]), machine.axis_names)
    view = MachineView(
        machine=machine.name,
        port=port,
        tick=int(status["tick"]),
        tick_hz=machine.tick_hz,
        condition="held" if condition == "holding" and not moving else condition,
        moving=moving,
        position_known=bool(status["position_known"]),
        command=next(commands, ""),
        following=tuple(commands),
        queued=int(status["queued"]),
        tool=int(status["tool"]),
        change_step=int(status["step"]),
        axes=tuple(
            _axis_view(axis, i, status, image, base_steps[i], link.measured) for i, axis in enumerate(machine.axes)
        ),
        sensors=tuple((s.name, bool(int(status["sensors"]) >> s.bit & 1)) for s in machine.input_lines),
        outputs=tuple((name, bool(image >> bit & 1)) for name, bit in machine.outputs),
        words=_words(machine, image, int(status["sensors"])),
        lost_steps=tuple(status["lost"].tolist()[: len(machine.axes)]) if link.measured else None,
        late=int(status["late"]),
        late_worst_ms=int(status["late_worst_ns"]) / 1e6,
        fault=fault_report(code, bool(status["fault_kept"]), blamed) if code else None,
        notices=tuple(link.notices()),
        hot_s=int(status["hot_ticks"]) / machine.tick_hz,
        cut_off=bool(status["cut_off"]),
        pace=int(status["pace_percent"]) / 100,
        paused=link.gate.paused,
        production=machine.parameters is not None,
    )
    return _without_ticker(view) if link.lost() else view


def _words(machine: Machine, image: int, sensors: int) -> tuple[tuple[str, int], ...]:
    shown = [(word.name, word.value(image)) for word in machine.output_words]
    return (*shown, *((word.name, word.value(sensors)) for word in machine.input_words))


def with_changes(view: MachineView, **changes: object) -> MachineView:
    """The same view with other values for some of its fields."""
    return replace(view, **changes)


def plant_in_words(plant: PlantChoice) -> str:
    """``dynamic blunt=20``; empty for the ideal plant, and for a real machine."""
    return "" if plant.kind == IDEAL else str(plant)


def _without_ticker(view: MachineView) -> MachineView:
    """Corrects what a ticker wrote before it was lost: the guard has switched the outputs off since."""
    return replace(view, condition="latched", moving=False, position_known=False, command="", following=(), queued=0)


def _axis_view(
    axis: AxisTable, index: int, status: np.void, image: int, base_steps: int, measured: bool
) -> AxisView:  # fmt: skip
    position, target = int(status["position"][index]), int(status["target"][index])
    wires = tuple(
        (wire.name, _row(wire.forward, wire.forcing), bool(image >> bit & 1))
        for wire, bit in zip(axis.phase.wires, axis.wire_bits, strict=True)
    )
    return AxisView(
        name=axis.name,
        position_steps=position,
        position_mm=(position - base_steps) / axis.steps_per_mm,
        target_steps=target,
        target_mm=(target - base_steps) / axis.steps_per_mm,
        state=int(status["state"][index]),
        top_state=axis.ramp.top,
        column=int(status["column"][index]),
        wires=wires,
        steps_per_mm=axis.steps_per_mm,
        behind_steps=int(status["behind"][index]) / 1000 if measured else None,
    )


@lru_cache(256)  # the wires of a machine: a view is made at every beat of the screen
def _row(columns: tuple[bool, ...], forcing: bool) -> str:
    """A row of a phase table as the screens have it."""
    return "".join("." if not on else "X" if forcing else "x" for on in columns)


def _command_texts(machine: Machine, status: np.void, program: NDArray[np.void] | None, done_before: int) -> list[str]:
    """The command in execution and the FOLLOWING ones of the program; none where nothing is executed."""
    row = int(status["sequence"]) - done_before - 1
    if program is None or not status["sequence"] or not 0 <= row < len(program):
        return []
    names = names_of(machine)
    return [to_text(record, names) for record in program[row : row + 1 + FOLLOWING]]


def board_view(file: Path, job: Job, estimate: Estimate, fmt: str | None, after_end: str) -> BoardView:
    """A planned job with a board; ``file`` is read once more for what it says of its format."""
    from drillctl.generation.drillfile import read

    drill_file = read(file, fmt=fmt, after_end=after_end)
    work = job.work
    assert work is not None
    x, y = (job.machine.axis_names.index(name) for name in ("x", "y"))
    scale = np.array([job.machine.axes[x].steps_per_mm, job.machine.axes[y].steps_per_mm])
    tool = np.concatenate([np.full(group.stop - group.start, i) for i, group in enumerate(work.groups)])
    return BoardView(
        name=file.name,
        file=str(real_path(file)),
        xy_mm=work.steps / scale,
        file_xy_mm=work.hits.xy_mm,
        tool=tool.astype(np.int64),
        tools=tuple(ToolView(g.number, g.diameter_mm, g.stop - g.start) for g in work.groups),
        format=drill_file.format.message,
        dialect=drill_file.format.dialect,
        confidence=drill_file.confidence,
        reason=drill_file.reason,
        runner_up=drill_file.runner_up.message if drill_file.runner_up else None,
        warnings=job.warnings,
        estimate=estimate,
    )


def field_view(setting: Setting, choices: tuple[str, ...]) -> FieldView:
    """A field of the configuration as the screen shows it; ``choices``: the values that it can have, if few."""
    return FieldView(setting.place, setting.axis, _shown(setting), choices, _bounds(setting), setting.locked)


def _shown(setting: Setting) -> str:
    """A card's address in hexadecimal, as its switches are set; 18.0 s as 18."""
    if setting.place[-1] == "card_address":
        return f"0x{setting.value:X}"
    return str(setting.value).removesuffix(".0") if setting.kind is float else str(setting.value)


def _bounds(setting: Setting) -> str:
    if setting.kind is str:
        return ""
    low = f">{setting.above:g}" if setting.above is not None else f"{setting.least:.0f}"
    return f"{low}..{setting.greatest:.0f}"

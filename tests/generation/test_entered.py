"""The gate before a board's program: a machine whose parameters are not all entered drills no board."""

from dataclasses import replace
from pathlib import Path

import pytest

from drillctl.generation.errors import JobError
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.machine import Library, Machine, ParameterRow, Parameters, shipped_tables

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
EIGHT = Library((shipped_tables(),)).machine("eight-axis")
SETUP = JobSetup(machine="eight-axis")


def without(row: ParameterRow, *names: str) -> ParameterRow:
    return ParameterRow(tuple(pair for pair in row.values if pair[0] not in names))


def eight(parameters: Parameters | None) -> Machine:
    return replace(EIGHT, parameters=parameters)


def test_start_is_refused_naming_each_parameter_that_is_unset() -> None:
    assert EIGHT.parameters is not None
    bare = replace(
        EIGHT.parameters,
        system=without(EIGHT.parameters.system, "parking_x_mm"),
        axes=tuple((name, without(row, "s_share") if name == "z2" else row) for name, row in EIGHT.parameters.axes),
    )
    with pytest.raises(JobError) as refused:
        load_job(EXAMPLES / "relay.drl", eight(bare), SETUP)
    assert refused.value.kind == "job"
    named = [str(message) for message in refused.value.messages]
    assert named == [
        f"{EIGHT.file}: parameter {name} is unset; it must be entered first"
        for name in ("axis.z2.s_share", "system.parking_x_mm")
    ]


def test_a_board_needs_x_and_y_in_use() -> None:
    assert EIGHT.parameters is not None
    off = tuple(
        (name, ParameterRow((("installed", True), ("enabled", False))) if name == "y" else row)
        for name, row in EIGHT.parameters.axes
    )
    with pytest.raises(JobError, match="axis y is not installed or not enabled"):
        load_job(EXAMPLES / "relay.drl", eight(replace(EIGHT.parameters, axes=off)), SETUP)


def test_a_queue_and_a_machine_without_parameters_are_not_asked() -> None:
    assert load_job(EXAMPLES / "short-moves.kmd", eight(Parameters()), SETUP).program.size
    assert load_job(EXAMPLES / "relay.drl", eight(None), SETUP).program.size

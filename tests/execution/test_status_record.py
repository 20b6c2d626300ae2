"""The status record: every field says what the controller has, and the ticker's own fields stay as they were."""

import numpy as np
import pytest

from drillctl.execution.between_ticks import CLOCK, JOB, TWO_CARDS, WIRES, report
from drillctl.generation.job import names_of
from drillctl.kmd import STATUS, parse_program
from drillctl.machine import Library, shipped_tables
from drillctl.ticker.ticker import Ticker

OF_TICKER = ("late", "late_worst_ns", "pace_percent", "lost", "behind")
BY_AXIS = {"position": "position", "target": "target", "base": "base", "steps": "made", "state": "state"}
SUMS = ("sequence", "opcode", "hot_ticks", "queued", "column", "sensors", "image", *BY_AXIS)


@pytest.mark.parametrize("name", ["pcb-drill", "eight-axis"])
def test_each_field_is_the_controllers(name: str) -> None:
    machine = Library((shipped_tables(),)).machine(name)
    ticker = Ticker.simulated(machine)
    ticker.queue.put(parse_program("KMD_RUCHd x=40 y=-30\nKMD_RUCHd y=7\n", names_of(machine)))
    record = np.full(1, 0, STATUS)
    for field in OF_TICKER:
        record[field] = 77
    m, status = ticker.controller, record[0]
    for _ in range(8):
        ticker.run(29)
        report(m, record.view(np.uint8).data)
        for field in {*CLOCK, *JOB, *WIRES} - {*SUMS}:
            assert status[field] == getattr(m, field), field
        for field, slot in BY_AXIS.items():
            assert status[field].tolist()[: len(m.axes)] == [getattr(axis, slot) for axis in m.axes], field
        assert status["column"].tolist()[: len(m.axes)] == [axis.column + 1 for axis in m.axes]
        assert (status["sensors"], status["image"]) == (m.sensors & TWO_CARDS, m.image & TWO_CARDS)
        assert status["sequence"] == (m.command.sequence if m.busy else 0) and status["queued"] == len(m.queue)
        assert status["opcode"] == (m.command.opcode if m.busy else 0)
        assert all((status[field] == 77).all() for field in OF_TICKER)


def test_the_pieces_and_the_tickers_fields_are_the_whole_record() -> None:
    assert {*CLOCK, *JOB, *WIRES, *OF_TICKER} == set(STATUS.names or ())

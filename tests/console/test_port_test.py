"""The test of a port: who answers, which pins, what rate, what the sensors say; and nothing has moved."""

from pathlib import Path

import pytest

from drillctl.console.port import look_at_port
from drillctl.machine import Library, shipped_tables
from drillctl.portio import firmata, firmata_line
from drillctl.portio.registry import CARD_PORTS, PORTS, port_of_card
from tests.portio.firmata_stand_in import Faults, StandIn

MACHINE = Library((shipped_tables(),)).machine("mega-28byj48")


@pytest.fixture(autouse=True)
def _impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(firmata.open_firmata, "__defaults__", (0.05,))
    for name in ("GREETING_S", "ASK_AGAIN_S", "ANSWER_S"):
        monkeypatch.setattr(firmata_line, name, 0.2)


def test_a_board_that_answers_is_told_of_and_given_back() -> None:
    board = StandIn()
    try:
        reached = MACHINE.sensors[0]
        port, bit = (5, 7)[reached.bit // 8], reached.bit % 8
        board.board.outside[port] &= ~(1 << bit)  # a switch closes to ground
        report = look_at_port(MACHINE, f"firmata:{board.device}")
        assert report.problem is None
        facts = "\n".join(report.facts)
        assert "StandIn 2.5 answers" in facts and "outputs: D16 D17" in facts and "inputs with pull-up: D40" in facts
        assert f"the machine wants {MACHINE.tick_hz} Hz" in facts and "carries up to" in facts
        told = dict(report.inputs)
        assert told.keys() == {sensor.name for sensor in MACHINE.sensors}
        assert told[reached.name] == (reached.active_level == 0)
        assert not any(board.board.output(pin) for pin in range(16, 40)), "nothing was switched on"
        assert look_at_port(MACHINE, f"firmata:{board.device}").problem is None, "the line was given back"
    finally:
        board.vanish()


@pytest.mark.parametrize(
    ("faults", "reason"),
    [(Faults(version=(2, 2)), "too old; upload"), (Faults(speaks=False), "upload StandardFirmata")],
)
def test_a_board_that_will_not_do_is_told_with_its_remedy(faults: Faults, reason: str) -> None:
    board = StandIn(faults)
    try:
        report = look_at_port(MACHINE, f"firmata:{board.device}")
        assert reason in report.problem and board.device in report.problem and report.inputs == ()
    finally:
        board.vanish()


def test_a_rate_that_the_line_cannot_carry_is_told() -> None:
    report = look_at_port(MACHINE.at_rate(50_000), "firmata:/dev/no-such-line")
    assert "50000 interrupts a second are too many" in report.problem and "--tick-hz" in report.problem


@pytest.mark.parametrize("spec", ["nonsense", "gpio:/no/such/map", "firmata:/dev/no-such-line@7"])
def test_what_is_no_port_is_told(spec: str, tmp_path: Path) -> None:
    assert look_at_port(MACHINE, spec).problem


def test_each_card_of_the_table_has_a_real_port_and_a_port_may_stand_in_its_place() -> None:
    assert all(PORTS[port].real for port in CARD_PORTS.values())
    assert port_of_card("firmata:/dev/ttyACM0@115200") == "firmata:/dev/ttyACM0@115200"
    assert port_of_card("simulated") == port_of_card("mapped:F") == port_of_card("8255-B") == ""

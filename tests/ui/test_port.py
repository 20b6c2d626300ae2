"""The Port screen: what is in use and what is configured, a test's report, and no real machine without a yes."""

from dataclasses import dataclass, field

import pytest
from msgspec.structs import replace

from drillctl.language import Message
from drillctl.ui.screens.port import PortScreen
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.signals import PortReport, PortView, PortWord
from tests.ui.editor_fakes import Shell, press, text_of
from tests.ui.fake_console import VIEW, FakeConsole, Program

PORT = PortView("simulated", False, "REAL", "MEGA", "firmata", False)
OUTPUTS = "outputs: " + " ".join(f"D{n}" for n in range(16, 40))
GOOD = PortReport("firmata", ("StandIn 2.5 answers", OUTPUTS), (("x_min", True), ("x_max", False)))
BAD = PortReport("firmata", problem="firmata: no Firmata answers; upload StandardFirmata, and check the baud rate")


@dataclass
class Ports:
    """A PortControl."""

    view: PortView = PORT
    report: PortReport = GOOD
    answer: Problems = ()
    done: list[str] = field(default_factory=list)

    def port(self) -> PortView:
        return self.view

    def ports(self) -> list[PortWord]:
        return [PortWord("firmata", Message("an Arduino"), Message("a board"), Message("no serial line"))]

    def test(self) -> PortReport:
        self.done.append("test")
        return self.report

    def go_real(self) -> Problems:
        self.done.append("go_real")
        return self.answer

    def go_simulated(self) -> Problems:
        self.done.append("go_simulated")
        return self.answer


def screen(ports: Ports, shell: Shell | None = None) -> PortScreen:
    return PortScreen(FakeConsole(), shell or Shell(), ports)


def test_what_is_in_use_and_what_is_configured() -> None:
    text = text_of(screen(Ports()))
    assert all(part in text for part in ("In use        simulated\n", "REAL", "MEGA", "firmata", "nothing moves"))
    text = text_of(screen(Ports(replace(PORT, configured="", overridden=True))))
    assert "none drives this card" in text and "--port was given and wins" in text


def test_the_ports_that_there_are_stand_where_there_is_room() -> None:
    below, beside, neither = (text_of(screen(Ports()), size) for size in ((78, 20), (158, 46), (40, 7)))
    assert ">firmata      an Arduino" in below and "it needs: a board" not in below
    assert all(part in beside for part in (">firmata", "an Arduino", "it needs: a board", "used here: no serial line"))
    assert "an Arduino" not in neither


@pytest.mark.parametrize("size", [(80, 24), (160, 50), (40, 20)])
def test_a_report_is_seen_whole_in_every_size(size: tuple[int, int]) -> None:
    drawn = screen(Ports())
    press(drawn, "f5")
    text = text_of(drawn, size)
    assert all(part in text for part in ("StandIn 2.5 answers", "D16", "D39", "It can be used"))
    lines = [line.partition("│")[0].split() for line in text.splitlines()]
    assert ["x_min", "REACHED"] in lines and ["x_max", "clear"] in lines
    assert all(len(line) <= size[0] for line in text.splitlines())


def test_a_failure_is_told_with_its_remedy_and_another_machine_has_no_report() -> None:
    ports = Ports(report=BAD)
    drawn = screen(ports)
    press(drawn, "f5")
    assert "can't be used: firmata: no Firmata answers; upload" in text_of(drawn)
    ports.view = replace(PORT, card="UNO")
    drawn.refresh(VIEW)
    assert "upload" not in text_of(drawn)


@pytest.mark.parametrize(("real", "method"), [(False, "go_real"), (True, "go_simulated")])
@pytest.mark.parametrize("yes", [False, True])
def test_the_machine_is_changed_after_a_yes_only(real: bool, method: str, yes: bool) -> None:
    ports, shell = Ports(replace(PORT, real=real), answer=("the machine is at work",)), Shell(says_yes=yes)
    shell.picks = int(real)  # what is in force
    press(screen(ports, shell), "f6")
    assert shell.asked == [] == ports.done and shell.offered[int(real)].startswith("* ")
    shell.picks = int(not real)
    press(screen(ports, shell), "f6")
    assert len(shell.asked) == 1 and ports.done == ([method] if yes else [])
    assert shell.told == ([("Nothing changed", ["the machine is at work"])] if yes else [])


@pytest.mark.parametrize("answer", ["esc", "enter"])
def test_a_machine_set_to_real_is_asked_about_once_and_no_is_the_first_answer(answer: str) -> None:
    console = FakeConsole(now=replace(VIEW, real_wanted="firmata"))
    program = Program(console)
    assert "pcb-drill is set to REAL" in program.text()
    program.press(answer)
    assert "is set to REAL" not in program.text() and ("go_real",) not in console.asked


def test_a_yes_drives_it_and_a_refusal_is_told() -> None:
    console = FakeConsole(now=replace(VIEW, real_wanted="firmata"), answer=("firmata: no board",))
    program = Program(console)
    program.press("right", "enter")
    assert ("go_real",) in console.asked and "firmata: no board" in program.text()


def test_without_a_port_for_the_card_nobody_is_asked_and_the_reason_told() -> None:
    ports, shell = Ports(replace(PORT, configured=""), answer=("no port drives the card",)), Shell(picks=1)
    press(screen(ports, shell), "f6")
    assert shell.asked == [] and shell.told == [("Nothing changed", ["no port drives the card"])]

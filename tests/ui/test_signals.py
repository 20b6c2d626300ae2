"""The Signals screen: what stands where, what is switched and after which question, in small and large terminals."""

import pytest
from msgspec.structs import replace

from drillctl.console.signals import signals_of
from drillctl.machine import Library, shipped_tables
from drillctl.ui.models.signal_grid import grid_lines, grid_rows, moved
from drillctl.ui.screens.signals import Signals
from drillctl.viewmodel.signals import SignalView
from tests.ui.editor_fakes import Console, Hands, Shell, attributes_of, press, text_of
from tests.ui.fake_console import VIEW

LIBRARY = Library((shipped_tables(),))
SOME = (
    SignalView("input", "x_min", 0, 0, 0),
    SignalView("input", "z_max", 37, 0, 1),
    SignalView("output", "spindle", 18, 0),
    SignalView("coil", "x.1a", 0, 1),
    SignalView("coil", "x.24a", 2, 0, forcing=True),
)
SIZES = [(80, 24), (160, 50), (40, 10)]


def signals(name: str, reached: int = 0, image: int = 0) -> list[SignalView]:
    return signals_of(LIBRARY.machine(name), reached, image)


def screen(shown: tuple[SignalView, ...] = SOME, shell: Shell | None = None, port: str = "") -> tuple[Signals, Hands]:
    console = Console()
    hands = Hands(console, shown, port)
    return Signals(console, shell or Shell(), hands), hands


def test_state_level_and_bit_are_told_in_words() -> None:
    drawn, _hands = screen()
    lines = text_of(drawn).splitlines()
    assert lines[0] == "Inputs" and "Outputs" in lines[2] and lines[4] == "Motor X"
    assert lines[1].split() == [">x_min", "0", "low", "REACHED", "z_max", "37", "low", "clear"]
    assert lines[5].split() == ["x.1a", "0", "high", "ON", "x.24a", "2", "low", "off"]
    assert attributes_of(drawn, "x.1a") == {"lit"} and attributes_of(drawn, "x.24a") == {"body"}
    assert "x_min: bit 0 of card 0, reached when low" in text_of(drawn)


def test_where_there_is_room_the_words_of_the_port_stand_below() -> None:
    drawn, _hands = screen()
    rows = text_of(drawn, (80, 24)).splitlines()
    at = {bit: 16 + (31 - bit) + (31 - bit) // 8 for bit in range(32)}  # behind the label, a blank after each byte
    ruler, *words = rows[rows.index("") + 1 :][:5]
    assert [ruler[at[bit]] for bit in (31, 7, 0)] == ["3", "7", "0"]
    outputs_0, inputs_0, _outputs_1, inputs_1 = words
    assert [outputs_0[at[bit]] for bit in (0, 1, 2, 18)] == ["x", " ", ".", "."] and outputs_0.endswith(" 0x00000001")
    assert inputs_0[at[0]] == "." and inputs_1[at[37 - 32]] == "."
    assert "0x0" not in text_of(drawn, (80, 12))


def test_a_sensor_that_changes_is_seen() -> None:
    drawn, hands = screen()
    hands.shown[1] = replace(SOME[1], level=1)
    drawn.refresh(VIEW)
    assert text_of(drawn).count("REACHED") == 2


@pytest.mark.parametrize("name", ["pcb-drill", "boiler-drum", "eight-axis", "mega-28byj48"])
@pytest.mark.parametrize("size", SIZES)
def test_every_signal_of_a_machine_can_be_come_to(name: str, size: tuple[int, int]) -> None:
    """With the arrows alone, its name and state then on the screen, in every size."""
    all_signals = signals(name)
    drawn, _hands = screen(tuple(all_signals))
    drawn.render(size, focus=True)
    for signal in all_signals:
        text = text_of(drawn, size)
        assert f">{signal.name[:15]}" in text and f"{signal.name}: bit" in text
        assert all(len(row) <= size[0] for row in text.splitlines())
        press_at(drawn, size, "right")


def press_at(drawn: Signals, size: tuple[int, int], key: str) -> None:
    assert drawn.keypress(size, key) is None


@pytest.mark.parametrize("columns", [30, 80, 160])
def test_down_and_up_again_stay_in_their_column(columns: int) -> None:
    shown = signals("eight-axis")
    cells = [place for row in grid_rows(shown, columns) for place in row]
    assert cells == list(range(len(shown))), "each signal has one cell"
    assert len(grid_lines(shown, 0, columns)) == len(grid_rows(shown, columns))
    place = 0
    for _line in range(len(shown)):
        place = moved(shown, place, columns, 1)
    assert place in grid_rows(shown, columns)[-1]
    for _line in range(len(shown)):
        place = moved(shown, place, columns, -1)
    assert place in grid_rows(shown, columns)[1]


def test_an_input_is_pressed_and_let_go_and_on_a_real_port_never() -> None:
    drawn, hands = screen()
    press(drawn, " ")
    drawn.refresh(VIEW)
    assert hands.done == [("press_input", 0, True)] and "x_min is pressed; Space lets it go" in text_of(drawn)
    assert "reached when low, held by hand" in text_of(drawn)
    press(drawn, " ")
    assert hands.done[-1] == ("press_input", 0, False) and "x_min is let go" in text_of(drawn)
    drawn, hands = screen(port="firmata:/dev/ttyACM0")
    press(drawn, " ")
    assert hands.done == [] and "x_min is an input" in text_of(drawn)


def test_an_output_is_switched_at_once() -> None:
    drawn, hands = screen()
    press(drawn, "down", " ")
    assert hands.done == [("set_output", 18, True)]
    drawn.refresh(VIEW)
    press(drawn, " ")
    assert hands.done[-1] == ("set_output", 18, False)


@pytest.mark.parametrize("yes", [False, True])
def test_a_coil_costs_the_position_and_is_asked_about(yes: bool) -> None:
    shell = Shell(says_yes=yes)
    drawn, hands = screen(shell=shell)
    press(drawn, "down", "down", "right", " ")
    assert shell.asked == ["x.24a is a motor's wire: the position will be lost. Switch x.24a on?"]
    assert hands.done == ([("set_output", 2, True)] if yes else [])


def test_what_would_burn_a_winding_is_said_with_its_time_and_that_it_went_off() -> None:
    drawn, _hands = screen()
    for now, told in (
        (replace(VIEW, hot_s=0.8), "this burns a winding at rest: it goes off by itself in 0.8 s"),
        (replace(VIEW, cut_off=True), "what would have burned a winding went off after a second"),
    ):
        drawn.refresh(now)
        assert told in text_of(drawn)
    drawn.refresh(VIEW)
    assert "winding" not in text_of(drawn)


def test_a_real_machine_is_asked_about_for_every_output() -> None:
    shell = Shell()
    drawn, hands = screen(shell=shell, port="firmata:/dev/ttyACM0")
    press(drawn, "down", " ")
    asked = "A real machine is connected to firmata:/dev/ttyACM0. Switch spindle on?"
    assert shell.asked == [asked] and hands.done == []


def test_a_refusal_is_told() -> None:
    drawn, hands = screen()
    hands.refusal = ("the machine is at work; hold or stop it first",)
    press(drawn, "down", " ")
    assert "refused: the machine is at work" in text_of(drawn)
    rows = [row.decode() for row in drawn.render((40, 10)).text]
    assert "refused: the machine is at work" in rows[-2] and "stop it first" in rows[-1]


def test_a_click_sets_the_cursor_and_the_wheel_moves_it() -> None:
    drawn, _hands = screen()
    size = (80, 24)
    drawn.render(size, focus=True)
    assert drawn.mouse_event(size, "mouse press", 1, 45, 1, True)
    assert ">z_max" in text_of(drawn, size)
    assert drawn.mouse_event(size, "mouse press", 5, 0, 0, True)
    assert ">spindle" in text_of(drawn, size)
    assert not drawn.mouse_event(size, "mouse press", 1, 45, 0, True)

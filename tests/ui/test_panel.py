"""The panel of the boiler-drum drill: its keys and display in one process, upon a machine that runs free."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.generation.boiler_drum.cells import with_program
from drillctl.generation.boiler_drum.sentence import sentence_of
from drillctl.generation.boiler_drum.stores import change_ram
from drillctl.ui.boiler_drum import keypad, segments
from drillctl.ui.boiler_drum.monitor import HEX_DIGITS, Monitor, WrongKey
from drillctl.ui.boiler_drum.panel import Panel
from tests.ui.whole import Whole, at_home

# Workpiece 05 in cells: its address in the directory, then tool in 0.2 mm, out 0.2 mm, carriage on 0.3 mm, end.
DIRECTORY = {0x0008: 0x00, 0x0009: 0xC6}
PROGRAM = [sentence_of(text) for text in ("8F0002", "2F0002", "6F0003")]
SENTENCES = {0x00C6 + at: byte for at, byte in enumerate(bytes.fromhex("8F0002 2F0002 6F0003 FF"))}


class Drum(Whole):
    """The program at the panel of the boiler-drum drill."""

    def __init__(self, size: tuple[int, int] = (80, 24)):
        super().__init__(size)
        self.app.take_machine("boiler-drum")

    def type(self, text: str) -> None:
        self.press(*text.lower())

    def write(self, cells: dict[int, int]) -> None:
        """Types contents at addresses that follow each other."""
        self.type(f"{min(cells):04X}m")
        self.type("+".join(f"{cells[address]:02X}" for address in sorted(cells)))
        self.press("m")

    def rest(self, least: int = 3) -> None:
        """Until nothing is at work any more."""
        for turn in range(20_000):
            self.console.turn()
            if turn >= least and not self.console.at_work and not self.console.view().moving:
                break
        self.app.turn()

    def rest_held(self) -> None:
        """Until the machine stands, held."""
        for _turn in range(20_000):
            self.console.turn()
            if self.console.view().condition == "held":
                break
        self.app.turn()

    def places(self) -> list[int]:
        return [axis.position_steps for axis in self.console.view().axes]


@pytest.fixture
def drum(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Drum]:
    at_home(tmp_path, monkeypatch)
    made = Drum()
    yield made
    made.console.close()


@pytest.fixture
def called(drum: Drum) -> Drum:
    """With workpiece 05 in the RAM, and called."""
    change_ram(drum.console.machine, None, lambda cells, name: with_program(cells, 5, PROGRAM, name))
    drum.type("05p")
    return drum


def test_the_keypad_has_28_keys_four_rows_of_seven() -> None:
    keys = [key for row in keypad.ROWS for key in row]
    assert [len(row) for row in keypad.ROWS] == [7] * 4
    assert sorted(key.label for key in keys if key.method == "digit") == sorted(HEX_DIGITS)
    assert len({key.label for key in keys}) == 28


def test_every_figure_of_the_display_is_another_one() -> None:
    assert len({segments.figures(sign) for sign in segments.SEGMENTS}) == len(segments.SEGMENTS) == 18


def test_the_display_shows_the_prompt_digits_a_cell_and_a_workpiece() -> None:
    monitor = Monitor()
    assert monitor.figures() == "-     "
    for figure in "00C6":
        monitor.digit(figure)
    assert (monitor.figures(), monitor.wanted_address()) == ("00C6  ", 0xC6)
    monitor.show_cell(0xC6, 0xFF)
    assert monitor.figures() == "00C6FF"
    assert monitor.digit("8") is None
    assert (monitor.figures(), monitor.digit("1")) == ("00C68-", 0x81)
    monitor.show_workpiece(3)
    assert monitor.figures() == "03    "


@pytest.mark.parametrize(("typed", "asked"), [
    ("00C", "wanted_address"), ("", "wanted_address"), ("00C6", "wanted_number"), ("0A", "wanted_number"),
    ("00", "wanted_number"), ("3", "wanted_number"),
])  # fmt: skip
def test_a_wrong_key_changes_nothing_and_says_why(typed: str, asked: str) -> None:
    monitor = Monitor()
    for figure in typed:
        monitor.digit(figure)
    before = monitor.figures()
    with pytest.raises(WrongKey, match=r"MEM takes|PROG takes"):
        getattr(monitor, asked)()
    assert monitor.figures() == before


def test_a_program_is_typed_in_by_cells_called_and_run(drum: Drum) -> None:
    drum.write(DIRECTORY)
    drum.write(SENTENCES)
    drum.type("05p")
    assert "Workpiece 05 (RAM)" in drum.text()
    assert "8F0002" in drum.text()
    drum.press("s")
    assert "This place becomes zero" in drum.text()  # nobody has set the tool yet
    drum.press("right", "enter")
    drum.rest()
    assert drum.places() == [15, 0]
    drum.press("z")
    drum.rest()
    assert drum.places() == [0, 0]


def test_what_makes_no_sense_now_is_refused_and_changes_nothing(drum: Drum) -> None:
    for keys, why in (
        ("s", "no workpiece is called"), ("99p", "no workpiece of this number"), ("g", "nothing is held"),
        (" ", "nothing runs"), ("z", "zero is not known"), ("+", "go on from a cell"),
        ("2000m", "there is no cell 2000"), ("00C61", "four digits are typed"),
    ):  # fmt: skip
        drum.type(keys)
        assert why in drum.text(), keys
        assert drum.places() == [0, 0]
        drum.press(*["backspace"] * 5)


def test_cells_of_the_eprom_are_shown_and_not_written(drum: Drum) -> None:
    drum.type("8000m")
    shown = drum.app.screens[-1]._monitor.figures()
    drum.type("00")
    assert "read only" in drum.text()
    assert drum.app.screens[-1]._monitor.figures() == shown


def test_an_arrow_and_a_click_are_one_step(drum: Drum) -> None:
    for key, place in (("right", [1, 0]), ("up", [1, 1]), ("left", [0, 1]), ("down", [0, 0])):
        drum.press(key)
        drum.rest()
        assert drum.places() == place, key
    column = drum.text().splitlines()[10].index("[ X+") + 1
    drum.press(("mouse press", 1, column, 10))
    drum.rest()
    assert drum.places() == [1, 0]


def test_zero_after_a_pause_ends_the_program_and_returns(called: Drum) -> None:
    called.press("s", "right", "enter", " ")
    called.rest_held()
    assert "paused" in called.text()
    called.press("5")
    assert "refused: the program is paused" in called.text()
    begun = len(called.console.moved)
    called.press("z")
    called.rest(least=200)  # the program ends first
    assert [what for what, _by in called.console.moved[begun:]] == ["run_queue"]
    assert called.places() == [0, 0]
    assert called.console.view().position_known and called.console.view().condition == "ready"


def test_after_an_emergency_stop_only_the_return_to_zero_is_taken(called: Drum) -> None:
    called.press("i", "right", "enter")
    called.rest()
    called.press("s")
    called.press("f10")
    called.rest()
    assert "To initialise means here: set the tool" in called.text()
    called.press("enter")  # acknowledged
    called.rest()
    for key in ("s", "i", "r", "5", "right"):
        called.press(key)
        assert "refused: only the return to zero is allowed" in called.text(), key
    called.press("z")
    called.rest()
    assert (called.places(), called.console.view().condition) == ([0, 0], "ready")


def test_reset_and_initialise_ask_and_are_refused_while_pulses_run(called: Drum) -> None:
    called.press("s", "right", "enter")
    for key in ("r", "i"):
        called.press(key)
        assert "refused: the machine is at work" in called.text(), key
    called.rest()
    called.press("r")
    assert "Reset?" in called.text()
    called.press("right", "enter")
    called.rest()
    assert called.places() == [0, 0]
    assert "No workpiece is called" in called.text()


def test_a_run_from_elsewhere_than_zero_asks_first(called: Drum) -> None:
    called.press("i", "right", "enter")
    called.rest()
    called.press("s")
    assert "Question" not in called.text()
    called.rest()
    assert called.places() == [15, 0]
    called.press("s")
    assert "This place becomes zero" in called.text()
    called.press("enter")  # means no
    assert called.places() == [15, 0]


def test_a_cell_that_is_written_forgets_the_workpiece_that_was_called(called: Drum) -> None:
    called.type("00C8m03")
    assert "No workpiece is called" in called.text()
    called.press("m")
    called.type("05p")
    assert "8F0003" in called.text()


@pytest.mark.parametrize("size", [(60, 20), (100, 32), (160, 50), (220, 60)], ids=str)
def test_keys_display_and_counters_stand_at_every_size(size: tuple[int, int], called: Drum) -> None:
    called.paper.size = size
    text = called.text()
    assert all(word in text for word in ("[F]", "[RESET]", "[CONT ]", "accumulator", "EMERGENCY STOP"))
    assert ("Workpiece 05 (RAM)" in text) == (size[0] >= 80)
    assert max(map(len, text.splitlines())) == size[0]


def test_every_method_of_the_keypad_and_the_switches_is_the_panels() -> None:
    keys = [*(key for row in keypad.ROWS for key in row), *keypad.SWITCHES]
    assert not {key.method for key in keys if not callable(getattr(Panel, key.method, None))}


def test_the_finder_types_no_digit(drum: Drum) -> None:
    drum.press("5")
    drum.app.screens[-1].typed_digit()
    assert "type the digit itself" in drum.text()

"""The panel of the boiler-drum drill: its keys and display in one process, upon a machine that runs free."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.ui.boiler_drum import keypad, segments
from drillctl.ui.boiler_drum.monitor import HEX_DIGITS, Monitor, WrongKey
from tests.ui.whole import Whole, at_home

# Workpiece 05 in cells: its address in the directory, then tool in 0.2 mm, out 0.2 mm, carriage on 0.3 mm, end.
DIRECTORY = {0x0008: 0x00, 0x0009: 0xC6}
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

    def places(self) -> list[int]:
        return [axis.position_steps for axis in self.console.view().axes]


@pytest.fixture
def drum(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Drum]:
    at_home(tmp_path, monkeypatch)
    made = Drum()
    yield made
    made.console.close()


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
    ):  # fmt: skip
        drum.type(keys)
        assert why in drum.text(), keys
        assert drum.places() == [0, 0]
        drum.press("backspace", "backspace")


def test_cells_of_the_eprom_are_shown_and_not_written(drum: Drum) -> None:
    drum.type("8000m")
    shown = drum.app.screens[-1]._monitor.figures()
    drum.type("00")
    assert "read only" in drum.text()
    assert drum.app.screens[-1]._monitor.figures() == shown

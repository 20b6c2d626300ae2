"""The mouse: every action that the help of a screen names is reached by a click, the keys below by one more, the cursor
by the wheel.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drillctl.ui.frame import screen_keys
from drillctl.ui.widgets.keys import COPY, EMERGENCY, FRAME_KEYS, Key, help_lines
from tests.ui.whole import SCREENS, Whole, at_home, show

PRESS = "mouse press"
TAKEN_BY_LISTS = {("files", "choose")}  # Enter opens what the list stands on before the screen sees the key
TALL = (100, 120)  # the whole help is seen
WIDE = 50  # of a line of the help; it may go on in the next


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Whole]:
    at_home(tmp_path, monkeypatch)
    whole = Whole(TALL)
    yield whole
    whole.console.close()


def place(program: Whole, text: str, from_row: int = 0) -> tuple[int, int]:
    """The column and the row of a text on the screen."""
    rows = program.text().split("\n")
    row = next(row for row in range(from_row, len(rows)) if text in rows[row])
    return rows[row].index(text), row


def click(program: Whole, text: str, from_row: int = 0) -> None:
    program.press((PRESS, 1, *place(program, text, from_row)))


def recorded(monkeypatch: pytest.MonkeyPatch, target: object, keys: tuple[Key, ...]) -> list[tuple[object, ...]]:
    """Puts a method that notes its call in the place of each one that these keys call."""
    calls: list[tuple[object, ...]] = []

    def noting(method: str) -> Callable[..., None]:
        return lambda *arguments: calls.append((method, *arguments))

    for method in {key.method for key in keys}:
        monkeypatch.setattr(target, method, noting(method))
    return calls


def wanted(key: Key) -> tuple[object, ...]:
    return (key.method,) if key.argument is None else (key.method, key.argument)


@pytest.mark.parametrize("name", SCREENS)
def test_a_click_on_a_line_of_the_help_does_what_its_key_does(
    name: str, program: Whole, monkeypatch: pytest.MonkeyPatch
) -> None:
    screen = show(program.app, name)
    assert screen is not None
    keys = tuple(key for key in screen_keys(screen) if key.names and (name, key.method) not in TAKEN_BY_LISTS)
    calls = recorded(monkeypatch, screen, keys)
    reached = []
    for key in keys:
        program.press("f1")
        click(program, help_lines([key])[0][:WIDE])
        assert program.app.layers.top is None
        reached.append(calls[-1:])
    assert reached == [[wanted(key)] for key in keys]


def test_the_keys_of_the_frame_are_reached_from_the_help(program: Whole, monkeypatch: pytest.MonkeyPatch) -> None:
    keys = tuple(key for key in FRAME_KEYS if key.method != "help")
    calls = recorded(monkeypatch, program.app, keys)
    for key in keys:
        program.app.help()
        click(program, help_lines([key])[0][:WIDE])
    assert calls == [wanted(key) for key in keys] and {EMERGENCY, COPY} <= set(keys)


@pytest.mark.parametrize("size", [(80, 24), (160, 50)])
def test_a_click_on_a_key_below_the_screen_presses_it(
    size: tuple[int, int], program: Whole, monkeypatch: pytest.MonkeyPatch
) -> None:
    program.paper.size = size
    screen = program.app.screens[-1]
    keys = tuple(key for key in screen_keys(screen) if key.short)
    calls = recorded(monkeypatch, screen, keys)
    for key in keys:
        click(program, f"{key.printed} {key.short}", size[1] - 4)
    assert calls == [wanted(key) for key in keys]
    click(program, "F1 ? Help", size[1] - 4)
    assert program.app.layers.top is not None
    program.press("esc", (PRESS, 1, size[0] - 1, size[1] - 1))
    assert program.app.layers.top is None


def test_the_wheel_moves_the_cursor_of_a_screen_and_never_the_machine(
    program: Whole, monkeypatch: pytest.MonkeyPatch
) -> None:
    drilling = program.app.screens[-1]
    jogs = recorded(monkeypatch, drilling, tuple(key for key in screen_keys(drilling) if "jog" in key.method))
    for button in (4, 5):
        program.press((PRESS, button, TALL[0] - 3, TALL[1] - 8))
    assert jogs == []
    signals = program.app.show("signals")
    moves = recorded(monkeypatch, signals, tuple(key for key in screen_keys(signals) if key.method == "downwards"))
    program.press((PRESS, 5, 3, TALL[1] - 8), (PRESS, 4, 3, TALL[1] - 8))
    assert moves == [("downwards", 1), ("downwards", -1)]


def test_enter_in_the_help_only_closes_it(program: Whole) -> None:
    program.press("f1", "enter")
    assert program.app.layers.top is None and program.console.moved == []

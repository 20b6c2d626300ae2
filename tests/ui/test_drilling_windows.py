"""The windows of the Drilling screen where there is room: large figures, gauge, commands, tools, motors and rotors."""

from collections import deque

import numpy as np
import pytest
from msgspec.structs import replace

from drillctl.language import words
from drillctl.ui.models.speeds import Speeds
from drillctl.ui.pcb_drill.machine_window import machine_pages
from drillctl.ui.pcb_drill.motor_strip import Motors
from drillctl.ui.pcb_drill.tool_list import tool_lines
from drillctl.ui.widgets.text_graphics import LIGHT, PLAIN, bar, gauge, large, strip
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import MachineView, ToolView
from drillctl.viewmodel.records import Progress, ToolEstimate
from tests.ui.fake_console import BOARD, VIEW, FakeConsole, Program

AT_WORK = replace(
    VIEW, command="KMD_GOTO_X_Y 1559 0", moving=True, following=("KMD_WIERTLO_DOL", "KMD_WIERTLO_GORA", "KMD_KONIEC")
)
HALF = Progress(2, 4, 1, 2500, 5.0, 5.0)
TWO_TOOLS = replace(
    BOARD, tool=np.array([0, 0, 1, 1]), tools=(ToolView(1, 0.8, 2), ToolView(2, 3.0, 2)),
    estimate=replace(BOARD.estimate, tools=(ToolEstimate(1, 0.8, 2, 5000), ToolEstimate(2, 3.0, 2, 30000))),
)  # fmt: skip

pytestmark = pytest.mark.usefixtures("idle")


def texts(lines: list[Line]) -> list[str]:
    return ["".join(part if isinstance(part, str) else part[1] for part in line) for line in lines]


def test_large_figures_are_three_rows_and_every_figure_differs_from_the_others() -> None:
    assert large("-1.5") == ("      ╷   ┌─╴", "╶─╴   │   └─┐", "      ╵ . ╶─┘")
    for table in (LIGHT, PLAIN):
        assert len(set(table.values())) == len(table) == 13
        assert all(len({*map(len, rows)}) == 1 for rows in table.values())
    assert "".join(large("0123456789.- ", plain=True)).isascii()


@pytest.mark.parametrize(
    ("part", "light", "plain"),
    [(0, "░░░░", "...."), (0.5, "██░░", "##.."), (0.625, "██▌░", "##.."), (1, "████", "####"), (7, "████", "####"),
     (-1, "░░░░", "....")],
)  # fmt: skip
def test_a_bar_is_filled_to_its_part(part: float, light: str, plain: str) -> None:
    assert (bar(part, 4), bar(part, 4, plain=True)) == (light, plain)


def test_a_gauge_says_a_hundred_per_cent_of_the_whole_alone() -> None:
    assert gauge(999, 1000, 20).endswith(" 99 %") and gauge(1000, 1000, 20).endswith("100 %")
    assert gauge(0, 0, 20).endswith("  0 %") and len(gauge(1, 3, 48)) == 48


def test_a_strip_shows_the_newest_values_and_no_motion_is_blank() -> None:
    assert strip([0.0, 0.001, 4.0, 8.0], 8.0, 4) == " ▁▄█" and strip([1.0, 8.0], 8.0, 1) == "█"
    assert strip([], 0.0, 3) == "   " and strip([0.0, 8.0], 8.0, 3, plain=True) == "  @"


def moved(view: MachineView, tick: int, steps: int) -> MachineView:
    return replace(view, tick=tick, axes=(replace(view.axes[0], position_steps=steps), *view.axes[1:]))


def test_speed_is_the_way_over_the_machine_s_own_time() -> None:
    speeds = Speeds()
    for tick, steps in ((100, 0), (150, 20), (150, 20), (200, 10), (300, 10)):
        speeds.see(moved(VIEW, tick, steps))
    assert speeds.of["x"] == deque([200.0, 100.0, 0.0]) and speeds.now("x") == 0.0
    speeds.see(moved(replace(VIEW, machine="boiler-drum"), 400, 0))
    assert not speeds.of["x"]


def test_a_place_counted_from_another_base_is_no_motion() -> None:
    speeds = Speeds()
    for tick, steps in ((100, 0), (150, 20), (151, -500), (201, -490)):
        speeds.see(moved(VIEW, tick, steps))
    assert speeds.of["x"] == deque([200.0, 0.0, 100.0])


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_the_machine_s_window_has_the_place_the_gauge_and_the_commands_to_come(language: str) -> None:
    words.use(language)
    (page,) = machine_pages(AT_WORK, HALF, BOARD, 48, 25)
    lines = texts(page)
    text = "\n".join(lines)
    assert max(map(len, lines)) <= 48 and len(lines) <= 25 and " 50 %" in text
    assert all(command in text for command in (AT_WORK.command, *AT_WORK.following))
    assert all(row in text for row in large("   3.175")) and "33.000" in text and "29.825" in text
    assert "[x_min]" in text and "500 Hz" in text


def test_many_axes_stand_on_further_pages() -> None:
    many = replace(VIEW, axes=tuple(replace(VIEW.axes[0], name=f"a{n}") for n in range(8)), lost_steps=None)
    pages = machine_pages(many, HALF, BOARD, 48, 25)
    assert len(pages) > 1 and all(any(f"A{n}" in "\n".join(texts(page)) for page in pages) for n in range(8))
    motors = Motors().pages(many, Speeds(), 108, 8)
    assert len(motors) == 3 and "A7" in "\n".join(texts(motors[-1]))


def test_many_motors_have_a_line_each_where_their_tables_have_no_room() -> None:
    axes = [replace(VIEW.axes[0], name=f"a{n}", behind_steps=0.5 * n, top_state=10) for n in range(8)]
    axes[3] = replace(axes[3], state=-10)
    (page,) = Motors().pages(replace(VIEW, axes=tuple(axes), lost_steps=None), Speeds(), 108, 9)
    heading, *lines = texts(page)
    assert [line.split()[0] for line in lines] == [f"A{n}" for n in range(8)] and max(map(len, lines)) <= 108
    assert lines[3].startswith("A3  7 -10 [1a]") and "█" * 10 in lines[3] and lines[3].endswith("....●.|...... -1.50")
    assert len({line.index("/s") for line in lines}) == 1 == len({line.index("|") for line in lines[2:]})
    assert heading.index("Rotor") == lines[0].index("......")
    assert len(Motors().pages(replace(VIEW, axes=tuple(axes), lost_steps=None), Speeds(), 70, 9)) > 1


def test_tools_are_told_with_their_holes_their_time_and_a_mark_on_the_one_that_is_in() -> None:
    heading, first, second = texts(tool_lines(replace(VIEW, tool=2), TWO_TOOLS, 3, 48))
    assert first.split()[:4] == ["T1", "0.800", "2/2", "0:10"] and first.endswith("█" * 6)
    assert second.split()[:5] == [">", "T2", "3.000", "1/2", "1:00"] and len(heading) <= 48 >= len(second)
    assert tool_lines(VIEW, None, 0, 48) == []


def test_a_motor_shows_column_forcing_ramp_and_the_rotor_where_it_is() -> None:
    axis = replace(VIEW.axes[0], wires=(("1a", "xxx...", True), ("24a", "X.....", False)), column=1, state=-1)
    view = replace(VIEW, axes=(axis,), lost_steps=(0,))
    (page,) = Motors().pages(view, Speeds(), 108, 11)
    text = "\n".join(texts(page))
    assert "[1a]" in text and "[x]xx..." in text and "|X|....." in text and "█████▌" in text and "Rotor" not in text
    behind = replace(view, axes=(replace(axis, behind_steps=2.25),))
    assert "....●.|......" in texts(Motors().pages(behind, Speeds(), 108, 11)[0])[-1]
    lost = replace(view, axes=(replace(axis, behind_steps=12.0),), lost_steps=(12,))
    row = texts(Motors(plain=True).pages(lost, Speeds(), 108, 11)[0])[-1]
    assert "o.....|......" in row and "-12.00, 12 lost" in row


def test_the_bit_is_seen_where_it_really_is_beside_where_it_is_thought_to_be() -> None:
    x, y, z = (replace(axis, position_mm=20.0, behind_steps=0.0) for axis in VIEW.axes)
    view = replace(VIEW, axes=(x, y, z))
    assert "◇" not in Program(FakeConsole(now=view, loaded=BOARD), (160, 50)).text()
    behind = replace(view, axes=(replace(x, behind_steps=10 * x.steps_per_mm), y, z))
    rows = Program(FakeConsole(now=behind, loaded=BOARD), (160, 50)).text().splitlines()
    (row,) = [row for row in rows if "◇" in row]
    assert row.index("◇") < row.index("+")


def test_lost_steps_stay_in_the_list_of_events() -> None:
    program = Program(FakeConsole(now=VIEW, loaded=BOARD), (160, 50))
    program.console.now = replace(VIEW, lost_steps=(12, 0, 0), tick=2)
    program.app.turn()
    program.console.now = replace(VIEW, tick=3)
    program.app.turn()
    assert "steps are lost: 12 0 0" in program.text()


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("size", [(160, 50), (220, 60), (150, 44)])
def test_every_window_has_its_content_at_large_sizes(language: str, size: tuple[int, int]) -> None:
    words.use(language)
    program = Program(FakeConsole(now=AT_WORK, loaded=TWO_TOOLS, job=HALF), size)
    text = program.text()
    assert all(told in text for told in ("KMD_KONIEC", " 50 %", "> T1", "[1a]", "╶─┐"))
    assert text.count("┌ ") == 5 and all(len(row) == size[0] for row in text.splitlines())

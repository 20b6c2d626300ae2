"""Single ticks in one picture: phases, port's bits, sensors, a column a tick; and the panel of the queue editor."""

from types import SimpleNamespace

from drillctl.ui.screens.queue_editor import QueueEditor
from drillctl.ui.screens.tick_log import HIGH, LOW, SKIPPED, TickLog, port_line
from drillctl.viewmodel.signals import SignalView
from tests.ui.editor_fakes import Console, Hands, Queues, Shell, text_of


def signals(wire: int, sensor: int = 0) -> list[SignalView]:
    return [
        SignalView("input", "x_min", 3, sensor),
        SignalView("coil", "x.1a", 5, wire),
        SignalView("coil", "x.2a", 33, 1),
    ]


def drawn(log: TickLog, rows: int = 20, plain: bool = False) -> list[str]:
    lines = log.lines([], (60, rows), plain)
    return ["".join(part if isinstance(part, str) else part[1] for part in line).rstrip() for line in lines]


def test_every_tick_is_a_column_and_a_gap_is_said() -> None:
    log = TickLog()
    for tick, wire in ((7, 0), (8, 1), (9, 0), (15, 1)):
        assert log.add(tick, signals(wire))
    assert not log.add(15, signals(0)), "the same tick again is not another"
    row = next(line for line in drawn(log) if "x.1a" in line)
    assert row.startswith("[x.1a]") and row.endswith(LOW + HIGH + LOW + SKIPPED)
    assert "ticks 7..15" in drawn(log)[1] and "".join(drawn(log, plain=True)).isascii()


def test_the_ports_bits_are_a_number_a_card_with_the_sensors_that_are_reached() -> None:
    line = "".join(part if isinstance(part, str) else part[1] for part in port_line(signals(1, 1)))
    assert line == "port 0x00000020 0x00000002  sensors [x_min]"


def test_a_tick_before_the_last_begins_another_run() -> None:
    log = TickLog()
    log.add(50, signals(1))
    log.add(2, signals(0))
    assert len(log) == 1 and "ticks 2..2" in drawn(log)[1]


def test_where_rows_are_few_what_is_on_comes_first() -> None:
    log = TickLog()
    log.add(1, signals(1))
    assert [line.split()[0] for line in drawn(log, 4)[2:]] == ["[x.1a]", "[x.2a]"]


def test_the_queue_editor_shows_the_ticks_beside_the_text_and_the_commands_before_them() -> None:
    console = Console()
    hands = Hands(console, signals(1, 1))
    editor = QueueEditor(console, Shell(), Queues(), hands)
    assert "KMD_CZEKAJ ticks" in text_of(editor, (158, 40)) and "wait" in text_of(editor, (158, 40))
    axis = SimpleNamespace(name="x", column=3, state=1, top_state=3, position_steps=7, wires=(("1a", "x.", True),))
    editor.refresh(SimpleNamespace(paused=True, tick=41, command="KMD_CZEKAJ 5", axes=(axis,)))  # type: ignore[arg-type]
    wide, small = text_of(editor, (158, 40)), text_of(editor, (80, 20))
    assert "Single ticks" in wide and "[x.1a]" in wide and "[1a]" in wide and "ticks 41..41" in wide
    assert "port 0x00000020 0x00000002  sensors [x_min]" in small and "stopped after tick 41" in small

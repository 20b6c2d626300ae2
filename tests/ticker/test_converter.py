"""Lines to frequency converters: Modbus RTU against a pymodbus server over pseudo terminals, and Huanyang's frames."""

import os
import select
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from drillctl.machine import Library, TableError, shipped_tables
from drillctl.machine.converter import MODBUS, Converter, parse_converter
from drillctl.machine.source import Source
from drillctl.ticker.converter.huanyang import HuanyangLine, crc16, data_of, frame
from drillctl.ticker.converter.lines import ConverterError, ModbusLine, Reading
from tests.support.converter import WITHIN_S, ModbusConverter, Wire, huanyang

NAMES = ("delta-gs20", "gs2", "h100", "huanyang", "yaskawa")


def kind(name: str) -> Converter:
    file = Library((shipped_tables(),)).find("converter", name)
    assert file is not None
    return parse_converter(Source.read(file))


@contextmanager
def delta() -> Iterator[tuple[ModbusLine, ModbusConverter, Wire]]:
    table = kind("delta-gs20")
    with Wire() as wire, ModbusConverter(wire.theirs, table.baud) as converter:
        line = ModbusLine(table, wire.ours)
        yield line, converter, wire
        line.close()


def test_a_modbus_converter_is_run_read_and_stopped_and_what_goes_wrong_on_the_line_is_no_reading() -> None:
    with delta() as (line, converter, wire):
        line.run(400.0)
        assert converter.writes == [(0x2001, 40000), (0x2000, 0x12)]
        assert line.read() == Reading(400.0, 400.0, 0)
        converter.tripped = 0x1504  # a warning, and fault 4
        converter.lie = lambda: 12.5
        assert line.read() == Reading(12.5, 400.0, 4)
        for fault in ({"noisy": True}, {"cut": True}, {"late_s": 0.3}):
            vars(wire).update(fault)
            with pytest.raises(ConverterError):
                line.read()
            vars(wire).update(noisy=False, cut=False, late_s=0.0)
            assert answered(line).output_hz == 12.5
        line.stop()
        assert converter.writes[-1] == (0x2000, 1) and converter.hz == 0
        line.reopen()
        assert line.read().set_hz == 400.0


def answered(line: ModbusLine) -> Reading:
    """The next good answer: what came too late may fall into the one before."""
    ends_s = time.monotonic() + WITHIN_S
    while time.monotonic() < ends_s:
        with suppress(ConverterError):
            return line.read()
    raise AssertionError("it never answers again")


def test_a_device_that_is_pulled_out_is_an_error_and_one_that_is_not_there_too() -> None:
    with Wire() as wire:
        line, other = ModbusLine(kind("delta-gs20"), wire.ours), HuanyangLine(kind("huanyang"), wire.theirs)
    for call in (line.read, line.stop, line.reopen, other.stop):
        with pytest.raises(ConverterError):
            call()
    with pytest.raises(ConverterError, match="can't be opened"):
        ModbusLine(kind("delta-gs20"), "/dev/no-such-line")


@contextmanager
def answering(broken: dict[str, int]) -> Iterator[tuple[HuanyangLine, dict[str, int]]]:
    """A Huanyang at the other end; ``broken["bit"]`` is turned over in its answers, ``broken["short"]`` bytes miss."""
    ours, theirs = os.openpty()
    end, over = os.pipe()
    state = {"set": 0, "on": 0}

    def serve() -> None:
        waiting = b""
        while ours in select.select([ours, end], [], [])[0]:
            waiting += os.read(ours, 64)
            while len(waiting) >= 3 and len(waiting) >= (size := waiting[2] + 5):
                answer, waiting = bytearray(huanyang(waiting[:size], state)), waiting[size:]
                answer[broken.get("at", 0)] ^= broken.get("bit", 0)
                os.write(ours, bytes(answer[: len(answer) - broken.get("short", 0)]))

    thread = threading.Thread(target=serve)
    thread.start()
    line = HuanyangLine(kind("huanyang"), os.ttyname(theirs))
    yield line, state
    os.write(over, b".")
    thread.join(WITHIN_S)
    line.close()
    for each in (ours, theirs, end, over):
        os.close(each)


def test_a_huanyang_is_run_read_and_stopped_and_broken_answers_are_errors() -> None:
    broken: dict[str, int] = {}
    with answering(broken) as (line, state):
        line.run(333.33)
        assert state == {"set": 33333, "on": 1} and line.read() == Reading(333.33, 333.33)
        for at, bit in ((0, 1), (1, 2), (4, 128), (6, 1)):
            broken.update(at=at, bit=bit)
            with pytest.raises(ConverterError):
                line.read()
        broken.clear()
        broken["short"] = 1
        with pytest.raises(ConverterError, match="no whole answer"):
            line.stop()
        broken.clear()
        line.stop()
        assert line.read() == Reading(0.0, 333.33)
        with pytest.raises(ConverterError, match="more than it can be told"):
            line.run(700)


def test_huanyang_frames_are_those_of_its_manual() -> None:
    assert frame(1, 3, b"\x01").hex() == "0103010131" + "88"
    assert frame(1, 5, bytes((0x9C, 0x40))).hex()[:10] == "0105029c40" and crc16(b"123456789").hex() == "374b"
    with pytest.raises(ConverterError, match="another question"):
        data_of(frame(2, 3, b"\x01"), 1, 3)


@pytest.mark.parametrize("name", NAMES)
def test_the_shipped_tables_are_whole(name: str) -> None:
    table = kind(name)
    assert table.name == name and (table.protocol == MODBUS) == (name != "huanyang")


ROWS = [
    ("per_hz = 100", "per_hz = 0", "speed.per_hz: expected float > 0.0"),
    ("register = 0x2001", "register = 0x12001", "speed.register: expected int <= 65535"),
    ("greatest_hz = 599", "greatest = 599", "unknown key greatest"),
    ('protocol = "modbus"', 'protocol = "profibus"', "protocol: invalid enum value 'profibus'"),
    ('protocol = "modbus"', 'protocol = "huanyang"', "protocol huanyang has frames of its own, and no run"),
    ("[output]", "[set_again]", "unknown key set_again"),
    ("[[stop]]\nregister = 0x2000\nvalue = 0x01\n", "", "stop is missing"),
]


@pytest.mark.parametrize(("old", "new", "reason"), ROWS)
def test_a_wrong_table_is_refused_with_its_line(old: str, new: str, reason: str, tmp_path: Path) -> None:
    text = (shipped_tables() / "converter" / "delta-gs20.toml").read_text()
    assert old in text
    with pytest.raises(TableError) as refused:
        parse_converter(Source(tmp_path / "t.toml", text.replace(old, new, 1)))
    assert reason in refused.value.reason and refused.value.line

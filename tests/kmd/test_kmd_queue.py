"""The record, the ring and the mailbox: what stands between generation and execution."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.kmd import CAPACITY, COMMANDS, RECORD, Command, Names, Op, Queue, Request, Requests, parse_program
from drillctl.kmd.commands import BY_OP, Flag
from drillctl.kmd.queue import RequestBit

# The set as it was agreed; the paper names the first three.
AGREED = {
    "KMD_GOTOdXdY", "KMD_GOTO_X_Y", "KMD_WIERTLO_DOL",
    "KMD_WIERTLO_GORA", "KMD_INICJALIZACJA", "KMD_BAZA", "KMD_RUCH", "KMD_RUCHd", "KMD_LINIA", "KMD_LINIAd",
    "KMD_PREDKOSC", "KMD_CZEKAJ", "KMD_WYJSCIE", "KMD_CZEKAJ_WE", "KMD_WRZECIONO", "KMD_NARZEDZIE", "KMD_FAZY_WYL",
    "KMD_KONIEC", "KMD_POWROT", "KMD_GORA_X_Y", "KMD_KROK", "KMD_WIERTLO_DOM", "KMD_SUW", "KMD_DOTYK",
}  # fmt: skip


def records(count: int, first: int = 1) -> np.ndarray:
    made = np.zeros(count, dtype=RECORD)
    made["sequence"] = np.arange(first, first + count)
    return made


def test_the_command_set_is_the_agreed_one_and_each_has_an_opcode_of_its_own() -> None:
    assert set(COMMANDS) == AGREED
    assert {spec.op for spec in COMMANDS.values()} == set(Op) - {Op.IDLE} == set(BY_OP)
    assert all(name == spec.name and spec.meaning for name, spec in COMMANDS.items())


def test_a_record_is_60_bytes_little_endian(names: Names) -> None:
    assert RECORD.itemsize == 60
    record = parse_program("KMD_PREDKOSC 770\nKMD_LINIA z=-2 x=258", names)[1]
    expected = bytes.fromhex(
        "02000000" "00000000"  # sequence, epoch
        "09" "03" "0500"  # opcode, flags (absolute, linked), axes x and z
        "02030000" "00000000"  # floor_ticks, tag
        "02010000" "00000000" "feffffff"  # arguments by axis
    )  # fmt: skip
    assert record.tobytes() == expected + bytes(28)


def test_flags_tell_absolute_from_relative_and_lines_from_moves() -> None:
    flags = {name.removeprefix("KMD_"): spec.flags for name, spec in COMMANDS.items() if spec.flags}
    absolute, linked = Flag.ABSOLUTE, Flag.LINKED
    assert flags == {
        "GOTO_X_Y": absolute, "RUCH": absolute, "LINIA": absolute | linked, "LINIAd": linked, "GORA_X_Y": absolute,
    }  # fmt: skip


def test_take_overwrites_one_command_in_place() -> None:
    queue, command = Queue(), Command()
    one = records(1)
    every_axis = [1, -2, 3, -4, 5, -6, 7, 8, -9, -(2**31)]
    one["opcode"], one["args"] = Op.RUCH, [every_axis]
    one["epoch"], one["tag"], one["floor_ticks"], one["axes"], one["flags"] = 4, 9, 6, 1023, 3
    args = command.args
    assert queue.put(one) == 1 and queue.take(command)
    assert command.args is args and args == every_axis
    fields = ("sequence", "epoch", "opcode", "flags", "axes", "floor_ticks", "tag")
    told = tuple(getattr(command, field) for field in fields)
    assert told == (1, 4, Op.RUCH, 3, 1023, 6, 9)
    assert all(type(value) is int for value in (*told, *args))


def test_an_empty_queue_gives_nothing_and_leaves_the_command() -> None:
    queue, command = Queue(), Command()
    command.sequence = 77
    assert not queue.take(command) and command.sequence == 77 and len(queue) == 0


@pytest.mark.parametrize("offered", [0, 1, CAPACITY - 1, CAPACITY, CAPACITY + 1, 3 * CAPACITY])
def test_a_full_queue_takes_no_more_and_says_so(offered: int) -> None:
    queue = Queue()
    assert queue.put(records(offered)) == min(offered, CAPACITY) == len(queue)
    assert queue.room == CAPACITY - len(queue)
    assert queue.put(records(1)) == (1 if offered < CAPACITY else 0)


@given(st.lists(st.tuples(st.integers(0, 300), st.integers(0, 300)), max_size=20))
@settings(max_examples=100, deadline=None)
def test_what_goes_in_comes_out_once_and_in_order(rounds: list[tuple[int, int]]) -> None:
    """Through many turns of the ring."""
    queue, command = Queue(), Command()
    put = taken = 0
    for offered, wanted in rounds:
        put += queue.put(records(offered, put + 1))
        for _ in range(wanted):
            if not queue.take(command):
                break
            taken += 1
            assert command.sequence == taken
        assert len(queue) == put - taken and queue.room == CAPACITY - len(queue)


def test_putting_copies() -> None:
    """Whoever offered the records may reuse them."""
    queue, command, mine = Queue(), Command(), records(2)
    queue.put(mine)
    mine["sequence"] = 99
    assert queue.take(command) and command.sequence == 1


def test_requests_wait_each_once_until_they_are_served() -> None:
    mailbox = Requests()
    for request in (Request.STOP, Request.HOLD, Request.STOP):
        mailbox.post(request)
    assert mailbox.pending == RequestBit.STOP | RequestBit.HOLD
    assert {bit.name for bit in RequestBit} == {request.name for request in Request if request}
    assert [RequestBit[request.name] for request in Request if request] == [1 << r for r in Request if r]

"""The doors in shared memory do what the doors of one process do; a status record is whole or not read at all."""

import resource
import signal
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from drillctl.kmd import CAPACITY, RECORD, STATUS, Command, Gate, Queue, Request, Requests
from drillctl.kmd.channel import CHANNEL, Channel, SharedGate, SharedQueue, SharedRequests
from drillctl.kmd.queue import MOST_HANDS, bit_and_value, hand_of
from drillctl.ticker.child_process import ChildProcess

PUBLISHED, SEEN = 2_000_000, 300  # at the most, and enough
ASKED = [request for request in Request if request not in (Request.NONE, Request.OUTPUT)]
FRESH_FOLDER = settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def channel(tmp_path: Path) -> Channel:
    return Channel(tmp_path / "c", create=True)


@given(st.lists(st.one_of(st.integers(0, 2 * CAPACITY), st.just("take")), max_size=60))
@FRESH_FOLDER
def test_the_shared_queue_is_the_queue(tmp_path: Path, doings: list[int | str]) -> None:
    """Numbers put as many records; every answer and every command taken must be the same."""
    shared, plain = SharedQueue(Channel(tmp_path / "c", create=True)), Queue()
    mine, its = Command(), Command()
    sent = 0
    for doing in doings:
        if isinstance(doing, int):
            records = np.zeros(doing, RECORD)
            records["sequence"] = records["tag"] = np.arange(sent, sent + doing)
            taken = shared.put(records)
            assert taken == plain.put(records)
            sent += taken
        else:
            assert shared.take(its) == plain.take(mine)
            assert (its.sequence, its.tag) == (mine.sequence, mine.tag)
        assert (len(shared), shared.room) == (len(plain), plain.room)


@given(st.lists(st.one_of(st.tuples(st.integers(0, 127), st.integers(0, 1)), st.just("take")), max_size=60))
@FRESH_FOLDER
def test_outputs_by_hand_stand_in_line_on_both_sides(tmp_path: Path, doings: list[tuple[int, int] | str]) -> None:
    """One a take, the oldest first; a full line takes nothing."""
    channel = Channel(tmp_path / "c", create=True)
    desk, ticker, plain = SharedRequests(channel), SharedRequests(channel), Requests()
    waiting: list[tuple[int, int]] = []
    for doing in [*doings, *["take"] * (MOST_HANDS + 1)]:
        if isinstance(doing, tuple):
            assert desk.set_output(*doing) == plain.set_output(*doing) == (len(waiting) < MOST_HANDS)
            waiting += [doing] * (len(waiting) < MOST_HANDS)
        else:
            bits = ticker.take()
            assert bits == plain.take() == (1 << Request.OUTPUT if waiting else 0)
            if waiting:
                assert bit_and_value(ticker.hand) == bit_and_value(plain.hand) == waiting.pop(0)
        assert ticker.waiting == plain.waiting == bool(waiting)


def test_an_output_by_hand_is_one_number() -> None:
    told = {hand_of(bit, value): (bit, value) for bit in range(128) for value in (0, 1)}
    assert len(told) == 256 and 0 not in told
    assert all(bit_and_value(hand) == what for hand, what in told.items())


@given(st.lists(st.one_of(st.integers(0, 5), st.sampled_from(["open", "pass"])), max_size=60))
@FRESH_FOLDER
def test_the_shared_gate_is_the_gate(tmp_path: Path, doings: list[int | str]) -> None:
    """A number grants so many ticks; one passes while there are any left. ``left`` is counted by hand beside it."""
    channel = Channel(tmp_path / "c", create=True)
    desk, ticker, plain = SharedGate(channel), SharedGate(channel), Gate()
    paused, left = False, 0
    for doing in doings:
        if isinstance(doing, int):
            desk.grant(doing)
            plain.grant(doing)
            paused, left = True, left + doing
        elif doing == "open":
            desk.open()
            plain.open()
            paused, left = False, 0
        elif left:
            ticker.passed(1)
            plain.passed(1)
            left -= 1
        assert (ticker.paused, ticker.left) == (plain.paused, plain.left) == (paused, left)


@given(st.lists(st.one_of(st.sampled_from(ASKED), st.just("take")), max_size=60), st.data())
@FRESH_FOLDER
def test_the_shared_mailbox_is_the_mailbox(tmp_path: Path, doings: list[Request | str], data: st.DataObject) -> None:
    """Whether the desk asks or the ticker itself."""
    channel = Channel(tmp_path / "c", create=True)
    desk, ticker, plain = SharedRequests(channel), SharedRequests(channel), Requests()
    for doing in [*doings, "take"]:
        if isinstance(doing, Request):
            plain.post(doing)
            (ticker.own if data.draw(st.booleans()) else desk).post(doing)
        assert ticker.waiting == bool(plain.pending)
        if doing == "take":
            assert ticker.take() == plain.take()


def numbered(number: int) -> np.void:
    """A status record all of whose wide fields say the same."""
    record = np.zeros(1, STATUS)[0]
    record["tick"] = record["late_worst_ns"] = number
    for name in ("position", "target", "steps"):
        record[name] = number
    record["sensors"] = number
    return record


def whole(record: np.void) -> bool:
    values = {int(record["tick"]), int(record["late_worst_ns"]), int(record["sensors"])}
    return len(values.union(*(record[name].tolist() for name in ("position", "target", "steps")))) == 1


def test_a_status_is_copied_once_for_each_that_is_published(channel: Channel) -> None:
    channel.publish(numbered(1))
    first = channel.status()
    assert channel.status() is first
    channel.publish(numbered(2))
    assert channel.status()["tick"] == 2 and first["tick"] == 1


def test_no_status_is_ever_torn(channel: Channel) -> None:
    """One process writes as fast as it can until another has read enough."""

    def write() -> None:
        for number in range(1, PUBLISHED + 1):
            channel.publish(numbered(number))
            if channel["ended"]:
                return

    writer = ChildProcess(write)
    seen = set()
    while not writer.gone:
        with suppress(OSError):  # a reader that is always too late gives up, as PacedLink then keeps its last one
            record = channel.status()
            assert whole(record), record
            seen.add(int(record["tick"]))
            channel["ended"] = len(seen) > SEEN
    assert len(seen) > SEEN and int(channel.status()["tick"]) <= PUBLISHED


def test_a_record_whose_writer_died_in_it_is_not_read(channel: Channel) -> None:
    channel.publish(numbered(7))
    channel.fields["lock"] += 1
    channel.fields["status"]["tick"] = 8
    with pytest.raises(OSError, match="left half written"):
        channel.status()


def test_the_file_outlives_its_makers_and_a_new_one_leaves_the_old_be(tmp_path: Path) -> None:
    file = tmp_path / "c"
    old = Channel(file, create=True)
    old.publish(numbered(3))
    assert Channel(file, create=False).status()["tick"] == 3
    Channel(file, create=True).publish(numbered(4))
    assert (old.status()["tick"], Channel(file, create=False).status()["tick"]) == (3, 4)


@pytest.mark.parametrize("content", [b"", b"DRILLCTL", bytes(CHANNEL.itemsize), bytes(CHANNEL.itemsize + 1)])
def test_another_file_is_no_channel(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "c").write_bytes(content)
    with pytest.raises(OSError, match="not a channel"):
        Channel(tmp_path / "c", create=False)


def test_all_its_room_on_the_disk_is_taken_at_the_start(tmp_path: Path) -> None:
    """A page that found none when it is written first would be a bus error in the middle of a job."""
    Channel(tmp_path / "c", create=True)
    assert (tmp_path / "c").stat().st_blocks * 512 >= CHANNEL.itemsize


def test_a_disk_without_room_is_named(tmp_path: Path) -> None:
    def make() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        sys.dont_write_bytecode = True  # it would be cut off too, and kept
        resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024))
        try:
            Channel(tmp_path / "c", create=True)
        except OSError as error:
            (tmp_path / "told").write_text(f"{error.filename}")

    ChildProcess(make).end(patience_s=10)
    assert (tmp_path / "told").read_text() == str(tmp_path / "c")
    assert [file.name for file in tmp_path.iterdir()] == ["told"]

"""Stores of workpieces: cells at addresses, files that are whole or refused, content that outlives a kill."""

import os
import random
import signal
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.files import kept
from drillctl.generation.boiler_drum import cells, stores
from drillctl.generation.boiler_drum.sentence import Sentence
from drillctl.generation.boiler_drum.store_file import HEADER, parse_store, store_text
from drillctl.generation.boiler_drum.stores import change_ram, find_part, read_eprom, read_ram
from drillctl.generation.boiler_drum.text import part_text
from drillctl.generation.errors import JobError
from drillctl.machine import Library, shipped_tables
from tests.generation.boiler_drum.test_sentences import programs
from tests.support.sentences import decoded, decoded_store

DRUM = Library((shipped_tables(),)).machine("boiler-drum")
ROW = (Sentence("8", 1, 400), Sentence("2", 12, 400))
MALFORMED = 200

contents = st.dictionaries(st.integers(1, 99), programs, max_size=5)


def filled(programs: dict[int, tuple[Sentence, ...]]) -> bytes:
    found = cells.EMPTY_STORE
    for number, sentences in programs.items():
        found = cells.with_program(found, number, sentences, "ram")
    return found


@settings(max_examples=40)
@given(contents)
def test_a_store_gives_back_what_was_put_into_it(programs: dict[int, tuple[Sentence, ...]]) -> None:
    found = filled(programs)
    assert parse_store(store_text(found), "s") == found and len(found) == 8192
    assert cells.numbers_in(found) == sorted(programs)
    for number, sentences in programs.items():
        assert tuple(one for _, one in cells.program_at(found, number, "s")) == sentences
        assert decoded_store(found, number) == decoded(part_text(sentences, ""))


def test_cells_are_where_the_8031_looks_for_them() -> None:
    found = filled({1: ROW, 99: ROW[:1]})
    assert found[0:2].hex() == "00c6" and found[2:4].hex() == "ffff" and found[0xC4:0xC6].hex() == "00cd"
    assert found[0xC6:0xD1].hex() == "8104002c0400ff" + "810400ff"
    assert list(cells.cell_lines(found, 0xC6, 0xC6)) == ["00C0  FF FF FF FF 00 CD 81 04 00 2C 04 00 FF 81 04 00"]


def test_a_full_store_is_an_error_and_changes_nothing() -> None:
    room = cells.free_cells(cells.EMPTY_STORE, "ram")
    most = (room - 1) // 3
    full = cells.with_program(cells.EMPTY_STORE, 5, ROW[:1] * most, "ram")
    with pytest.raises(JobError, match="ram: full: its programs would take"):
        cells.with_program(full, 6, ROW, "ram")
    assert cells.with_program(full, 5, ROW, "ram") == filled({5: ROW})  # replaced: there is room again


def test_a_workpiece_that_is_taken_out_leaves_the_others() -> None:
    left = cells.without_program(filled({3: ROW, 4: ROW[:1]}), 3)
    assert cells.numbers_in(left) == [4]
    assert cells.program_at(left, 4, "ram") == [(0xCD, ROW[0])]


@pytest.mark.parametrize(
    ("at", "written", "reason"),
    [
        (0x00, "0000", "workpiece 01, cell 0000: begins at 0000, which is not from 00C6 to 1FFF"),
        (0x00, "2000", "workpiece 01, cell 0000: begins at 2000"),
        (0xC6, "51", "workpiece 01, cell 00C6: '510400' is no sentence: a direction is 2, 4, 6 or 8"),
        (0xC7, "0A", "workpiece 01, cell 00C7: '810A00' is no sentence: the way is four decimal digits"),
        (0xC8, "0B", "workpiece 01, cell 00C8: '81040B' is no sentence: the way is four decimal digits"),
        (0xC7, "0000", "workpiece 01, cell 00C7: '810000' is no sentence: a way of 0000 is none"),
        (0xCC, "81" * (8192 - 0xCC), "workpiece 01, cell 1FFF: has no end"),
    ],
)
def test_a_damaged_workpiece_is_refused_by_cell(at: int, written: str, reason: str) -> None:
    data = bytes.fromhex(written)
    sound = filled({1: ROW})
    damaged = sound[:at] + data + sound[at + len(data) :]
    with pytest.raises(JobError) as refused:
        cells.program_at(damaged, 1, "ram.hex")
    assert str(refused.value).startswith(f"ram.hex: {reason}")


def test_a_damaged_workpiece_keeps_no_other_from_being_read_or_taken_out() -> None:
    damaged = bytearray(filled({1: ROW, 2: ROW}))
    damaged[0xC6] = 0x11
    assert cells.program_at(bytes(damaged), 2, "ram")
    assert cells.numbers_in(cells.without_program(bytes(damaged), 1)) == [2]
    with pytest.raises(JobError, match="workpiece 01, cell 00C6"):
        cells.with_program(bytes(damaged), 3, ROW, "ram")


# What is done to the lines of a sound file, with the line (from 1) and the column at which it is refused.
Lines = list[str]


def _wrong_digit(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row, at = pick.randrange(1, 513), pick.randrange(1, 43)
    lines[row] = lines[row][:at] + pick.choice("Gg-.x ") + lines[row][at + 1 :]
    return row + 1, at + 1


def _other_digit(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row, at = pick.randrange(1, 513), pick.randrange(9, 41)
    other = pick.choice([digit for digit in "0123456789ABCDEF" if digit != lines[row][at]])
    lines[row] = lines[row][:at] + other + lines[row][at + 1 :]
    return row + 1, 42


def _row_missing(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row = pick.randrange(1, 512)
    del lines[row]
    return row + 1, 4


def _row_twice(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row = pick.randrange(1, 513)
    lines.insert(row, lines[row])
    return row + 2, 4


def _cut_short(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row = pick.randrange(1, 513)
    del lines[row:]
    return len(lines) + 1, 1


def _row_cut(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row = pick.randrange(1, 513)
    lines[row] = lines[row][: pick.randrange(1, 43)]
    return row + 1, 2


def _no_colon(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row = pick.randrange(1, 513)
    lines[row] = pick.choice(["", " ", "#", ";", "S"]) + lines[row][1:]
    return row + 1, 1


def _header(pick: random.Random, lines: Lines) -> tuple[int, int]:
    at = pick.randrange(0, len(lines[0]))
    lines[0] = lines[0][:at] + "*" + lines[0][at + 1 :]
    return 1, 1


def _other_cells(pick: random.Random, lines: Lines) -> tuple[int, int]:
    """A sound file but for its first line: the cells of another store."""
    lines[0] = f"{HEADER}{zlib.crc32(pick.randbytes(8)):08X}"
    return 1, 24


def _behind_the_end(pick: random.Random, lines: Lines) -> tuple[int, int]:
    lines[514:] = [""] * pick.randrange(0, 3) + [pick.choice([lines[5], "x", lines[513]])]
    return 515, 1


def _early_end(pick: random.Random, lines: Lines) -> tuple[int, int]:
    row = pick.randrange(1, 513)
    lines.insert(row, lines[513])
    return row + 1, 1


KINDS: tuple[Callable[[random.Random, Lines], tuple[int, int]], ...] = (
    _wrong_digit, _other_digit, _row_missing, _row_twice, _cut_short, _row_cut, _no_colon, _header, _other_cells,
    _behind_the_end, _early_end,
)  # fmt: skip


def malformed() -> Iterator[tuple[str, str, int, int]]:
    for seed in range(MALFORMED):
        pick, kind = random.Random(seed), KINDS[seed % len(KINDS)]
        lines = store_text(filled({pick.randrange(1, 100): ROW * pick.randrange(1, 200)})).split("\n")[:514]
        yield kind.__name__, *_told(lines, kind(pick, lines))


def _told(lines: Lines, place: tuple[int, int]) -> tuple[str, int, int]:
    return ("\n".join(lines), *place)


@pytest.mark.parametrize(("name", "text", "line", "column"), [*malformed()])
def test_a_malformed_store_is_refused_by_line_and_column(name: str, text: str, line: int, column: int) -> None:
    with pytest.raises(JobError) as refused:
        parse_store(text, "ram.hex")
    assert str(refused.value).startswith(f"ram.hex:{line}:{column}: ")


def test_the_ram_comes_before_the_eprom(tmp_path: Path) -> None:
    ram = tmp_path / "ram.hex"
    number = read_eprom(DRUM).numbers()[0]
    change_ram(DRUM, ram, lambda found, name: cells.with_program(found, 98, ROW, name))
    assert find_part(number, DRUM, ram).source == f"EPROM {number:02}"
    change_ram(DRUM, ram, lambda found, name: cells.with_program(found, number, ROW, name))
    assert find_part(number, DRUM, ram).source == f"RAM {number:02}"
    with pytest.raises(JobError, match=r"97: no workpiece of this number, in RAM or EPROM; there are 01 .* 98"):
        find_part(97, DRUM, ram)


def test_a_store_that_was_named_must_be_there(tmp_path: Path) -> None:
    with pytest.raises(JobError, match="can't be read: No such file"):
        read_ram(DRUM, tmp_path / "nowhere.hex")


def test_a_change_that_is_refused_leaves_the_file_as_it_was(tmp_path: Path) -> None:
    ram = tmp_path / "ram.hex"
    change_ram(DRUM, ram, lambda found, name: cells.with_program(found, 1, ROW, name))
    before = ram.read_bytes()
    with pytest.raises(JobError, match="full"):
        change_ram(DRUM, ram, lambda found, name: cells.with_program(found, 2, ROW * 1400, name))
    assert ram.read_bytes() == before and list(tmp_path.iterdir()) == [ram]


def test_a_damaged_ram_is_not_written_over(tmp_path: Path) -> None:
    ram = tmp_path / "ram.hex"
    ram.write_text("drillctl-store 1 crc32 00000000\n")
    with pytest.raises(JobError, match=r"ram\.hex:2:1: cut short"):
        change_ram(DRUM, ram, lambda found, name: cells.with_program(found, 1, ROW, name))
    assert ram.read_text() == "drillctl-store 1 crc32 00000000\n"


DEADLY = ("open", "write", "flush", "fsync", "fchmod", "rename", "close")


def killed_while_writing(ram: Path, program: tuple[Sentence, ...], at: int) -> bool:
    """Puts a program into the store in a process of its own, which is killed at its ``at``-th call of a kind that
    touches the disk; returns whether it was.
    """
    child = os.fork()
    if child == 0:
        _die_at(at)
        change_ram(DRUM, ram, lambda found, name: cells.with_program(found, 7, program, name))
        os._exit(0)
    return os.WIFSIGNALED(os.waitpid(child, 0)[1])


def _die_at(at: int) -> None:
    """Kills this process at the ``at``-th of the calls that open, fill, sync, rename or close a file of the store."""
    import sys

    calls = 0

    def watch(frame: object, event: str, called: object) -> None:
        nonlocal calls
        if event in ("c_call", "c_return") and getattr(called, "__name__", "") in DEADLY:
            calls += 1
            if calls == at:
                os.kill(os.getpid(), signal.SIGKILL)

    sys.setprofile(watch)


def outlives_kills(folder: Path, seed: int) -> None:
    """After every kill the store has its last content or the new one, and the next change finds it so."""
    pick = random.Random(seed)
    ram = folder / "ram.hex"
    good = filled({7: ROW})
    change_ram(DRUM, ram, lambda found, name: good)
    program = ROW * pick.randrange(1, 300)
    killed = killed_while_writing(ram, program, pick.randrange(1, 40))
    found = read_ram(DRUM, ram).cells
    assert found in ((good, filled({7: program})) if killed else (filled({7: program}),))
    change_ram(DRUM, ram, lambda before, name: cells.with_program(before, 8, ROW, name))
    assert read_ram(DRUM, ram).numbers() == [7, 8] and list(folder.iterdir()) == [ram]


@pytest.mark.parametrize("seed", range(30))
def test_a_store_outlives_a_kill_at_any_write(tmp_path: Path, seed: int) -> None:
    outlives_kills(tmp_path, seed)


@pytest.mark.long
@pytest.mark.timeout(1200)
def test_a_store_outlives_a_thousand_kills(tmp_path: Path) -> None:
    for seed in range(1000):
        outlives_kills(tmp_path, seed)


def test_kills_come_before_and_after_the_new_content(tmp_path: Path) -> None:
    """Else the test above would show nothing."""
    seen = set()
    good, new = filled({7: ROW}), filled({7: ROW * 2})
    for at in range(1, 60, 3):
        change_ram(DRUM, tmp_path / "ram.hex", lambda found, name: good)
        if not killed_while_writing(tmp_path / "ram.hex", ROW * 2, at):
            break
        seen.add(read_ram(DRUM, tmp_path / "ram.hex").cells)
    assert seen == {good, new}


def test_content_is_on_the_disk_before_it_is_in_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What power loss asks for, and a kill doesn't show: sync of the file, then the rename, then sync of the folder."""
    done: list[str] = []
    fsync, replace = os.fsync, Path.replace

    def synced(handle: int) -> None:
        done.append("folder" if os.path.isdir(f"/dev/fd/{handle}") else "file")
        fsync(handle)

    def renamed(self: Path, target: Path) -> Path:
        done.append("rename")
        return replace(self, target)

    monkeypatch.setattr(os, "fsync", synced)
    monkeypatch.setattr(Path, "replace", renamed)
    kept.replace(tmp_path / "f", "content")
    assert done == ["file", "rename", "folder"]


def test_the_shipped_eprom_runs_on_its_machine() -> None:
    from drillctl.generation.boiler_drum.program import part_program, tool_in_wall

    eprom = stores.read_eprom(DRUM)
    assert len(eprom.numbers()) >= 4 and eprom.damages() == []
    for number in eprom.numbers():
        part = eprom.part(number)
        assert part is not None and len(part_program(part, DRUM)) > 4 and tool_in_wall(part, DRUM) == []

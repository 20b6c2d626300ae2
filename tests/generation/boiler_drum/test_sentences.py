"""Part programs: read, written, refused by line and column, run within the travel."""

import random
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.generation.boiler_drum.gears import GEARS_MM_MIN, gear_rows, interval_ticks
from drillctl.generation.boiler_drum.program import gear_not_kept, moves, part_program, tool_in_wall
from drillctl.generation.boiler_drum.sentence import DIRECTIONS, LONGEST_TENTHS, Sentence, way
from drillctl.generation.boiler_drum.text import LONGEST_LINE, MOST_SENTENCES, parse_part, part_text, read_part
from drillctl.generation.errors import JobError
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.kmd import Op
from drillctl.language import words
from drillctl.language.words import translated
from drillctl.machine import Library, shipped_tables
from tests.support.sentences import SPEEDS, decoded

DRUM = Library((shipped_tables(),)).machine("boiler-drum")
PCB = Library((shipped_tables(),)).machine("pcb-drill")
HEX = "0123456789ABCDEF"
MALFORMED = 200

sentences = st.builds(Sentence, st.sampled_from(sorted(DIRECTIONS)), st.integers(0, 15), st.integers(1, LONGEST_TENTHS))
programs = st.lists(sentences, min_size=1, max_size=30).map(tuple)


@given(programs)
def test_the_reader_reads_what_the_writer_writes(program: tuple[Sentence, ...]) -> None:
    assert parse_part(part_text(program, "a program"), "p").sentences == program


@given(programs)
def test_moves_are_what_an_independent_reading_gives(program: tuple[Sentence, ...]) -> None:
    part = parse_part(part_text(program, "a program"), "p")
    x, y = DRUM.axis_names.index("x"), DRUM.axis_names.index("y")
    found = [(move.steps * (move.axis == x), move.steps * (move.axis == y)) for move in moves(part, DRUM)]
    assert found == [row[:2] for row in decoded(part_text(program, ""))]


def test_comments_blank_lines_and_small_letters_are_read() -> None:
    part = parse_part("\ufeff# a drum\r\n\r\n  6f0010 # on\r\n8A9999\n".removeprefix("\ufeff"), "p")
    assert [str(one) for one in part.sentences] == ["6F0010", "8A9999"]
    assert part.lines == (3, 4)


# One character or line that is wrong, each with the column at which it is; a line of the text is 1 + where it stands.
def _direction(pick: random.Random) -> tuple[str, int]:
    return pick.choice("01357 9AxZ\u0662".replace(" ", "")) + _good(pick)[1:], 1


def _gear(pick: random.Random) -> tuple[str, int]:
    good = _good(pick)
    return good[0] + pick.choice("GgXZ-.\u0661") + good[2:], 2


def _digit(pick: random.Random) -> tuple[str, int]:
    good, at = _good(pick), pick.randrange(2, 6)
    return good[:at] + pick.choice("AF-+.,x\u0663") + good[at + 1 :], at + 1


def _no_way(pick: random.Random) -> tuple[str, int]:
    return _good(pick)[:2] + "0000", 3


def _short(pick: random.Random) -> tuple[str, int]:
    length = pick.randrange(1, 6)
    return _good(pick)[:length], length + 1


def _long(pick: random.Random) -> tuple[str, int]:
    return _good(pick) + "0" * pick.randrange(1, 9), 7


def _two(pick: random.Random) -> tuple[str, int]:
    gap = " " * pick.randrange(1, 5)
    return f"{_good(pick)}{gap}{_good(pick)}", 7 + len(gap)


def _endless(pick: random.Random) -> tuple[str, int]:
    return "# " + "x" * LONGEST_LINE, LONGEST_LINE + 1


KINDS: tuple[Callable[[random.Random], tuple[str, int]], ...] = (
    _direction, _gear, _digit, _no_way, _short, _long, _two, _endless
)  # fmt: skip


def _good(pick: random.Random) -> str:
    return f"{pick.choice('2468')}{pick.choice(HEX)}{pick.randrange(1, 10000):04}"


def malformed() -> Iterator[tuple[str, str, int, int]]:
    """Name, text, line and column of the fault: kinds in turn, at random lines of good programs, indented or not."""
    for seed in range(MALFORMED):
        pick = random.Random(seed)
        kind = KINDS[seed % len(KINDS)]
        wrong, column = kind(pick)
        indent = 0 if kind is _endless else pick.randrange(0, 3)
        lines = [_good(pick) for _ in range(pick.randrange(0, 6))]
        at = pick.randrange(0, len(lines) + 1)
        lines.insert(at, " " * indent + wrong)
        yield kind.__name__, "\n".join(lines), at + 1, column + indent


@pytest.mark.parametrize(("name", "text", "line", "column"), [*malformed()])
def test_a_malformed_sentence_is_refused_by_line_and_column(name: str, text: str, line: int, column: int) -> None:
    with pytest.raises(JobError) as refused:
        parse_part(text, "part.sentences")
    assert len(refused.value.messages) == 1
    assert str(refused.value).startswith(f"part.sentences:{line}:{column}: ")


def test_every_wrong_line_is_named() -> None:
    with pytest.raises(JobError) as refused:
        parse_part("6F0010\n5F0010\n6F0010\n6G0010\n", "p")
    assert [message.line for message in refused.value.messages] == [2, 4]


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "p.sentences:1:1: no sentence in it"),
        (b"# nothing\n", "p.sentences:1:1: no sentence in it"),
        (b"6F0010\n  \xff\n", "p.sentences:2:3: not UTF-8 text"),
        (b"6F0010\n" * (MOST_SENTENCES + 1), f"p.sentences:{MOST_SENTENCES + 1}:1: more than {MOST_SENTENCES}"),
        (b"#" * (1024 * 1024 + 1), "p.sentences: can't be read: larger than 1 MiB: not a part program"),
    ],
)
def test_a_file_that_is_no_part_program_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, data: bytes, reason: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("p.sentences").write_bytes(data)
    with pytest.raises(JobError) as refused:
        read_part(Path("p.sentences"))
    assert str(refused.value).startswith(reason)


def test_a_program_that_leaves_the_travel_is_refused_by_line() -> None:
    lowest, highest = DRUM.reach(1)
    inside, beyond = highest // 5, highest // 5 + 1
    text = f"# tool\n8F{inside:04}\n2F{inside:04}\n8F{beyond:04}\n2F{beyond:04}\n2F{-lowest // 5 + 1:04}\n"
    with pytest.raises(JobError) as refused:
        part_program(parse_part(text, "p"), DRUM)
    first, second = str(refused.value).splitlines()
    assert first.startswith(f"p:4: the small carriage would be at {beyond / 10:.1f} mm; it goes from ")
    assert second.startswith("p:6: the small carriage would be at -")


def test_a_machine_whose_steps_do_not_fit_the_unit_is_refused_by_name() -> None:
    with pytest.raises(JobError, match=r"pcb-drill: 0\.1 mm, the unit of sentences, is no whole number of steps"):
        part_program(parse_part("6F0010", "p"), PCB)


def test_the_carriage_that_moves_with_the_tool_in_the_wall_is_warned_about() -> None:
    surface = DRUM.board_surface[1]
    assert surface is not None
    at_wall = surface // 5
    out = parse_part(f"8F{at_wall:04}\n6F0100\n", "p")
    within = parse_part(f"8F{at_wall + 10:04}\n6F0100\n", "p")
    assert tool_in_wall(out, DRUM) == []
    assert [str(one) for one in tool_in_wall(within, DRUM)] == [
        "p:2: the large carriage moves with the tool 1.0 mm in the wall"
    ]


def test_a_gear_that_coarse_ticks_do_not_keep_is_warned_about() -> None:
    part = parse_part("640010\n8F0020\n", "p")
    assert gear_not_kept(part, DRUM) == []
    (said,) = gear_not_kept(part, DRUM.at_rate(1000))
    assert str(said) == "p:2: gear F is 5 m/min; at 1000 ticks a second it runs at 1.2 m/min"


def test_a_sentence_is_one_move_with_its_number_and_its_gear(tmp_path: Path) -> None:
    (tmp_path / "p.sentences").write_text("8F0010\n8F0020\n610300\n")
    program = load_job(tmp_path / "p.sentences", DRUM, JobSetup(DRUM.name)).program
    kept = program[program["opcode"] == Op.RUCH_D]
    assert kept["tag"].tolist() == [1, 2, 3]
    assert kept["floor_ticks"].tolist() == [interval_ticks(gear, DRUM.axes[0], DRUM.tick_hz) for gear in (15, 15, 1)]
    assert kept["args"][:, :2].tolist() == [[0, 50], [0, 100], [1500, 0]]
    assert program["opcode"][0] == Op.INICJALIZACJA and program["opcode"][-1] == Op.KONIEC


def test_gears_are_the_speeds_of_the_paper_to_the_nearest_tick() -> None:
    assert [f"{speed / 1000:g}" for speed in GEARS_MM_MIN] == [*SPEEDS]
    fine = DRUM.at_rate(100_000)
    rows = list(gear_rows(fine.axes[0], fine))
    assert rows[15].ticks == 24 and max(abs(row.error) for row in rows) < 0.003
    assert [round(row.hz, 1) for row in rows[::15]] == [133.3, 4166.7]


@pytest.mark.parametrize("tenths", [1, -1, LONGEST_TENTHS, LONGEST_TENTHS + 1, -3 * LONGEST_TENTHS, 40_000])
def test_a_long_way_is_several_sentences(tenths: int) -> None:
    made = way("x", tenths, 3)
    assert sum(one.signed_tenths for one in made) == tenths
    assert all(1 <= one.tenths <= LONGEST_TENTHS and one.axis == "x" and one.gear == 3 for one in made)


def test_a_sentence_in_both_languages() -> None:
    said = Sentence("8", 15, 1234).words()
    assert said == "small carriage on (tool in) by 123.4 mm, gear F (5 m/min)"
    words.use("pl")
    try:
        assert translated(said) == "sanie poprzeczne w przód (narzędzie w głąb) o 123.4 mm, bieg F (5 m/min)"
    finally:
        words.use("en")

"""The text form of a queue, both ways, and everything that can be wrong with it: line, column, reason."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from drillctl.kmd import RECORD, KmdError, Names, Op, parse_program, program_texts, to_text
from drillctl.kmd.commands import BY_OP, MOST_ARGUMENT, ArgumentForm

NAMES = Names(("x", "y", "z"), {"spindle": 18, "clamp": 40}, {"x_min": 0, "z_top": 4})
INTEGERS = st.integers(-MOST_ARGUMENT, MOST_ARGUMENT)
NATURALS = st.integers(0, MOST_ARGUMENT)
AXES = st.lists(st.sampled_from(NAMES.axes), max_size=3, unique=True)
HEADS = AXES.flatmap(lambda axes: st.tuples(*(st.sampled_from([axis, f"{axis}=0", f"{axis}=7"]) for axis in axes)))
ARGUMENTS = {
    ArgumentForm.NOTHING: st.just([]),
    ArgumentForm.XY: st.tuples(INTEGERS, INTEGERS),
    ArgumentForm.MOVES: AXES.filter(bool).flatmap(
        lambda axes: st.tuples(*(INTEGERS.map(f"{a}={{}}".format) for a in axes))
    ),
    ArgumentForm.AXES: AXES,
    ArgumentForm.HEADS: HEADS,
    ArgumentForm.XY_HEADS: st.tuples(INTEGERS, INTEGERS, st.sampled_from(["", "z", "z=7"])),
    ArgumentForm.NUMBER: st.tuples(NATURALS),
    ArgumentForm.OUTPUT: st.tuples(st.sampled_from(sorted(NAMES.outputs)), st.sampled_from([0, 1])),
    ArgumentForm.INPUT: st.tuples(
        st.sampled_from(sorted(NAMES.inputs)), st.sampled_from([0, 1]), NATURALS.filter(bool)
    ),
}
SPECS = [spec for spec in BY_OP.values() if spec.op is not Op.KONIEC]
LINES = st.sampled_from(SPECS).flatmap(
    lambda spec: ARGUMENTS[spec.form].map(lambda words: " ".join([spec.name, *map(str, words)]))
)


def written(program: NDArray[np.void]) -> str:
    return "\n".join(to_text(record, NAMES) for record in program)


@given(st.lists(LINES, min_size=1, max_size=12))
@settings(max_examples=300, deadline=None)
def test_program_to_text_to_program(lines: list[str]) -> None:
    program = parse_program("\n".join(lines), NAMES)
    again = parse_program(written(program), NAMES)
    assert program.dtype == again.dtype == RECORD
    assert program.tobytes() == again.tobytes()


def test_intervals_of_heads_that_are_all_meant_are_written_with_their_names() -> None:
    """Planning leaves the mask empty; read back, the same heads have the same intervals."""
    names = Names(("x", "y", "z1", "z2"), heads=("z1", "z2"))
    program = parse_program("KMD_WIERTLO_DOL z1=2 z2\nKMD_GORA_X_Y 5 6 z1=3 z2\nKMD_DOTYK\nKMD_GORA_X_Y 5 6", names)
    named = program.copy()
    program["axes"] &= 0b11
    texts = list(program_texts(program, names))
    assert texts[:4] == ["KMD_WIERTLO_DOL z1=2 z2", "KMD_GORA_X_Y 5 6 z1=3 z2", "KMD_DOTYK", "KMD_GORA_X_Y 5 6"]
    assert parse_program("\n".join(texts), names).tobytes() == named.tobytes()


@given(st.lists(LINES, min_size=1, max_size=4), st.integers(1, 3))
@settings(max_examples=100, deadline=None)
def test_texts_of_a_program_are_those_of_its_commands(lines: list[str], times: int) -> None:
    """Commands that come again with another number and hole, too."""
    program = parse_program("\n".join(lines * times), NAMES)
    program["tag"] = np.arange(len(program))
    before = program.tobytes()
    assert "\n".join(program_texts(program, NAMES)) == written(program)
    assert program.tobytes() == before


@given(st.lists(LINES, min_size=1, max_size=6), st.data())
@settings(max_examples=100, deadline=None)
def test_blanks_comments_and_line_ends_say_nothing(lines: list[str], data: st.DataObject) -> None:
    """Axes in another order, tabs, remarks, DOS line ends, a byte order mark: the same program."""
    noise = st.sampled_from(["", " ", "\t", "   # remark", "# KMD_KONIEC", " #\u2028 x"])
    noisy = [f" {line.replace(' ', data.draw(st.sampled_from(['  ', chr(9)])))} {data.draw(noise)}" for line in lines]
    text = "\ufeff# a queue\r\n\r\n" + "\r\n".join(noisy) + "\r\n"
    assert parse_program(text, NAMES).tobytes() == parse_program("\n".join(lines), NAMES).tobytes()


def test_sequence_counts_from_1_and_the_end_is_added() -> None:
    program = parse_program("KMD_BAZA\nKMD_CZEKAJ 5", NAMES)
    assert program["sequence"].tolist() == [1, 2, 3]
    assert program["opcode"].tolist() == [Op.BAZA, Op.CZEKAJ, Op.KONIEC]
    assert parse_program("KMD_BAZA\nKMD_CZEKAJ 5\nKMD_KONIEC # done\n\n# over", NAMES).tobytes() == program.tobytes()


def test_a_speed_is_a_floor_under_the_moves_that_follow_and_under_nothing_else() -> None:
    text = "KMD_RUCHd x=1\nKMD_PREDKOSC 9\nKMD_RUCHd x=1\nKMD_CZEKAJ 1\nKMD_WIERTLO_DOL\nKMD_PREDKOSC 0\nKMD_LINIA y=2"
    assert parse_program(text, NAMES)["floor_ticks"].tolist() == [0, 0, 9, 0, 9, 0, 0, 0]


def test_axis_names_fill_mask_and_arguments_by_index() -> None:
    program = parse_program("KMD_RUCH z=-7 x=+3\nKMD_WIERTLO_DOL z\nKMD_GOTO_X_Y 5 -6", NAMES)
    assert program["axes"].tolist() == [0b101, 0b100, 0b011, 0]
    assert program["args"][:, :3].tolist() == [[3, 0, -7], [0, 0, 0], [5, -6, 0], [0, 0, 0]]


@pytest.mark.parametrize(
    ("text", "line", "column", "reason"),
    [
        ("", 1, 1, "no command in it; a queue that does nothing is KMD_KONIEC alone"),
        ("\n# nothing but this\n", 1, 1, "no command in it; a queue that does nothing is KMD_KONIEC alone"),
        ("KMD_BAZA\n  KMD_BASA", 2, 3, "unknown command 'KMD_BASA'; did you mean KMD_BAZA?"),
        ("kmd_baza", 1, 1, "unknown command 'kmd_baza'; did you mean KMD_BAZA?"),
        ("GOTO_X_Y 1 2", 1, 1, "unknown command 'GOTO_X_Y'; did you mean KMD_GOTO_X_Y?"),
        ("KMD_FOO", 1, 1, "unknown command 'KMD_FOO'"),
        ("\ufeffKMD_FOO", 1, 1, "unknown command 'KMD_FOO'"),
        ("x" * 900, 1, 1, f"unknown command '{'x' * 40}'"),
        ("KMD_KONIEC\n\nKMD_BAZA", 3, 1, "nothing may follow KMD_KONIEC"),
        ("KMD_KONIEC 1", 1, 12, "1 argument; it is written KMD_KONIEC"),
        ("KMD_GOTO_X_Y 1", 1, 1, "1 argument; it is written KMD_GOTO_X_Y X Y"),
        ("KMD_GOTO_X_Y 1 2 3", 1, 18, "3 arguments; it is written KMD_GOTO_X_Y X Y"),
        ("KMD_GOTO_X_Y 1 2.5", 1, 16, "'2.5' is not a whole number"),
        ("KMD_GOTO_X_Y 1 2147483648", 1, 16, "'2147483648' is not a whole number"),
        ("KMD_GOTO_X_Y 1 -2147483648", 1, 16, "'-2147483648' is not a whole number"),
        ("KMD_GOTO_X_Y 1 99999999999999", 1, 16, "'99999999999999' is not a whole number"),
        ("KMD_GOTO_X_Y 1 \u0665", 1, 16, "'\u0665' is not a whole number"),
        ("KMD_RUCH", 1, 1, "0 arguments; it is written KMD_RUCH axis=steps ..."),
        ("KMD_RUCH 5", 1, 10, "'5' is not axis=steps"),
        ("KMD_RUCH x=", 1, 12, "'' is not a whole number"),
        ("KMD_RUCH =5", 1, 10, "no axis is named ''; there are x, y, z"),
        ("KMD_RUCH x=1 x=2", 1, 14, "axis x is named twice"),
        ("KMD_RUCH x=1 w=2", 1, 14, "no axis is named 'w'; there are x, y, z"),
        ("KMD_RUCH x=1 z=two", 1, 16, "'two' is not a whole number"),
        ("KMD_WIERTLO_DOL z w", 1, 19, "no axis is named 'w'; there are x, y, z"),
        ("KMD_WIERTLO_GORA z=-1", 1, 20, "'-1' is not a whole number from 0"),
        ("KMD_WIERTLO_DOL z z=2", 1, 19, "axis z is named twice"),
        ("KMD_GORA_X_Y 1", 1, 1, "1 argument; it is written KMD_GORA_X_Y X Y [axis[=ticks] ...]"),
        ("KMD_GORA_X_Y 1 2 x=3", 1, 18, "x is no head"),
        ("KMD_GORA_X_Y 1 2 z=3 w", 1, 22, "no axis is named 'w'; there are x, y, z"),
        ("KMD_CZEKAJ -1", 1, 12, "'-1' is not a whole number from 0"),
        ("KMD_CZEKAJ", 1, 1, "0 arguments; it is written KMD_CZEKAJ ticks"),
        ("KMD_WYJSCIE fan 1", 1, 13, "no output is named 'fan'; there are spindle, clamp"),
        ("KMD_WYJSCIE spindle 2", 1, 21, "'2' is not 0 or 1"),
        ("KMD_CZEKAJ_WE spindle 1 5", 1, 15, "no input is named 'spindle'; there are x_min, z_top"),
        ("KMD_CZEKAJ_WE x_min 1 0", 1, 23, "'0' is not a whole number from 1"),
        ("KMD_CZEKAJ_WE x_min 1", 1, 1, "2 arguments; it is written KMD_CZEKAJ_WE input 0|1 timeout"),
        ("KMD_BAZA\n" + " " * 1001, 2, 1001, "a line of more than 1000 characters"),
    ],
)  # fmt: skip
def test_errors_name_line_column_and_reason(text: str, line: int, column: int, reason: str) -> None:
    with pytest.raises(KmdError) as refused:
        parse_program(text, NAMES, "q.kmd")
    assert (refused.value.line, refused.value.column, refused.value.reason) == (line, column, reason)
    assert str(refused.value) == f"q.kmd:{line}:{column}: {reason}"


def test_only_heads_are_raised_before_x_and_y_start() -> None:
    """A machine's names tell which axes drill."""
    table = Names(("x", "y", "z", "w"), heads=("z",))
    assert parse_program("KMD_GORA_X_Y 1 2 z", table)["axes"][0] == 0b111
    for names, text, reason in (
        (table, "KMD_GORA_X_Y 1 2 w", "w is no head"),
        (Names(("x", "y"), heads=("y",)), "KMD_GORA_X_Y 1 2", "y is a head of this machine"),
    ):
        with pytest.raises(KmdError, match=reason):
            parse_program(text, names)


def test_a_machine_without_such_names_says_so() -> None:
    bare = Names(("z",))
    for text, reason in (
        ("KMD_WYJSCIE spindle 1", "no output is named 'spindle'; this machine has none"),
        ("KMD_GOTO_X_Y 1 2", "no axis is named 'x'; there are z"),
    ):
        with pytest.raises(KmdError, match=reason):
            parse_program(text, bare)


@given(st.text(max_size=80) | st.lists(st.sampled_from([*(s.name for s in SPECS), *"x=1 - \n 7 #"])).map(" ".join))
@settings(max_examples=400, deadline=None)
def test_any_text_is_a_program_or_a_kmd_error(text: str) -> None:
    try:
        program = parse_program(text, NAMES)
    except KmdError as error:
        assert error.line >= 1 and error.column >= 1 and "\n" not in error.reason
    else:
        assert program["opcode"][-1] == Op.KONIEC

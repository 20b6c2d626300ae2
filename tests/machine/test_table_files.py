"""Table files as files: what can't be read is refused by name, and the first folder that has a table wins."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.machine import Library, TableError, shipped_tables
from drillctl.machine.source import LARGEST_TABLE_BYTES

SHIPPED = shipped_tables()
Tables = Callable[..., Path]


def empty(file: Path) -> None:
    file.write_bytes(b"")


def comment(file: Path) -> None:
    file.write_text("# [[wire]] and [[axis]] stand in a comment only\n")


def huge(file: Path) -> None:
    file.write_bytes(b"#" * (LARGEST_TABLE_BYTES + 1))


def latin(file: Path) -> None:
    file.write_bytes(b'name = "beat"\n# Gda\xf1sk\n')


def folder(file: Path) -> None:
    file.mkdir()


def loop(file: Path) -> None:
    file.symlink_to(file)


def missing(file: Path) -> None:
    assert not file.exists()


NOT_A_TABLE = "no table of this program: a phase table has [[wire]], a ramp [[state]], a motor [windings]"


@pytest.mark.parametrize(
    ("make", "reason", "line"),
    [
        (empty, NOT_A_TABLE, None),
        (comment, NOT_A_TABLE, None),
        (huge, "can't be read: larger than 1 MiB: not a table", None),
        (latin, "not UTF-8 text, so not a table", 2),
        (folder, "can't be read: Is a directory", None),
        (loop, "can't be read: Too many levels of symbolic links", None),
        (missing, "can't be read: No such file or directory", None),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_unreadable(make: Callable[[Path], None], reason: str, line: int | None, tmp_path: Path) -> None:
    file = tmp_path / "some.toml"
    make(file)
    library = Library((tmp_path,))
    with pytest.raises(TableError) as refused:
        library.check(file)
    assert refused.value.reason.startswith(reason) and refused.value.line == line
    with pytest.raises(TableError) as refused:
        library.machine(str(file))
    assert refused.value.file == str(file)


@pytest.mark.skipif(sys.platform != "linux", reason="needs /dev/zero")
def test_an_endless_file_is_not_read_to_its_end() -> None:
    with pytest.raises(TableError, match="a pipe or a device, not a file"):
        Library(()).check(Path("/dev/zero"))


@pytest.mark.parametrize("name", ["mini2", "..", "a" * 300, "mini\0"])
def test_no_machine_of_this_name(name: str, tables: Tables, tmp_path: Path) -> None:
    tables()
    with pytest.raises(TableError, match=r"no machine of this name; there are mini(; did you mean mini\?)?$"):
        Library((tmp_path,)).machine(name)


def test_a_name_never_leaves_its_folder(tables: Tables, tmp_path: Path) -> None:
    """With a slash it is a file's path, and meant as one."""
    tables()
    (tmp_path / "inner").mkdir()
    with pytest.raises(TableError, match=r"^\.\./mini: can't be read"):
        Library((tmp_path / "inner",)).machine("../mini")


@pytest.mark.parametrize("change", [lambda text: "\ufeff" + text, lambda text: text.replace("\n", "\r\n")])
def test_editors_marks_and_line_ends_do_no_harm(change: Callable[[str], str], tables: Tables, tmp_path: Path) -> None:
    file = tables()
    plain, text = Library((tmp_path,)).machine("mini"), file.read_text()
    file.write_bytes(change(text).encode())
    assert Library((tmp_path,)).machine("mini").digest == plain.digest
    file.write_bytes(change(text.replace("start = 100", "start = 5000")).encode())
    with pytest.raises(TableError) as refused:
        Library((tmp_path,)).machine("mini")
    assert refused.value.line == 15


def test_a_line_separator_in_a_comment_is_no_line_end(tables: Tables, tmp_path: Path) -> None:
    tables(old="tick_hz", new="# one\u2028line\x85only\ntick_hz")
    file = tmp_path / "machines/mini.toml"
    file.write_text(file.read_text().replace("start = 100", "start = 5000"))
    with pytest.raises(TableError) as refused:
        Library((tmp_path,)).machine("mini")
    assert refused.value.line == 16


def test_the_first_folder_wins_table_by_table(tables: Tables, tmp_path: Path) -> None:
    tables()
    edited = tmp_path / "edited"
    (edited / "ramp").mkdir(parents=True)
    text = (tmp_path / "ramp/gentle.toml").read_text()
    (edited / "ramp/gentle.toml").write_text(text.replace("interval = 5", "interval = 8"))
    assert Library((tmp_path,)).machine("mini").axes[0].ramp.interval[0] == 5
    assert Library((edited, tmp_path)).machine("mini").axes[0].ramp.interval[0] == 8
    assert Library((edited, tmp_path)).machine("mini").axes[0].phase.name == "beat"


def test_a_machine_given_by_its_file_brings_the_tables_beside_it(tables: Tables) -> None:
    file = tables()
    assert Library(()).machine(str(file)).axes[0].ramp.name == "gentle"
    moved = file.rename(file.parent.parent / "mini.toml")
    assert Library(()).machine(str(moved)).axes[0].ramp.name == "gentle"


@pytest.mark.parametrize("file", sorted(SHIPPED.rglob("*.toml")), ids=lambda file: f"{file.parent.name}/{file.stem}")
def test_every_shipped_table_is_sound_and_safe(file: Path) -> None:
    assert Library((SHIPPED,)).check(file) == []


def test_a_table_of_a_kind_is_told_by_its_keys_not_by_its_comments(tables: Tables, tmp_path: Path) -> None:
    file = tables("ramp/gentle", 'name = "gentle"', 'name = "gentle" # see [[wire]] in the phase table')
    assert Library((tmp_path,)).check(file) == []


def test_a_motor_may_be_named(tables: Tables, tmp_path: Path) -> None:
    tables(old="start = 100", new='motor = "three"')
    assert Library((tmp_path,)).machine("mini").axes[0].motor.name == "three"


def test_a_motor_must_find_its_wires(tables: Tables, tmp_path: Path) -> None:
    tables(old="start = 100", new='motor = "four"')
    text = (tmp_path / "motor/three.toml").read_text()
    (tmp_path / "motor/four.toml").write_text(text + "d = 300\n")
    with pytest.raises(TableError, match=r"mini.toml:15: motor four needs wires d; table beat has none"):
        Library((tmp_path,)).machine("mini")


def test_no_motor_fits(tables: Tables, tmp_path: Path) -> None:
    tables("motor/three", "c = 240\n", "")
    with pytest.raises(TableError, match=r"mini.toml:8: no motor has just the wires a, b, c; name one"):
        Library((tmp_path,)).machine("mini")

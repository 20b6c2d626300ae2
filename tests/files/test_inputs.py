"""The door of the inputs: opening never waits, only files are opened, a read stops at its limit."""

import errno
import io
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.files.inputs import json_of, opened, read_bytes, read_start, real_path, toml_of

PACKAGE = Path(__file__).resolve().parents[2] / "drillctl"
BLINKER = PACKAGE.parent / "examples" / "blinker.drl"
PROGRAM = [sys.executable, "-m", "drillctl"]
LIMIT = 1000


def _pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe")
    return folder / "pipe"


def _link_to_pipe(folder: Path) -> Path:
    (folder / "link").symlink_to(_pipe(folder))
    return folder / "link"


def _link_to_device(folder: Path) -> Path:
    (folder / "link").symlink_to("/dev/zero")
    return folder / "link"


def _loop(folder: Path) -> Path:
    (folder / "loop").symlink_to(folder / "loop")
    return folder / "loop"


def _sparse(folder: Path) -> Path:
    with (folder / "sparse").open("wb") as file:
        file.truncate(1 << 30)
    return folder / "sparse"


KINDS: list[tuple[Callable[[Path], Path | str], int, str]] = [
    (_pipe, errno.EINVAL, "a pipe or a device, not a file"),
    (_link_to_pipe, errno.EINVAL, "a pipe or a device, not a file"),
    (_link_to_device, errno.EINVAL, "a pipe or a device, not a file"),
    (lambda _: "/dev/zero", errno.EINVAL, "a pipe or a device, not a file"),
    (lambda folder: folder, errno.EISDIR, "Is a directory"),
    (_loop, errno.ELOOP, ""),
    (_sparse, errno.EFBIG, "larger than 1 KiB: not a page"),
    (lambda folder: folder / "none", errno.ENOENT, ""),
    (lambda _: "a\0b", errno.EINVAL, "no name that a file can have"),
    (lambda _: "a\ud800b", errno.EINVAL, "no name that a file can have"),
    (lambda _: "/proc/self/environ", errno.EFBIG, "larger than 1 KiB: not a page"),
]


@pytest.mark.parametrize(("kind", "code", "why"), KINDS)
def test_what_is_no_file_or_too_large_is_refused(
    kind: Callable[[Path], Path | str], code: int, why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing here waits. The last one is a file that says of itself that it has 0 bytes."""
    place = kind(tmp_path)
    if place == "/proc/self/environ":
        size = len(subprocess.run(["cat", place], capture_output=True, check=True).stdout)
        assert os.stat(place).st_size == 0 and size > 0
        limit = 1 if size < LIMIT else LIMIT
    else:
        limit = LIMIT
    with pytest.raises(OSError) as refused:
        read_bytes(place, limit, "a page")
    assert refused.value.errno == code and why in str(refused.value.strerror)
    assert refused.value.filename == os.fspath(place)


@pytest.mark.parametrize("size", [0, 1, LIMIT - 1, LIMIT])
def test_up_to_its_limit_a_file_is_read_whole(size: int, tmp_path: Path) -> None:
    data = bytes(range(256)) * 4
    (tmp_path / "file").write_bytes(data[:size])
    assert read_bytes(tmp_path / "file", LIMIT, "a page") == data[:size]
    assert read_start(tmp_path / "file", 10) == data[:size][:10]
    with opened(tmp_path / "file", LIMIT) as stream:
        assert stream.read() == data[:size]


def test_a_stream_ends_with_an_error_beyond_its_limit(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"line\n" * 1000)
    with io.TextIOWrapper(opened(tmp_path / "file", LIMIT)) as text, pytest.raises(OSError) as refused:
        list(text)
    assert refused.value.errno == errno.EFBIG


def test_no_descriptor_is_left_behind(tmp_path: Path) -> None:
    before = len(os.listdir("/proc/self/fd")) if Path("/proc/self/fd").exists() else 0
    for place in (tmp_path, _pipe(tmp_path)):
        with pytest.raises(OSError):
            opened(place)
    assert not before or len(os.listdir("/proc/self/fd")) == before


@pytest.mark.parametrize("name", ["/dev/stdin", "/dev/fd/0"])
def test_standard_input_may_be_a_pipe(name: str) -> None:
    call = [*PROGRAM, "inspect", name]
    told = subprocess.run(call, input=BLINKER.read_bytes(), capture_output=True, timeout=60, check=False)
    assert told.returncode == 0, told.stderr


def test_another_pipe_is_not_standard_input() -> None:
    reading, writing = os.pipe()
    with pytest.raises(OSError, match="a pipe or a device"):
        opened(f"/dev/fd/{reading}")
    os.close(reading)
    os.close(writing)


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000])
def test_json_nested_too_deeply_is_a_value_error(text: str) -> None:
    with pytest.raises(ValueError):
        json_of(text)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a = " + "[" * 100_000, "nested too deeply"),
        ("a = " + "{b = " * 50_000, "nested too deeply"),
        ("a = " + "9" * 6000, "a number of thousands of digits"),
        *((f"a = 0{base}{digit * 5000}", "a number of thousands of digits") for base, digit in ("xf", "o7", "b1")),
        ("b = 1\n" + "a." * 100_000 + "a = 1", "a key of more than 32 parts in line 2"),
        ("b = 1\n[" + "'a' . " * 40_000 + "a]", "a key of more than 32 parts in line 2"),
        ("b = {" + '"a".' * 40_000 + "a = 1}", "a key of more than 32 parts in line 1"),
    ],
)  # fmt: skip
def test_toml_that_would_stop_the_parser_is_a_value_error(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        toml_of(text)


def test_dots_in_words_are_no_long_key() -> None:
    """The rows of a phase table are dots."""
    assert toml_of('a = ["x.x.x", "' + "x." * 40 + '"] # ' + "a." * 40)["a"][0] == "x.x.x"


def test_a_loop_of_links_has_a_real_path(tmp_path: Path) -> None:
    assert real_path(_loop(tmp_path)).name == "loop"


# What opens files by itself, and why it may.
ELSEWHERE = {
    "cli.streams": "standard streams",
    "jobs.journal.writer": "the journal that it writes, and the folder it lies in",
    "kmd.channel": "the mapped file between our own processes",
    "lab.sweep": "the results that it writes",
    "portio.mapped": "the card's file, which it writes",
    "portio.pcl720": "a device",
    "files.scratch": "temporary files that it makes, and the folders they lie in",
    "trace.target": "what it writes",
    "files.outputs": "what it writes",
    "files.system": "folders, to lock them or to write their names to the disk",
    "ui.report.page": "its own style and script, which come with the program",
}
OPENING = r"""(?<![\w.])(?<!def )open\(|\bos\.(?:open|fdopen)\(|\.open\("|\.read_(?:text|bytes)\("""
PARSING = r"\b(?:tomllib|json)\.loads?\("
OPENS = re.compile(f"{OPENING}|{PARSING}")


def test_every_module_reads_through_the_door() -> None:
    found = set()
    for module in PACKAGE.rglob("*.py"):
        if module.name != "inputs.py" and OPENS.search(module.read_text("utf-8")):
            found.add(".".join(module.relative_to(PACKAGE).with_suffix("").parts))
    assert found == set(ELSEWHERE)


@pytest.mark.parametrize("line", ["with open(file):", 'path.open("rb")', "path.read_text()", "tomllib.loads(text)"])
def test_a_module_that_opens_by_itself_would_be_seen(line: str) -> None:
    assert OPENS.search(line)


def test_a_results_file_that_is_a_pipe_is_refused(tmp_path: Path) -> None:
    asked = ["sweep", "--axis", "x", "--out", str(_pipe(tmp_path))]
    told = subprocess.run([*PROGRAM, *asked], capture_output=True, timeout=60, text=True, check=False)
    assert told.returncode == 2 and "a pipe or a device" in told.stderr

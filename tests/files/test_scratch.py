"""Files for as long as a run: nobody else's, never through a link, and swept once their run is gone."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.files import scratch
from drillctl.files.outputs import reserved
from drillctl.kmd.channel import Channel

pytestmark = pytest.mark.paced

HOLDER = """
import sys, time
from pathlib import Path
from drillctl.files.scratch import Folder
from drillctl.files.outputs import reserved
with reserved([Path(sys.argv[1])], []), Folder() as folder:
    (folder / "status").write_text("")
    print(folder, flush=True)
    time.sleep(60)
"""
WAIT = "KMD_INICJALIZACJA\nKMD_CZEKAJ 100000\nKMD_KONIEC\n"
PATIENCE_S = 30.0


@pytest.fixture(autouse=True)
def own_temporary_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The system's folder of temporary files, for this test alone, for the processes it starts too."""
    place = tmp_path / "tmp"
    place.mkdir()
    monkeypatch.setenv("TMPDIR", str(place))
    monkeypatch.setattr(tempfile, "tempdir", None)
    return place


def left(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir() if file.name.endswith(scratch.MARK))


def until(come: Callable[[], bool]) -> None:
    give_up_s = time.monotonic() + PATIENCE_S
    while not come():
        assert time.monotonic() < give_up_s
        time.sleep(0.02)


def holder(place: Path) -> "subprocess.Popen[str]":
    """A process that has reserved an output and has a folder."""
    call = [sys.executable, "-c", HOLDER, str(place)]
    process = subprocess.Popen(call, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and Path(process.stdout.readline().strip()).is_dir()
    return process


def test_what_a_killed_run_left_goes_with_the_next_and_a_living_one_keeps_its_own(
    tmp_path: Path, own_temporary_folder: Path
) -> None:
    process = holder(tmp_path / "out.csv")
    try:
        scratch.sweep(tmp_path)
        scratch.sweep_folders()
        assert len(left(tmp_path)) == 1 and len(list(own_temporary_folder.iterdir())) == 1
    finally:
        process.kill()
        process.communicate()
    assert len(left(tmp_path)) == 1 and len(list(own_temporary_folder.iterdir())) == 1
    with reserved([tmp_path / "other.csv"], []), scratch.Folder() as folder:
        assert len(left(tmp_path)) == 1 and list(own_temporary_folder.iterdir()) == [folder]
    assert not left(tmp_path) and not list(own_temporary_folder.iterdir())


def test_a_paced_run_that_is_killed_and_the_next_one(tmp_path: Path, own_temporary_folder: Path) -> None:
    """Everything that the program keeps while it runs: the reserved outputs, and the mapped file in its folder."""
    (tmp_path / "wait.kmd").write_text(WAIT)
    command = [sys.executable, "-m", "drillctl", "run", "wait.kmd", "--trace", "t.trace", "--holes", "h.csv"]
    process = subprocess.Popen([*command, "--pace", "real"], cwd=tmp_path, start_new_session=True)
    try:
        until(lambda: len(left(tmp_path)) == 2 and any(own_temporary_folder.glob("*/status")))
        channel = Channel(next(own_temporary_folder.glob("*/status")), create=False)
        until(lambda: channel["ticker_pid"] != 0)
        ticker = channel["ticker_pid"]
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert len(left(tmp_path)) == 2 and len(list(own_temporary_folder.iterdir())) == 1
    until(lambda: not Path(f"/proc/{ticker}").exists())  # it makes its outputs safe first, and holds the files

    def next_run_finds_nothing() -> bool:  # the guard may still be there for a moment
        scratch.sweep(tmp_path)
        scratch.sweep_folders()
        return not left(tmp_path) and not list(own_temporary_folder.iterdir())

    until(next_run_finds_nothing)


def test_a_new_file_is_never_what_lies_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    words = iter(["aa", "bb", "cc"])
    monkeypatch.setattr(scratch.secrets, "token_hex", lambda count: next(words))
    (tmp_path / "mine").write_text("kept")
    (tmp_path / f".x.aa{scratch.MARK}").symlink_to(tmp_path / "mine")
    (tmp_path / f".x.bb{scratch.MARK}").symlink_to(tmp_path / "nowhere")
    handle, path = scratch.make_file(tmp_path / "x")
    os.write(handle, b"new")
    os.close(handle)
    assert path.name == f".x.cc{scratch.MARK}" and path.stat().st_mode & 0o777 == 0o600
    assert (tmp_path / "mine").read_text() == "kept" and not (tmp_path / "nowhere").exists()


def test_only_our_own_regular_files_are_swept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "kept").write_text("")
    (tmp_path / f".link{scratch.MARK}").symlink_to(tmp_path / "kept")
    os.mkfifo(tmp_path / f".pipe{scratch.MARK}")
    (tmp_path / f".folder{scratch.MARK}").mkdir()
    (tmp_path / f"seen{scratch.MARK}").write_text("")
    (tmp_path / f".old{scratch.MARK}").write_text("")
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    scratch.sweep(tmp_path)
    assert f".old{scratch.MARK}" in left(tmp_path), "another user's"
    monkeypatch.undo()
    scratch.sweep(tmp_path)
    assert left(tmp_path) == sorted(f"{name}{scratch.MARK}" for name in (".folder", ".link", ".pipe", "seen"))
    assert (tmp_path / "kept").exists()
    scratch.sweep(tmp_path / "nowhere")


def test_a_folder_with_something_else_in_it_stays(own_temporary_folder: Path) -> None:
    folder = scratch.Folder()
    (folder.path / "status").write_text("")
    (folder.path / "notes").write_text("somebody's")
    folder.close()
    folder.close()
    scratch.sweep_folders()
    assert [file.name for file in folder.path.iterdir()] == ["notes"]
    foreign = own_temporary_folder / f"{scratch.FOLDERS}link"
    foreign.symlink_to(folder.path)
    scratch.sweep_folders()
    assert (folder.path / "notes").exists() and foreign.is_symlink()


def test_the_channel_is_made_beside_its_place_and_holds_its_lock(tmp_path: Path) -> None:
    (tmp_path / "victim").write_text("kept")
    (tmp_path / "j.status").symlink_to(tmp_path / "victim")
    channel = Channel(tmp_path / "j.status", create=True)
    assert (tmp_path / "victim").read_text() == "kept" and not (tmp_path / "j.status").is_symlink()
    scratch.sweep(tmp_path, "*.status")
    assert (tmp_path / "j.status").exists()
    memory = channel.memory
    del channel  # the last one that looks into the memory
    memory.close()
    scratch.sweep(tmp_path, "*.status")
    assert not (tmp_path / "j.status").exists()


def test_a_channel_is_not_opened_through_a_link(tmp_path: Path) -> None:
    Channel(tmp_path / "real", create=True)
    (tmp_path / "link").symlink_to(tmp_path / "real")
    with pytest.raises(OSError, match="symbolic"):
        Channel(tmp_path / "link", create=False)

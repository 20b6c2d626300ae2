"""Without what only POSIX has (fcntl, termios, resource, fork, signals) every module is imported and machines are
simulated. In a process of its own, from which those modules and names are taken away; no real Windows is tried here.
"""

import subprocess
import sys
from pathlib import Path

POORER = """
import importlib, os, pkgutil, signal, sys
import asyncio, ctypes, logging, multiprocessing, numpy, platformdirs, shutil, socket, subprocess, tempfile, threading
import msgspec, serial, tomlkit, tqdm, urwid, vcd, xml.etree.ElementTree  # they know their systems by themselves
for name in ("fcntl", "termios", "resource", "tty", "pty", "pwd", "grp", "curses", "readline"):
    sys.modules[name] = None
for name in ("O_NOFOLLOW", "O_CLOEXEC", "O_NONBLOCK", "O_DIRECTORY", "O_NOCTTY", "fork", "geteuid", "getuid", "killpg",
             "fchmod", "set_blocking", "sched_getaffinity", "sched_setscheduler", "getpgrp", "tcgetpgrp"):
    if hasattr(os, name):
        delattr(os, name)
for name in ("SIGHUP", "SIGQUIT", "SIGTSTP", "SIGKILL", "pidfd_send_signal"):
    if hasattr(signal, name):
        delattr(signal, name)
import drillctl
for found in pkgutil.walk_packages(drillctl.__path__, "drillctl."):
    if found.name != "drillctl.__main__":
        importlib.import_module(found.name)
from drillctl.cli import main
codes = [main(words.split()) for words in (
    "run job.kmd --trace job.trace --holes holes.csv",
    "run job.kmd --plant dynamic",
    "replay job.trace",
    "estimate board.drl",
    "run board.drl --journal board.journal --trace board.seg",
    "convert board.drl --to out.kmd",
    "report job.trace -o job.html",
    "tables list",
)]
print("CODES", codes)
"""


def test_every_module_is_imported_and_machines_are_simulated(tmp_path: Path) -> None:
    examples = Path(__file__).resolve().parents[2] / "examples"
    (tmp_path / "job.kmd").write_text("KMD_GOTOdXdY 30 0\n")
    (tmp_path / "board.drl").write_bytes((examples / "blinker.drl").read_bytes())
    call = [sys.executable, "-c", POORER]
    done = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, timeout=110, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == f"CODES {[0] * 8}", done.stderr
    assert {"job.trace", "holes.csv", "board.journal", "board.seg", "out.kmd", "job.html"} <= {
        file.name for file in tmp_path.iterdir()
    }

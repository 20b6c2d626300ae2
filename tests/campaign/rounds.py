"""One round of the campaign: a board is drilled in real pace, something happens, and the job is resumed to its end.

Rule: every round follows from its seed, but for the moment at which a signal meets the run. What is judged is what
the plant saw (faulty.py's witness), what the mapped card holds and what the program says; never the program's insides.
"""

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Any

from drillctl.kmd.channel import Channel
from drillctl.portio.mapped import read_map
from tests.campaign.blows import BLOWS, Blow
from tests.campaign.board import REST_STEPS, Board

ENTRY = Path(__file__).with_name("faulty.py")
ROOT = ENTRY.parents[2]
TICK_HZ = 4000
SAFE_WITHIN_S = 1.0
PATIENCE_S = 30.0
HOMING_TICKS, HOLE_TICKS = 1400, 1650  # as they are on these boards, about
MOST_RESUMES = 3
NAMED = re.compile(r"hole (\d+) \(.*\) (?:was cut off|may have been begun); it is drilled again")
SITES = (
    ("--port", "mapped:card", "--pace", "real"),  # where every job begins
    ("--port", "simulated", "--pace", "free"),
    ("--port", "mapped:other", "--pace", "real"),
)
EXIT_CODES = {0, 1, 2, 129, 130, 143, -signal.SIGKILL}


@dataclass
class Round:
    """What is known of a round while it is played; ``violations`` is what must stay empty."""

    folder: Path
    seed: int
    board: Board
    blow: Blow
    moment_s: float  # after the ticker began, for a signal
    rng: Random
    violations: list[str] = field(default_factory=list)
    met: bool = False  # the blow came before the run was over
    resumes: int = 0
    named: int = 0  # holes that were said to be visited again
    again: int = 0  # holes that were
    elsewhere: int = 0  # resumes on another port or at another pace, refused first
    safe_after_s: float = 0.0  # for a blow that takes desk or ticker away

    def check(self, holds: bool, otherwise: str) -> None:
        if not holds:
            self.violations.append(f"seed {self.seed}, {self.blow.name}: {otherwise}")


def play(seed: int, folder: Path) -> Round:
    """Plays one round in an empty folder."""
    rng = Random(seed)
    board = Board.random(rng)
    run_ticks = HOMING_TICKS + HOLE_TICKS * len(board.holes)
    blow = BLOWS[seed % len(BLOWS)](rng, run_ticks)
    r = Round(folder, seed, board, blow, rng.uniform(0, run_ticks / TICK_HZ), rng, met=blow.trace is not None)
    r.board.write(folder / "job.drl")
    _strike(r)
    for _ in range(MOST_RESUMES):
        if _finished(r):
            break
        _go_on(r)
    r.check(_finished(r), f"not finished after {r.resumes} resumes")
    _judge_holes(r)
    return r


def _start(r: Round, plan: dict[str, Any], *arguments: str) -> "subprocess.Popen[bytes]":
    call = [sys.executable, str(ENTRY), str(r.folder / "witness"), json.dumps(plan), *arguments]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with (r.folder / "out").open("wb") as out, (r.folder / "err").open("ab") as err:
        return subprocess.Popen(call, cwd=r.folder, stdout=out, stderr=err, env=environment, start_new_session=True)


def _strike(r: Round) -> None:
    """The first run, with the blow."""
    trace = ["--trace", r.blow.trace or "t.trace"]
    job = ["run", "job.drl", "--tick-hz", str(TICK_HZ), "--journal", "j", "--json", *trace]
    desk = _start(r, dict(r.blow.plan), *job, *SITES[0])
    hit = [desk.pid]
    if r.blow.target is not None and r.blow.signal is not None:
        hit = _hit(r, desk)
    _wait_for_end(r, desk, hit)
    r.met = r.met or any(line.startswith("fails") for line in _witnessed(r))
    _judge_run(r, desk.returncode)


def _hit(r: Round, desk: "subprocess.Popen[bytes]") -> list[int]:
    """The signal, at some moment of the job; returns the processes of the run."""
    assert r.blow.target is not None and r.blow.signal is not None
    ticker = _ticker_of(r.folder / "j.status", desk)
    time.sleep(r.moment_s)
    family = {"desk": desk.pid, "ticker": ticker}
    for child in set(_children(desk.pid)) - {ticker}:
        family["guard"] = child
    struck = family.get(r.blow.target)
    if struck is None or desk.poll() is not None:
        return list(family.values())  # the job was over before
    os.kill(struck, r.blow.signal)
    r.met = True
    if r.blow.takes_away:
        r.safe_after_s = _until_safe(r.folder / "card")
        r.check(r.safe_after_s <= SAFE_WITHIN_S, f"outputs on for {r.safe_after_s:.2f} s and more")
    if r.blow.signal == signal.SIGSTOP and r.blow.target == "desk":
        os.kill(struck, signal.SIGCONT)
    return list(family.values())


def _ticker_of(file: Path, desk: "subprocess.Popen[bytes]") -> int:
    """The ticker's process, once it runs; the desk's where it ended before."""
    until_s = time.monotonic() + PATIENCE_S
    while desk.poll() is None and time.monotonic() < until_s:
        try:
            if pid := Channel(file, create=False)["ticker_pid"]:
                return pid
        except (OSError, ValueError):
            pass  # not made yet, or not whole
        time.sleep(0.01)
    return desk.pid


def _children(pid: int) -> list[int]:
    try:
        return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def _until_safe(card: Path) -> float:
    """How long the outputs of the card are not all low, from now on; looked at for a little longer than allowed."""
    begun_s = last_on_s = time.monotonic()
    while (now_s := time.monotonic()) - begun_s < 2 * SAFE_WITHIN_S:
        if read_map(card).outputs:
            last_on_s = now_s
        elif now_s - last_on_s > SAFE_WITHIN_S / 4:
            break
        time.sleep(0.005)
    return last_on_s - begun_s


def _wait_for_end(r: Round, desk: "subprocess.Popen[bytes]", family: list[int]) -> None:
    """All processes of the run have ended by themselves, the outputs low."""
    until_s = time.monotonic() + PATIENCE_S
    while (left := [pid for pid in family if _lives(pid)]) and time.monotonic() < until_s:
        desk.poll()
        time.sleep(0.01)
    r.check(not left, f"processes left: {left}")
    for pid in left:
        os.kill(pid, signal.SIGKILL)
    desk.wait(PATIENCE_S)
    for card in filter(Path.exists, (r.folder / "card", r.folder / "other")):
        r.check(read_map(card).outputs == 0, f"outputs of {card.name} on after the end")


def _lives(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def _judge_run(r: Round, code: int) -> None:
    """What the program said of the run: an exit code of its list, no traceback, no position that is not so."""
    r.check(code in EXIT_CODES, f"exit code {code}")
    r.check(b"Traceback" not in (r.folder / "err").read_bytes(), "a traceback")
    text = (r.folder / "out").read_text()
    if not text:
        return
    told = json.loads(text)
    if told["position_known"]:
        r.check(not any(told["lost_steps"].values()), f"position known, steps lost: {told['lost_steps']}")
        stood = [line.split()[1:] for line in _witnessed(r) if line.startswith("safe")]
        apart = [abs(float(a) - b) for a, b in zip(stood[-1], told["position"].values(), strict=True)] if stood else [0]
        r.check(max(apart) <= REST_STEPS, f"position known, and {max(apart)} steps off")
    r.check(code != 0 or told["holes_done"] == told["holes_total"], "exit 0, and holes are left")


def _finished(r: Round) -> bool:
    """The journal says that every hole is drilled."""
    try:
        lines = (r.folder / "j").read_bytes().splitlines()
    except OSError:
        return False
    done = {line for line in lines if line.startswith(b'{"done"')}
    return len(done) == len(r.board.holes)


def _go_on(r: Round) -> None:
    """Resumes, as it ran or elsewhere; where the first run was ended before it had a journal, begins."""
    begun = (r.folder / "j").exists() and (r.folder / "j").stat().st_size > 0
    site = r.rng.choice((None, *SITES))
    options: tuple[str, ...] = SITES[0] if site is None and not begun else site or ()
    verb = ["resume", "j"] if begun else ["run", "job.drl", "--tick-hz", str(TICK_HZ), "--journal", "j"]
    if begun and site not in (None, SITES[0]):
        _be_refused(r, *verb, *options)
        options += ("--elsewhere",)
        r.elsewhere += 1
    said_before = len((r.folder / "err").read_text())
    desk = _start(r, {}, *verb, *options, "--json")
    _wait_for_end(r, desk, [desk.pid])
    r.resumes += 1
    _judge_run(r, desk.returncode)
    r.check(desk.returncode == 0, f"{' '.join(verb[:2])}: exit code {desk.returncode}: {_last_words(r)}")
    first = (r.folder / "err").read_text()[said_before:].partition("\n")[0]
    where = (options or SITES[0])[1].replace(":", f":{r.folder}/")
    r.check(f"port {where}, pace " in first, f"its first line does not say {where}: {first!r}")


def _be_refused(r: Round, *arguments: str) -> None:
    """Another port or pace, and nobody said that it may be: nothing moves, and the journal stays as it is."""
    before = (r.folder / "j").read_bytes(), _witnessed(r)
    desk = _start(r, {}, *arguments, "--json")
    _wait_for_end(r, desk, [desk.pid])
    r.check(desk.returncode == 2, f"elsewhere: exit code {desk.returncode}, not refused: {_last_words(r)}")
    r.check(before == ((r.folder / "j").read_bytes(), _witnessed(r)), "refused, and something was done")


def _judge_holes(r: Round) -> None:
    """Every hole was met, in its place; once, or as often as it was named."""
    met: Counter[int] = Counter()
    for line in _witnessed(r):
        what, x, y, _ = line.split()
        number = r.board.hole_at(float(x), float(y)) if what == "touch" else 0
        r.check(number is not None, f"a hole at {x}, {y} steps, where there is none")
        met[number or 0] += what == "touch"
    named = Counter(int(found) for found in NAMED.findall((r.folder / "err").read_text()))
    for number in range(1, len(r.board.holes) + 1):
        r.check(met[number] > 0, f"hole {number} is lost")
        told = f"hole {number} was visited {met[number]} times, named {named[number]}"
        r.check(met[number] <= 1 + named[number], told)
        r.again += met[number] > 1
    r.named = sum(named.values())


def _witnessed(r: Round) -> list[str]:
    return (r.folder / "witness").read_text().splitlines() if (r.folder / "witness").exists() else []


def _last_words(r: Round) -> str:
    return (r.folder / "err").read_text().strip().rpartition("\n")[2]

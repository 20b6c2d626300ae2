"""A board that resets in mid-run, at every tick of a short job: is a hole told as done that it did not make?

    .venv/bin/python benchmarks/board_resets.py                   # no line, no clock: every tick, three kinds
    .venv/bin/python benchmarks/board_resets.py --program --every 10 --jobs 2     # drillctl itself, on a pty, resumed

Prints how many runs ended how, and every violation; exit code 1 where there is one. Without --program some two
minutes of processor time; with it some ten seconds a round, at every so many messages to the outputs.
"""

import argparse
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from tests.campaign.board_resets import Reset, play, short_job
from tests.campaign.resetting_board import Round, play_round

KINDS = {"greets": (True, False), "quiet": (False, False), "silent": (False, True)}


def main() -> int:
    arguments = _arguments()
    begun_s = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="drillctl-resets-") as folder:
        campaign = _program if arguments.program else _ticks
        violations = [text for texts in campaign(Path(folder), arguments) for text in texts]
    for text in violations:
        print(f"VIOLATION {text}")
    print(f"{len(violations)} violations, {time.monotonic() - begun_s:.0f} s")
    return 1 if violations else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--every", type=int, default=1, help="so many ticks, or messages, apart (default 1)")
    parser.add_argument("--program", action="store_true", help="drillctl in processes of its own, in real pace")
    parser.add_argument("--jobs", type=int, default=2, help="rounds at a time, with --program")
    return parser.parse_args()


def _ticks(folder: Path, arguments: argparse.Namespace) -> Iterator[list[str]]:
    """In this process."""
    job = short_job(folder)
    wakes = play(job, Reset()).wakes
    for kind, (greets, silent) in KINDS.items():
        ended: Counter[str] = Counter()
        worst = open_holes = 0
        for wake in range(0, wakes, arguments.every):
            reset = Reset(wake, greets, silent)
            played = play(job, reset)
            fault = played.outcome.fault
            ended[fault.name if fault else "done"] += 1
            worst = max(worst, played.told_after)
            open_holes += played.made > played.outcome.holes_done
            yield played.violations(reset)
        print(f"{kind:<8}{dict(ended)}; told after {worst} ticks at most; a hole made and left open: {open_holes}")


def _program(folder: Path, arguments: argparse.Namespace) -> Iterator[list[str]]:
    """In processes of its own; a round a folder."""
    messages = _round(folder, 0, greets=False).messages
    points = list(product(range(1, messages + 1, arguments.every), (True, False)))
    with ThreadPoolExecutor(arguments.jobs) as pool:
        rounds = list(pool.map(lambda point: _round(folder, *point), points))
    reset, named, busy = (sum(getattr(r, name) for r in rounds) for name in ("was_reset", "named", "busy"))
    print(f"{len(rounds)} rounds over {messages} messages: {reset} reset, {named} with a hole named as drilled again,")
    print(f"{busy} cut off by a busy computer beside")
    yield from (r.violations for r in rounds)


def _round(folder: Path, message: int, greets: bool) -> Round:
    own = folder / f"{message}-{greets}"
    own.mkdir()
    return play_round(short_job(own), own, message, greets)


if __name__ == "__main__":
    sys.exit(main())

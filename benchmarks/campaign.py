"""The long campaign: boards are drilled by the clock while processes are killed, sensors lie, disks fill, ports go;
then each job is resumed, as it ran or on another port.

    .venv/bin/python benchmarks/campaign.py --rounds 1000 --jobs 2

Prints what was done, and every violation with the seed that leads to it (tests/campaign has the rules). Exit code 1
where there is one. Needs Linux; the suite plays a few rounds of it by itself.
"""

import argparse
import shutil
import sys
import tempfile
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from tests.campaign.rounds import Round, play

SHOW_EVERY = 50


def main() -> int:
    arguments = _arguments()
    begun_s = time.monotonic()
    seeds = range(arguments.seed, arguments.seed + arguments.rounds)
    played = []
    with tempfile.TemporaryDirectory(prefix="drillctl-campaign-") as folder, ThreadPoolExecutor(arguments.jobs) as pool:
        for r in pool.map(lambda seed: _play(seed, Path(folder)), seeds):
            played.append(r)
            for violation in r.violations:
                print(f"VIOLATION {violation}", flush=True)
            if len(played) % SHOW_EVERY == 0:
                print(f"{len(played)} rounds, {time.monotonic() - begun_s:.0f} s", file=sys.stderr, flush=True)
    _report(played, time.monotonic() - begun_s)
    return 1 if any(r.violations for r in played) else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0, help="of the first round; the others follow")
    parser.add_argument("--jobs", type=int, default=2, help="rounds at a time")
    return parser.parse_args()


def _play(seed: int, under: Path) -> Round:
    """One round; its files are kept only where it went wrong."""
    folder = under / str(seed)
    folder.mkdir()
    r = play(seed, folder)
    kept = Path(tempfile.gettempdir()) / f"drillctl-campaign-seed-{seed}"
    if r.violations:
        shutil.copytree(folder, kept, dirs_exist_ok=True)
        r.violations.append(f"seed {seed}: its files are kept in {kept}")
    shutil.rmtree(folder)
    return r


def _report(played: list[Round], seconds: float) -> None:
    by_blow = defaultdict(list)
    for r in played:
        by_blow[r.blow.name].append(r)
    counts = "rounds  in time  resumed  elsewhere  named again  visited again"
    print(f"{'blow':<30} {counts}  outputs off after, worst  violations")
    for name, rounds in by_blow.items():
        print(f"{name:<30} {_row(rounds)}")
    print(f"{'all':<30} {_row(played)}")
    holes = sum(len(r.board.holes) for r in played)
    print(f"{holes} holes in {len(played)} rounds, {seconds:.0f} s")


def _row(rounds: list[Round]) -> str:
    worst_s = max(r.safe_after_s for r in rounds)
    sums = [sum(getattr(r, name) for r in rounds) for name in ("met", "resumes", "elsewhere", "named", "again")]
    wrong = sum(bool(r.violations) for r in rounds)
    counts = "  ".join(f"{count:{width}}" for count, width in zip(sums, (7, 7, 9, 11, 13), strict=True))
    return f"{len(rounds):6}  {counts}  {worst_s:22.2f} s  {wrong:10}"


if __name__ == "__main__":
    sys.exit(main())

"""Ticks in which axes only count, passed together: what comes of it is what tick makes of it, to the byte."""

import numpy as np
import pytest

from drillctl.generation.job import names_of
from drillctl.kmd import Request, parse_program
from drillctl.machine import Library, shipped_tables
from drillctl.ticker.ticker import Ticker

LIBRARY = Library((shipped_tables(),))
DRUM = "KMD_PREDKOSC 200\nKMD_RUCHd y=40\nKMD_RUCHd x=30 y=-40\nKMD_CZEKAJ 900\n"
BOARD = "KMD_PREDKOSC 9\nKMD_RUCHd x=90 y=-7\nKMD_CZEKAJ 30\nKMD_RUCH x=5 y=5\n"
PROGRAMS = {
    name: f"KMD_INICJALIZACJA\n{moves}KMD_KONIEC\n" for name, moves in (("boiler-drum", DRUM), ("pcb-drill", BOARD))
}


def run(machine: str, together: bool, disturbed: dict[int, Request]) -> tuple[Ticker, int]:
    """The program to its end, with requests before these ticks; and how many ticks were passed together."""
    ticker = Ticker.simulated(LIBRARY.machine(machine), traced=True, derived=True)
    ticker.queue.put(parse_program(PROGRAMS[machine], names_of(ticker.machine)))
    passed, due = 0, sorted(disturbed)
    while ticker.controller.tick < 2_000_000 and not (ticker.over() and ticker.controller.tick and not due):
        if due and due[0] == ticker.controller.tick:
            ticker.requests.post(disturbed[due.pop(0)])
        ahead = min(1000, due[0] - ticker.controller.tick) if due else 1000
        count = ticker.pass_counting(ahead) if together else 0
        passed += count
        if not count:
            ticker.advance(1)
    return ticker, passed


@pytest.mark.parametrize("machine", PROGRAMS)
@pytest.mark.parametrize("seed", [None, 1])
def test_the_status_and_the_trace_are_those_of_single_ticks(machine: str, seed: int | None) -> None:
    chance = np.random.default_rng(seed)
    last = 4000 if machine == "boiler-drum" else 120
    ticks = sorted(chance.choice(last, 4, replace=False).tolist()) if seed else []
    disturbed = dict(zip(ticks, (Request.HOLD, Request.RESUME) * 2, strict=False))
    (single, none), (together, passed) = (run(machine, how, disturbed) for how in (False, True))
    assert single.report().tobytes() == together.report().tobytes()
    assert single.finished_trace([]) == together.finished_trace([])
    assert none == 0
    assert passed > (together.controller.tick / 2 if machine == "boiler-drum" else 0)

"""The fast engine against the law: images, events, columns, holes, and all that is remembered, on every machine.

Programs hold every command; holds, stops, emergency stops, gaps in time and refused commands come at any tick.
"""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, seed, settings
from hypothesis import strategies as st

from drillctl.generation.job import names_of
from drillctl.kmd import parse_program
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.ticker import Ticker
from tests.support.bench import shipped
from tests.support.twins import check, disturbances, small

SQUARE = Path(__file__).resolve().parents[2] / "examples" / "square.kmd"
LIBRARY = Library((shipped_tables(),))
MACHINES = ["pcb-drill", "pcb-drill-ramp-lab", "eight-axis", "boiler-drum", "mega-28byj48", "cnc-shield"]
STEPS = st.one_of(st.integers(-40, 40), st.integers(-700, 700), st.just(0))


@st.composite
def commands(draw: st.DrawFn, machine: Machine) -> str:
    """One command of any kind, most of them such as a job holds."""
    axis = st.sampled_from(machine.axis_names)
    some = draw(st.lists(axis, min_size=1, max_size=2, unique=True))
    places = " ".join(f"{name}={abs(draw(STEPS))}" for name in some)
    head = machine.axis_names[draw(st.sampled_from(machine.drill_axes))]
    ways = " ".join(f"{name}={draw(STEPS)}" for name in some)
    forms = [
        *[f"KMD_GOTO_X_Y {abs(draw(STEPS))} {abs(draw(STEPS))}"] * 3, f"KMD_GOTOdXdY {draw(STEPS)} {draw(STEPS)}",
        *["KMD_WIERTLO_DOL"] * 2, *["KMD_WIERTLO_GORA"] * 3,
        f"KMD_WIERTLO_DOL {some[0]}=5", f"KMD_WIERTLO_DOL {some[0]}", f"KMD_WIERTLO_GORA {some[0]}",
        f"KMD_RUCH {places}", f"KMD_RUCHd {ways}", f"KMD_LINIA {places}", f"KMD_LINIAd {ways}",
        "KMD_BAZA", f"KMD_BAZA {some[0]}", f"KMD_PREDKOSC {draw(st.sampled_from([0, 1, 2, 3, 5, 9, 40]))}",
        f"KMD_CZEKAJ {draw(st.sampled_from([0, 1, 2, 77, 5000]))}", "KMD_WRZECIONO 9", "KMD_WRZECIONO 0",
        "KMD_NARZEDZIE 3", "KMD_INICJALIZACJA", "KMD_POWROT", f"KMD_FAZY_WYL {some[0]}", "KMD_FAZY_WYL",
        *(f"KMD_WYJSCIE {name} {level}" for name, _ in machine.outputs for level in (0, 1)),
        *(f"KMD_CZEKAJ_WE {line.name} {level} 9" for line in machine.input_lines for level in (0, 1)),
    ]  # fmt: skip
    if head not in ("x", "y"):
        forms += [f"KMD_GORA_X_Y {abs(draw(STEPS))} {abs(draw(STEPS))}", f"KMD_GORA_X_Y {abs(draw(STEPS))} 7 {head}=3"]
    return draw(st.sampled_from(forms))


def check_some_program(machine: Machine, data: st.DataObject) -> None:
    known = data.draw(st.sampled_from(["KMD_INICJALIZACJA\n", ""]))
    text = known + "\n".join(data.draw(st.lists(commands(machine), min_size=1, max_size=12)))
    asked = data.draw(st.one_of(st.just({}), disturbances))
    check(machine, text, asked, data.draw(st.integers(6000, 14000)))


@pytest.mark.parametrize("name", MACHINES)
@seed(720)
@settings(max_examples=6, deadline=None)
@given(data=st.data())
def test_whatever_is_asked_of_it_the_fast_one_is_the_law(name: str, data: st.DataObject) -> None:
    check_some_program(small(name), data)


@pytest.mark.long
@pytest.mark.timeout(1200)
@pytest.mark.parametrize("name", MACHINES)
def test_a_hundred_programs_more(name: str) -> None:
    settings(max_examples=100, deadline=None)(given(data=st.data())(check_some_program))(small(name))


HOLES = np.random.default_rng(720).integers(0, 300, (2, 2)).tolist()
BOARD = "KMD_INICJALIZACJA\n" + "\n".join(f"KMD_GOTO_X_Y {x} {y}\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA" for x, y in HOLES)


@pytest.mark.parametrize("name", MACHINES)
def test_a_board_is_foreseen_but_for_its_first_strokes(name: str) -> None:
    """So that the tests above compare two engines, and not tick with itself."""
    machine = small(name)
    fast = FastTicker.ideal(machine)
    fast.queue.put(parse_program(BOARD, names_of(machine)))
    ticked = [batch for batch in fast.batches() if batch is None]
    moves_the_head_too = len(machine.axes) == 2
    assert len(ticked) <= (1 + 2 * len(HOLES) if moves_the_head_too else 5)
    assert len(fast.touched) == len(HOLES) * len(fast.machine.drill_axes)
    check(machine, BOARD, {}, 10**9)


def test_after_a_look_into_the_middle_of_a_command_it_goes_on_fast(monkeypatch: pytest.MonkeyPatch) -> None:
    """What was begun goes on to its end in one tick and those that are passed with it, what waits behind in a batch."""
    machine, ticked = LIBRARY.machine("pcb-drill"), []
    fast = FastTicker.ideal(machine)
    fast.queue.put(parse_program("KMD_CZEKAJ 1000\n" * 45, names_of(machine)))
    assert fast.turn(before=500) == 500
    law = Ticker.run
    monkeypatch.setattr(Ticker, "run", lambda self, *how: ticked.append(law(self, *how)) or ticked[-1])
    while not fast.over():
        fast.turn(fast.over)
    assert fast.controller.tick == 45_001 and sum(ticked) == 1


@pytest.mark.parametrize(("name", "distances"), [("pcb-drill", (0, 20)), ("eight-axis", (0, 48, 3))])
def test_every_distance_both_ways(name: str, distances: tuple[int, ...]) -> None:
    """Up to where head and tail of a move don't touch, both axes at different ones; and beyond a strip's length."""
    machine = shipped(name)
    moves = [f"KMD_GOTOdXdY {d} {-d // 2}\nKMD_GOTOdXdY {-d} {d // 3}" for d in range(*distances)]
    check(machine, "\n".join([*moves, "KMD_GOTOdXdY 4300 7", "KMD_GOTOdXdY -4096 1"]), {}, 10**9)


FINE = st.sampled_from([
    "KMD_RUCHd y={}", "KMD_RUCHd y=-{}", "KMD_RUCHd x={} y=-3", "KMD_RUCH x={}", "KMD_LINIAd x={} y=2", "KMD_CZEKAJ {}",
    "KMD_PREDKOSC {}", "KMD_FAZY_WYL", "KMD_NARZEDZIE {}",
])  # fmt: skip


@example(moves=[("KMD_RUCHd y={}", 7), ("KMD_RUCHd y=-{}", 7)] * 3, asked={}, ticks=20_000)  # strokes made again
@seed(726)
@settings(max_examples=5, deadline=None)
@given(
    moves=st.lists(st.tuples(FINE, st.sampled_from([0, 1, 7, 20, 99])), min_size=1, max_size=6),
    asked=st.one_of(st.just({}), disturbances),
    ticks=st.integers(1, 9000),
)
def test_at_fine_ticks_the_fast_one_is_the_law(
    moves: list[tuple[str, int]], asked: dict[int, int], ticks: int
) -> None:
    """A ramp of 302 states, and hundreds of ticks from one column to the next."""
    text = "\n".join(["KMD_INICJALIZACJA", *(form.format(number) for form, number in moves)])
    check(LIBRARY.machine("boiler-drum"), text, asked, ticks)


def test_at_fine_ticks_a_first_stroke_is_hardly_ticked(monkeypatch: pytest.MonkeyPatch) -> None:
    """A hole of a part program for the drum drill: 40 steps on, 170 at the slowest feed, and back."""
    machine, ticked = LIBRARY.machine("boiler-drum"), []
    law = Ticker.run
    monkeypatch.setattr(Ticker, "run", lambda self, *how: ticked.append(law(self, *how)) or ticked[-1])
    ways = ((75, 40), (600, 170), (48, -210))
    hole = "KMD_RUCHd x=9\n" + "\n".join(f"KMD_PREDKOSC {floor}\nKMD_RUCHd y={steps}" for floor, steps in ways)
    fast = FastTicker.ideal(machine, traced=True, taped=True)
    fast.queue.put(parse_program("KMD_INICJALIZACJA\n" + f"{hole}\n" * 9, names_of(machine)))
    while not fast.over() or not ticked:
        fast.turn(fast.over)
    firsts = len(ways) + 1  # the second hole begins after a way up, the first not
    assert sum(ticked) <= 4 * firsts
    assert fast.controller.tick > 1_000_000


@pytest.mark.parametrize("ticks", range(48, 56))
def test_wherever_it_is_looked_at(ticks: int) -> None:
    """The last step is made in the 52nd tick and ends on a forced column: on at first, off in the next tick."""
    check(LIBRARY.machine("pcb-drill"), "KMD_GOTOdXdY 31 3\nKMD_GOTOdXdY -3 20", {}, ticks)


@pytest.mark.parametrize("floor", [1, 3, 7, 8, 100_000])
def test_every_feed(floor: int) -> None:
    """The last is so slow that its strips would be too long: it is ticked."""
    machine = LIBRARY.machine("pcb-drill-ramp-lab")
    text = f"KMD_INICJALIZACJA\nKMD_PREDKOSC {floor}\nKMD_GOTO_X_Y 40 2\nKMD_GOTO_X_Y 0 30"
    check(machine, text, {}, 20_000)


def test_a_reversed_axis_and_a_table_that_reverses_otherwise() -> None:
    plain = LIBRARY.machine("pcb-drill")
    x = plain.axes[0]
    wires = tuple(replace(wire, backward=wire.backward[1:] + wire.backward[:1]) for wire in x.phase.wires)
    other = replace(x, invert=True, phase=replace(x.phase, wires=wires))
    for axes in ((replace(x, invert=True), *plain.axes[1:]), (other, *plain.axes[1:])):
        check(replace(plain, axes=axes), "KMD_GOTOdXdY 100 0\nKMD_GOTOdXdY -33 5\nKMD_GOTOdXdY -1 0", {}, 10**9)


def test_a_table_that_the_rotor_can_not_follow_is_ticked() -> None:
    """A column without current in each half: the rotor slips, and nothing is foreseen."""
    plain = LIBRARY.machine("pcb-drill")
    x = plain.axes[0]
    wires = tuple(replace(wire, forward=(False, *wire.forward[1:])) for wire in x.phase.wires)
    machine = replace(plain, axes=(replace(x, phase=replace(x.phase, wires=wires)), *plain.axes[1:]))
    fast = check(machine, "KMD_GOTOdXdY 100 0\nKMD_GOTOdXdY -33 5", {}, 10**9)
    fast.queue.put(parse_program("KMD_GOTOdXdY 5 0", names_of(machine)))
    assert all(batch is None for batch in fast.batches())


def test_two_engines_in_two_processes_give_the_same_bytes(tmp_path: Path) -> None:
    def told(engine: str, name: str) -> list[bytes]:
        files = [tmp_path / f"{name}.{suffix}" for suffix in ("trace", "csv")]
        call = [sys.executable, "-m", "drillctl", "run", str(SQUARE), "--json", "--engine", engine,
                "--trace", str(files[0]), "--holes", str(files[1])]  # fmt: skip
        done = subprocess.run(call, capture_output=True, timeout=60, check=True)
        return [done.stdout, *(file.read_bytes() for file in files)]

    assert told("tick", "a") == told("fast", "b") == told("fast", "c")


@pytest.mark.parametrize("name", ["pcb-drill", "eight-axis", "cnc-shield"])
@seed(725)
@settings(max_examples=2, deadline=None)
@given(data=st.data())
def test_wherever_the_machine_is_found_both_see_the_same_holes(name: str, data: st.DataObject) -> None:
    """Also with the bit in the board: it has not come down to it, so that is no hole."""
    machine = small(name)
    surface = machine.board_surface[machine.drill_axes[0]]
    assert surface is not None
    found = []
    for axis in machine.axes:
        near = st.integers(surface - 3, min(surface + 40, axis.high_steps))
        found.append(replace(axis, start_steps=data.draw(near if axis.name[0] == "z" else st.integers(0, 300))))
    machine = replace(machine, axes=tuple(found))
    head = machine.axes[machine.drill_axes[0]]
    moves = [f"KMD_RUCHd {head.name}={-data.draw(st.integers(0, 60))}", f"KMD_RUCHd {head.name}=3", "KMD_GOTOdXdY 20 9"]
    known = data.draw(st.sampled_from(["KMD_INICJALIZACJA\nKMD_GOTO_X_Y 9 9\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\n", ""]))
    fast = check(machine, "\n".join([*data.draw(st.permutations(moves)), known]), {}, 10**9)
    if head.start_steps >= surface and not known:
        assert all(touch[1] == 0 for touch in fast.touched)


def test_a_head_that_begins_in_the_board_has_drilled_nothing() -> None:
    plain = LIBRARY.machine("pcb-drill")
    surface = plain.board_surface[2]
    assert surface is not None
    machine = replace(plain, axes=(*plain.axes[:2], replace(plain.axes[2], start_steps=surface + 20)))
    for ticker in (Ticker.simulated(machine), FastTicker.ideal(machine)):
        ticker.queue.put(parse_program("KMD_RUCHd x=5\nKMD_RUCHd z=-3\nKMD_RUCHd x=5", names_of(machine)))
        while not ticker.over() or not ticker.controller.tick:
            ticker.turn(ticker.over)
        assert ticker.touched == []

"""The order `optimised` against the others by what the machine takes, to the tick; and a search that was cut short."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from drillctl.cli import main
from drillctl.generation.drillfile import decode
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.order import Budget, TravelCost, plan_groups
from drillctl.generation.pcb_drill.program import board_program
from drillctl.generation.readers import load_job
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import build
from drillctl.machine import Library, Machine
from drillctl.ticker.forecast import forecast
from drillctl.viewmodel.choices import ORDERS
from drillctl.viewmodel.job_options import JobOptions

PCB = Library.standard().machine("pcb-drill")
LOOSE = replace(PCB, axes=tuple(replace(axis, backlash_steps=15) for axis in PCB.axes))
MACHINES = {"pcb-drill": PCB, "backlash": LOOSE, "seven states": Library.standard().machine("pcb-drill-ramp-lab")}
TRAVEL = TravelCost(np.arange(5000), np.arange(5000))

tenths = st.integers(0, 300)
boards = st.lists(st.lists(st.tuples(tenths, tenths), min_size=1, max_size=7), min_size=1, max_size=3)


def board_text(tools: list[list[tuple[int, int]]]) -> bytes:
    heads = "".join(f"T{number}C0.{number}00\n" for number in range(1, len(tools) + 1))
    holes = "".join(
        f"T{number}\n" + "".join(f"X{x / 10:.1f}Y{y / 10:.1f}\n" for x, y in tool)
        for number, tool in enumerate(tools, 1)
    )
    return f"M48\nMETRIC\n{heads}%\n{holes}M30\n".encode()


def ticks(text: bytes, machine: Machine, chosen: WorkSettings) -> int:
    work = build(decode(text, name="board.drl"), chosen, machine)
    return forecast(board_program(work, machine, chosen), machine).total_ticks


@settings(deadline=None, max_examples=5, phases=(Phase.explicit, Phase.reuse, Phase.generate))
@given(boards, st.sampled_from(sorted(MACHINES)), st.sampled_from([None, 0.3]))
def test_optimised_never_takes_longer_than_the_others(
    tools: list[list[tuple[int, int]]], machine: str, spot_mm: float | None
) -> None:
    """Tools, the way back to the base, spots and backlash included."""
    text = board_text(tools)
    chosen = [WorkSettings(order=how, spot_mm=spot_mm, base_steps=(50, 50)) for how in ORDERS]
    taken = {each.order: ticks(text, MACHINES[machine], each) for each in chosen}
    assert taken["optimised"] <= min(taken.values())


def test_where_a_tool_ends_is_chosen_by_where_the_next_begins() -> None:
    """Alone the first tool would end at 0 (140 ticks); with the next one at 1000 it ends at 100 (160 + 900 ticks)."""
    row, far = [(0, 0), (100, 0)], [(1000, 0)]
    assert plan_groups([row], TRAVEL, "optimised", (60, 0))[0].tolist() == [1, 0]
    assert [order.tolist() for order in plan_groups([row, far], TRAVEL, "optimised", (60, 0))] == [[0, 1], [0]]


def test_the_way_back_counts_where_there_is_one() -> None:
    """From 40 between holes at 0 and 100: to the near one first, unless the machine goes on to -100 afterwards."""
    holes = [(0, 0), (100, 0)]
    assert plan_groups([holes], TRAVEL, "optimised", (40, 0))[0].tolist() == [0, 1]
    assert plan_groups([holes], TRAVEL, "optimised", (40, 0), (-100, 0))[0].tolist() == [1, 0]


@pytest.mark.parametrize("most_steps", [0, 1, 30, 200])
def test_a_search_cut_short_by_the_clock_comes_again_by_its_steps(most_steps: int) -> None:
    points = [np.random.default_rng(number).integers(0, 4000, (40, 2)) for number in (1, 2)]
    by_clock = Budget(seconds=float(most_steps), clock=iter(range(10_000)).__next__)  # each look takes a second
    cut = plan_groups(points, TRAVEL, "optimised", (0, 0), budget=by_clock)
    assert by_clock.cut and by_clock.steps == max(most_steps - 1, 0)
    by_steps = Budget(most_steps=by_clock.steps)
    again = plan_groups(points, TRAVEL, "optimised", (0, 0), budget=by_steps)
    assert by_steps.cut and all(np.array_equal(*pair) for pair in zip(cut, again, strict=True))


def test_a_bound_that_is_not_met_changes_nothing() -> None:
    points = [np.random.default_rng(3).integers(0, 4000, (30, 2))]
    budget = Budget(seconds=1e9)
    bounded = plan_groups(points, TRAVEL, "optimised", (0, 0), budget=budget)
    assert not budget.cut
    assert np.array_equal(bounded, plan_groups(points, TRAVEL, "optimised", (0, 0)))


def test_a_journal_keeps_the_order_that_was_cut_short(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its options hold steps and no seconds, and make the same program."""
    board, journal = tmp_path / "b.drl", tmp_path / "b.journal"
    board.write_bytes(board_text([[(7 * n % 300, 11 * n % 300) for n in range(60)]]))
    words = ["--order", "optimised", "--order-seconds", "0", "--journal", str(journal), "--machine", "pcb-drill"]
    assert main(["run", str(board), *words]) == 0
    assert "may be longer than without --order-seconds" in capsys.readouterr().err
    head = json.loads(journal.read_text().splitlines()[0])
    assert (head["options"]["order_seconds"], head["options"]["order_steps"]) == (None, 0)
    work = load_job(board, PCB, JobSetup.of_journal(head["options"], journal)).work
    bounded = JobOptions(order="optimised", order_seconds=0.0)
    short = load_job(board, PCB, JobSetup("pcb-drill", bounded)).work
    assert work is not None and short is not None and np.array_equal(work.steps, short.steps)

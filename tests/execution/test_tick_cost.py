"""A tick keeps nothing: what runs for a week must not grow (untimed; benchmarks/tick_cost.py has the times)."""

import pytest

from benchmarks.tick_cost import MACHINES, MOST_KEPT, blocks_kept


@pytest.mark.parametrize("name", MACHINES)
def test_no_memory_is_kept_by_ticks_or_commands(name: str) -> None:
    assert blocks_kept(name) < MOST_KEPT

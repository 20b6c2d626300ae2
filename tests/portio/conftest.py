"""What the tests of the Firmata card share: boards that stand in for a real one."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.portio.firmata_stand_in import Faults, StandIn


@pytest.fixture
def stand_in() -> Iterator[Callable[..., StandIn]]:
    """Makes boards with these Faults, each on a pty of its own; the test's end takes them away."""
    made: list[StandIn] = []

    def make(**faults: Any) -> StandIn:
        made.append(StandIn(Faults(**faults)))
        return made[-1]

    yield make
    for board in made:
        board.vanish()

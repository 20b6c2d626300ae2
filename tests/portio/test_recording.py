"""The recording driver: rows by tick, bounded, and honest about what it did not keep."""

import pytest

from drillctl.language import Message
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import PortLost
from tests.portio.conformance import StandInPlant
from tests.support.recording_driver import RecordingDriver


def test_rows_are_ticks_and_columns_cards() -> None:
    plant = StandInPlant()
    driver = RecordingDriver(SimulatedCard(plant), capacity_ticks=5, cards=2)
    for number in range(3):
        plant.inputs = number << 32
        driver.latch()
        driver.flush(number + 1)
    assert driver.latched.tolist() == [[0, 0], [0, 1], [0, 2]]
    assert driver.flushed.tolist() == [[1, 0], [2, 0], [3, 0]]
    assert not driver.full


def test_when_it_is_full_the_port_goes_on_and_the_rest_is_counted() -> None:
    plant = StandInPlant()
    driver = RecordingDriver(SimulatedCard(plant), capacity_ticks=2)
    for image in (1, 2, 3, 4):
        driver.flush(image)
    assert driver.full and driver.missed == 2
    assert driver.flushed.tolist() == [[1], [2]]
    assert plant.image == 4


def test_what_was_not_put_out_is_not_kept() -> None:
    class Lost(SimulatedCard):
        def flush(self, image: int) -> None:
            raise PortLost("lost", Message("gone"))

    driver = RecordingDriver(Lost(StandInPlant()), 4)
    with pytest.raises(PortLost):
        driver.flush(1)
    assert driver.ticks == 0

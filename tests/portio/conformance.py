"""What every driver must do, as one set of tests; a subclass per driver says how its card is made and looked at.

Rule: a test sees the card from outside alone: what stands at its outputs, what is put on its inputs.
"""

import os
import time
from abc import ABC, abstractmethod
from collections.abc import Iterator

import pytest

from drillctl.plant import Plant
from drillctl.ports import LONGEST_WAIT_S, Driver, PortLayout, bits_of

# One card: three motors of the paper's six wires, a spindle; six sensors.
MOTOR = 0b0110_1111
WIRING = PortLayout(500, 0x2A0, (MOTOR, MOTOR << 8, MOTOR << 16), 1 << 24, 0b11_1111)
PATIENCE_S = 2.0
QUICK_S = 0.03  # no wait: far below anything that sleeps, well above a busy computer's hiccup on average


class StandInPlant(Plant):
    """Beyond a simulated card: takes the outputs, gives whatever inputs it is told to."""

    def __init__(self) -> None:
        self.image = self.inputs = 0  # of no machine

    def drive(self, image: int) -> None:
        self.image = image


class Bench(ABC):
    """A driver and the far side of its card."""

    driver: Driver

    @abstractmethod
    def outputs(self) -> int:
        """What stands at the card's outputs."""

    @abstractmethod
    def put(self, image: int) -> None:
        """Levels on the card's inputs."""

    def shows(self, image: int) -> None:
        """The outputs become this image, soon."""
        ends = time.monotonic() + PATIENCE_S
        while self.outputs() != image:
            assert time.monotonic() < ends, f"outputs are 0x{self.outputs():08x}, not 0x{image:08x}"
            time.sleep(0.002)

    def latches(self, image: int) -> None:
        """The inputs become this image, soon."""
        ends = time.monotonic() + PATIENCE_S
        while (seen := self.driver.latch() & WIRING.inputs) != image:
            assert time.monotonic() < ends, f"inputs are 0x{seen:08x}, not 0x{image:08x}"
            time.sleep(0.002)


class DriverConformance:
    """Subclasses give the fixture ``bench``."""

    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        raise NotImplementedError

    def test_a_new_driver_is_safe(self, bench: Bench) -> None:
        bench.shows(0)

    def test_each_output_bit_is_one_output(self, bench: Bench) -> None:
        for bit in bits_of(WIRING.outputs):
            bench.driver.flush(1 << bit)
            bench.shows(1 << bit)

    def test_each_input_bit_is_one_input(self, bench: Bench) -> None:
        for bit in bits_of(WIRING.inputs):
            bench.put(1 << bit)
            bench.latches(1 << bit)

    def test_all_bits_at_once(self, bench: Bench) -> None:
        bench.put(WIRING.inputs)
        bench.latches(WIRING.inputs)
        bench.driver.flush(WIRING.outputs)
        bench.shows(WIRING.outputs)

    def test_the_same_image_again_changes_nothing(self, bench: Bench) -> None:
        for _ in range(3):
            bench.driver.flush(0x123 & WIRING.outputs)
        bench.shows(0x123 & WIRING.outputs)

    def test_safe_drops_all_and_may_be_called_again(self, bench: Bench) -> None:
        for _ in range(2):
            bench.driver.flush(WIRING.outputs)
            bench.shows(WIRING.outputs)
            bench.driver.safe()
            bench.driver.safe()
            bench.shows(0)

    def test_an_image_after_safe_is_put_out_in_full(self, bench: Bench) -> None:
        bench.driver.flush(WIRING.outputs)
        bench.driver.safe()
        bench.driver.flush(WIRING.outputs)
        bench.shows(WIRING.outputs)

    def test_latch_does_not_wait(self, bench: Bench) -> None:
        began = time.monotonic()
        for _ in range(10):
            bench.driver.latch()
        assert time.monotonic() - began < 10 * QUICK_S

    def test_safe_is_quick(self, bench: Bench) -> None:
        bench.driver.flush(WIRING.outputs)
        took_s = min(_seconds_of(bench.driver) for _ in range(3))
        assert took_s < LONGEST_WAIT_S

    def test_closing_leaves_the_outputs_safe(self, bench: Bench) -> None:
        bench.driver.flush(WIRING.outputs)
        bench.shows(WIRING.outputs)
        bench.driver.close()
        bench.shows(0)


class SharedCardConformance(DriverConformance):
    """For cards that are the same card in every process."""

    def test_a_process_that_inherited_the_driver_makes_it_safe(self, bench: Bench) -> None:
        bench.driver.flush(WIRING.outputs)
        bench.shows(WIRING.outputs)
        child = os.fork()
        if child == 0:
            bench.driver.safe()
            os._exit(0)
        assert os.waitpid(child, 0)[1] == 0
        bench.shows(0)


def _seconds_of(driver: Driver) -> float:
    began = time.monotonic()
    driver.safe()
    return time.monotonic() - began

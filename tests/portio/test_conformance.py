"""Every driver against the same tests; hardware replaced by files, a pty, a fake request."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.portio.firmata import open_firmata
from drillctl.portio.firmata_pins import MEGA
from drillctl.portio.gpiod_lines import GpioLines, LineMap
from drillctl.portio.mapped import MappedCard, read_map
from drillctl.portio.pcl720 import Pcl720
from drillctl.portio.simulated import SimulatedCard, SwitchedCard
from drillctl.ports import bits_of
from tests.portio.conformance import WIRING, Bench, DriverConformance, SharedCardConformance, StandInPlant
from tests.portio.firmata_stand_in import StandIn
from tests.support.recording_driver import RecordingDriver


class SimulatedBench(Bench):
    def __init__(self) -> None:
        self.plant = StandInPlant()
        self.driver = SimulatedCard(self.plant)

    def outputs(self) -> int:
        return self.plant.image

    def put(self, image: int) -> None:
        self.plant.inputs = image


class SwitchedBench(SimulatedBench):
    def __init__(self) -> None:
        super().__init__()
        self.driver = SwitchedCard(self.plant)


class RecordedBench(SimulatedBench):
    def __init__(self) -> None:
        super().__init__()
        self.driver = RecordingDriver(self.driver, 8)


class MappedBench(SimulatedBench):
    def __init__(self, file: Path):
        super().__init__()
        self.file = file
        self.driver = MappedCard(self.driver, file, WIRING.cards)

    def outputs(self) -> int:
        return read_map(self.file).outputs


class Pcl720Bench(Bench):
    """Two ordinary files: what is written to one does not come back from the other, as on the card."""

    BASE = 0x2A0

    def __init__(self, folder: Path):
        self.files = folder / "outputs", folder / "inputs"
        for file in self.files:
            file.write_bytes(bytes(range(256)) * 4)
        self.put(0)
        write_to, read_from = (os.open(file, os.O_RDWR) for file in self.files)
        self.driver = Pcl720(write_to, read_from, (self.BASE,))

    def outputs(self) -> int:
        return int.from_bytes(self.files[0].read_bytes()[self.BASE :][:4], "little")

    def put(self, image: int) -> None:
        with self.files[1].open("r+b") as file:
            file.seek(self.BASE)
            file.write(image.to_bytes(4, "little"))


class FakeRequest:
    """As a gpiod.LineRequest, with "low" and "high" for its values."""

    def __init__(self) -> None:
        self.levels: dict[int, str] = {}
        self.released = False
        self.calls = 0

    def get_values(self, lines: list[int]) -> list[str]:
        return [self.levels.get(line, "low") for line in lines]

    def set_values(self, values: dict[int, str]) -> None:
        self.calls += 1
        self.levels.update(values)

    def release(self) -> None:
        self.released = True


class GpioBench(Bench):
    """Output bit b is line 100 + b, input bit b is line 9 - b."""

    def __init__(self) -> None:
        self.request = FakeRequest()
        self.map = LineMap(
            "/dev/gpiochip0",
            {bit: 100 + bit for bit in bits_of(WIRING.outputs)},
            {bit: 9 - bit for bit in bits_of(WIRING.inputs)},
        )
        self.driver = GpioLines(self.request, self.map, ("low", "high"))

    def outputs(self) -> int:
        return sum(1 << bit for bit, line in self.map.outputs.items() if self.request.levels[line] == "high")

    def put(self, image: int) -> None:
        for bit, line in self.map.inputs.items():
            self.request.levels[line] = "high" if image >> bit & 1 else "low"


class FirmataBench(Bench):
    PORTS = (2, 3, 4, 6)  # of output bits 0-7, 8-15, 16-23, 24-31
    INPUT_PORT = 5

    def __init__(self) -> None:
        self.stand_in = StandIn()
        self.driver = open_firmata(MEGA, self.stand_in.device, WIRING, listen_s=0.05)

    def outputs(self) -> int:
        pins = ((8 * n + bit, 8 * port + bit) for n, port in enumerate(self.PORTS) for bit in range(8))
        used = ((bit, pin) for bit, pin in pins if WIRING.outputs >> bit & 1)
        return sum(self.stand_in.board.output(pin) << bit for bit, pin in used)

    def put(self, image: int) -> None:
        self.stand_in.set_inputs(self.INPUT_PORT, image)


class TestSimulated(DriverConformance):
    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        yield SimulatedBench()


class TestSwitched(DriverConformance):
    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        yield SwitchedBench()

    def test_a_line_is_held_at_either_level_in_every_process(self) -> None:
        bench = SwitchedBench()
        bench.put(0b101)
        child = os.fork()
        if not child:
            bench.driver.hold(1, 1)
            bench.driver.hold(2, 0)
            bench.driver.hold(40, 1)
            os._exit(0)
        os.waitpid(child, 0)
        assert (bench.driver.latch(), bench.driver.held) == (0b011 | 1 << 40, 0b110 | 1 << 40)
        for bit in (1, 2, 40):
            bench.driver.hold(bit, None)
        assert (bench.driver.latch(), bench.driver.held) == (0b101, 0)


class TestRecorded(DriverConformance):
    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        yield RecordedBench()


class TestGpio(DriverConformance):
    """The fake's levels are in one process alone; a real request is a descriptor, and so the kernel's."""

    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        yield GpioBench()


class TestMapped(SharedCardConformance):
    @pytest.fixture
    def bench(self, tmp_path: Path) -> Iterator[Bench]:
        yield MappedBench(tmp_path / "card")


class TestPcl720(SharedCardConformance):
    @pytest.fixture
    def bench(self, tmp_path: Path) -> Iterator[Bench]:
        yield Pcl720Bench(tmp_path)


class TestFirmata(SharedCardConformance):
    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        bench = FirmataBench()
        yield bench
        bench.driver.close()
        bench.stand_in.vanish()

"""The loop closed around the AVR: what its pins put out moves a plant, and the plant's sensors are levels at its pins.

Rule: sees the pins alone. A message to one port reaches its pins within 40 us, far less than a rotor needs, so the
plant is driven by whole messages; a message that is not known to be whole waits for the next look.
Used by tests/firmware alone.
"""

import threading
from types import TracebackType

from drillctl.plant import IdealPlant
from drillctl.ports import bits_of
from tests.firmware.board import SAME_MESSAGE_CYCLES, SimulatedBoard
from tests.firmware.job import SPINDLE_PIN

LOOK_EVERY_S = 0.0005
FIRST_OUTPUT_PIN, FIRST_INPUT_PIN = 16, 40  # of a Mega: the card's bits 0..23, and its inputs 0..7
OUTPUT_PINS = range(FIRST_OUTPUT_PIN, FIRST_INPUT_PIN)
INPUTS = 6
LONGEST_WAIT_S = 5.0


class WiredPlant:
    """A plant wired to a simulated Mega. A context manager: inside, a thread keeps the loop.

    touches  where the bit met the board, coming down: X and Y in steps from machine zero
    turning  whether the spindle was on then
    """

    def __init__(self, arduino: SimulatedBoard, plant: IdealPlant):
        self.plant = plant
        self.touches: list[tuple[float, float]] = []
        self.turning: list[bool] = []
        self._spindle = False
        self._arduino = arduino
        self._image = 0
        self._last_port, self._last_cycle = -1, 0
        self._leave = threading.Event()
        self._thread = threading.Thread(target=self._keep, daemon=True)

    def __enter__(self) -> "WiredPlant":
        for bit in range(INPUTS):
            self._set_input(bit)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._leave.set()
        self._thread.join(LONGEST_WAIT_S)
        assert not self._thread.is_alive()

    def _keep(self) -> None:
        while not self._leave.wait(LOOK_EVERY_S):
            self._look()

    def _look(self) -> None:
        fresh = self._arduino.new_changes()
        for cycle, pin, level in fresh:
            if pin in OUTPUT_PINS:
                self._take(cycle, pin, level)
            elif pin == SPINDLE_PIN:
                self._spindle = bool(level)
        if not fresh:
            self._drive()

    def _take(self, cycle: int, pin: int, level: int) -> None:
        """One pin has changed; what came in a message before it is whole."""
        if pin // 8 != self._last_port or cycle - self._last_cycle >= SAME_MESSAGE_CYCLES:
            self._drive()
        bit = 1 << pin - FIRST_OUTPUT_PIN
        self._image = self._image | bit if level else self._image & ~bit
        self._last_port, self._last_cycle = pin // 8, cycle

    def _drive(self) -> None:
        """The plant follows the pins; what its sensors say of it goes to the AVR's inputs."""
        plant = self.plant
        inputs, touches = plant.inputs, plant.touches
        plant.drive(self._image)
        if plant.touches != touches:
            self.touches.append((plant.position_steps(0), plant.position_steps(1)))
            self.turning.append(self._spindle)
        for bit in bits_of(plant.inputs ^ inputs):
            self._set_input(bit)

    def _set_input(self, bit: int) -> None:
        self._arduino.set_input(FIRST_INPUT_PIN + bit, self.plant.inputs >> bit & 1)

"""A stand-in's Mega with a machine at its pins: 24 outputs to the plant, its sensors at one port of inputs."""

from drillctl.plant import IdealPlant
from tests.portio.firmata_stand_in import Sketch

OUTPUT_PORTS, INPUT_PORT = (2, 3, 4), 5  # bits 0..23, and inputs 0..7
OUTPUT_PINS = tuple(8 * port + bit for port in OUTPUT_PORTS for bit in range(8))


def follow_pins(sketch: Sketch, plant: IdealPlant) -> None:
    """The plant takes what stands at the outputs, the board sees and reports the plant's sensors. A board whose pins
    have no mode yet drives nothing.
    """
    board = sketch.board
    if board.modes:
        plant.drive(sum(board.output(pin) << bit for bit, pin in enumerate(OUTPUT_PINS)))
    board.outside[INPUT_PORT] = plant.inputs
    sketch.report()

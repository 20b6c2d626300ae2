"""How many machines x ticks a second a sweep tries: the fleet, by its size, against one rotor after another.

Run as ``python -m benchmarks.sweep_speed``. CPU time, in one process; both make the same moves and end at the same
places to the bit, which is looked at too. One after another, what rests is left out; a fleet leaves nothing out.
"""

import os
import time
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from drillctl.lab.moves import move
from drillctl.machine import Library, shipped_tables
from drillctl.plant.dynamic.axis import DynamicAxis
from drillctl.plant.dynamic.coefficients import coefficients
from drillctl.plant.dynamic.fleet import Fleet, Lane
from drillctl.plant.dynamic.rotor import rest_cycles, wires_of

SIZES = (30, 100, 300, 1000, 3000)
STEPS, RUNS = 100, 3
TABLE = Library((shipped_tables(),)).machine("pcb-drill").axes[0]


def lanes(count: int) -> list[Lane]:
    assert TABLE.dynamics is not None
    return [Lane(TABLE.dynamics, 400 + number % 200, rest_cycles(TABLE, 0)) for number in range(count)]


def seconds(run: Callable[[], object]) -> float:
    """The least of some runs."""
    found = []
    for _ in range(RUNS):
        began = time.process_time()
        run()
        found.append(time.process_time() - began)
    return min(found)


def alone(lane: Lane, images: list[int]) -> float:
    """One rotor by the law in plain floats."""
    axis, wires = DynamicAxis(coefficients(lane.dynamics, lane.tick_hz), lane.cycles), wires_of(TABLE)
    supplies = {image: wires.supply(image, lane.dynamics) for image in set(images)}
    for image in images:
        axis.tick(supplies[image])
    return axis.cycles


def together(lanes: list[Lane], images: NDArray[np.int64]) -> NDArray[np.float64]:
    """All of them side by side."""
    return Fleet(lanes, wires_of(TABLE)).run(images)


def main() -> None:
    images = move(TABLE, STEPS).images
    scalar = len(images) / seconds(lambda: alone(lanes(1)[0], images.tolist()))
    print(f"one after another: {scalar:12,.0f} machine ticks a second")
    for size in SIZES:
        chosen = lanes(size)
        rate = size * len(images) / seconds(partial(together, chosen, images))
        print(f"fleet of {size:5}:    {rate:12,.0f} machine ticks a second, {rate / scalar:5.1f} times")
    same = np.array_equal(together(lanes(SIZES[0]), images), [alone(lane, images.tolist()) for lane in lanes(SIZES[0])])
    print(f"places the same to the bit: {same}; load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if __name__ == "__main__":
    main()

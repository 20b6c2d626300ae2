"""A small machine in four files that every test of this room can change and load."""

from collections.abc import Callable
from pathlib import Path

import pytest

PHASE = """\
# three phases, six beats
name = "beat"

[[wire]]
name = "a"
volts = 5
pattern = "xx...x"

[[wire]]
name = "b"
volts = 5
pattern = ".xxx.."

[[wire]]
name = "c"
volts = 5
pattern = "...xxx"

[[wire]]
name = "24"
volts = 24
pattern = "x....."
"""

RAMP = """\
name = "gentle"

[[state]]
state = -2
accelerate = -2
brake = -3
interval = 1

[[state]]
state = -1
accelerate = -1
brake = -2
interval = 3

[[state]]
state = 0
accelerate = 0
brake = 0
interval = 5

[[state]]
state = 1
accelerate = 1
brake = 2
interval = 3

[[state]]
state = 2
accelerate = 2
brake = 3
interval = 1
"""

MOTOR = """\
name = "three"
columns_per_cycle = 6
rests_per_cycle = 6
zero_degrees = -60

[windings]
a = 0
b = 120
c = 240
"""

MACHINE = """\
name = "mini"
tick_hz = 500

[configuration]
card = "none"
longest_drilling_s = 9

[[axis]]
name = "x"
phase = "beat"
ramp = "gentle"
columns_per_step = 1
columns_per_inch = 1200
range = [-10, 1000]
start = 100

[[axis]]
name = "z"
phase = "beat"
ramp = "gentle"
columns_per_step = 2
columns_per_inch = 1200
range = [-10, 300]

[wiring]
"x.a" = 0
"x.b" = 1
"x.c" = 2
"x.24" = 3
"z.a" = 8
"z.b" = 9
"z.c" = 10
"z.24" = 11

[outputs]
spindle = 20

[[sensor]]
name = "x_min"
bit = 0
axis = "x"
end = "min"
edge = -5
hysteresis = 2

[[sensor]]
name = "z_top"
bit = 1
axis = "z"
end = "min"
edge = -2

[[sensor]]
name = "z_bottom"
bit = 2
axis = "z"
end = "max"
edge = 290

[[homing]]
do = "raise"
axes = ["z"]

[[homing]]
do = "seek"
axes = ["x"]
end = "min"

[drill]
axes = ["z"]

[plant]
board_surface = { z = 200 }
"""

MINI = {"phase/beat": PHASE, "ramp/gentle": RAMP, "motor/three": MOTOR, "machines/mini": MACHINE}
Written = Callable[..., Path]


@pytest.fixture
def tables(tmp_path: Path) -> Written:
    """Writes the four files into a folder, with one replacement in one of them; gives the changed file's path."""

    def write(table: str = "machines/mini", old: str = "", new: str = "") -> Path:
        for name, text in MINI.items():
            file = tmp_path / f"{name}.toml"
            file.parent.mkdir(exist_ok=True)
            assert name != table or old in text
            file.write_text(text.replace(old, new, 1) if name == table else text, "utf-8")
        return tmp_path / f"{table}.toml"

    return write

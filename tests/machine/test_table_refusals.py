"""Every check of every table: the reason and the line. One thing is changed in a sound set of tables; it is refused.

Rows: (old text, new text, reason[, at]). The fault stands on the line where ``at`` ends; without it, where the new
text ends; None: on no line, for the fault is in the whole file.
"""

from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.machine import Library, TableError

NAMES = "a name is letters, digits, - and _, no - or _ first"
REVERSE, ROW, DIRECTION = "[[reverse]]\n", 'pattern = "xxxxxx"\n', "[direction]\n"
INPUT, REACTION = "[[input]]\nname = 'stop'\n", "[[reaction]]\nfault = "
INDEX = "[[index]]\nname = 'pulse'\naxis = 'x'\nturn = 40\n"
Row = tuple[str | None, ...]
PHASE: list[Row] = [
    ('name = "a"\n', 'name = "a"\nvolt = 5\n', "wire[0]: unknown key volt", "volt = 5"),
    ("volts = 24", 'volts = "24"', "wire[3].volts: expected float, got str"),
    ('pattern = "...xxx"\n', "", "wire[2]: pattern is missing", 'pattern = ".xxx.."\n\n[[wire]]'),
    ("volts = 24", "volts = 0", "wire[3].volts: expected float > 0.0"),
    ("volts = 24", "volts = nan", "expected float > 0.0"),
    ('name = "b"', 'name = "a"', "wire a: a second row of this name", 'x...x"\n\n[[wire]]\nname = "a"'),
    ("...xxx", "...xx", "wire c: 5 columns, the first row has 6"),
    (".xxx..", ".xXx..", "wire b: 'X' in the pattern; only 'x' (on) and '.' (off)"),
    ("xx...x", "x", "wire a: 1 column; a table has 2 to 96", 'pattern = "x"'),
    ("xx...x", "x" * 97, "wire a: 97 columns"),
    ('name = "a"', 'name = "a b"', f"wire[0].name: {NAMES}"),
    ('name = "a"', 'name = "a\\n"', f"wire[0].name: {NAMES}"),
    ("[[wire]]", "[[wires]]", "unknown key wires"),
    ("x.....\"\n", f'x....."\n{REVERSE}name = "q"\n{ROW}', "reverse q: one row for each wire", 'name = "q"'),
    ("x.....\"\n", f'x....."\n{REVERSE}name = "a"\n{ROW}', "reverse: no row for 24, b, c", "[[reverse]]"),
    ("x.....\"\n", f'x....."\n{REVERSE}name = "a"\n{ROW[:-3]}"', "reverse a: 5 columns, the first row has 6"),
    ("x.....\"\n", f'x....."\n{DIRECTION}name = "c"\nvolts = 5\n', "direction c: a row has this name already",
     f'{DIRECTION}name = "c"'),
    ("x.....\"\n", f'x....."\n{DIRECTION}name = "d"\nvolts = 5\nforward = "X"\n',
     "direction d: forward is 'x' or '.'", 'forward = "X"'),
    ("volts = 24", "volts 24", "not TOML: Expected '=' after a key"),
]  # fmt: skip
RAMP: list[Row] = [
    ("interval = 5", "interval = 5.5", "state[2].interval: expected int, got float"),
    ("interval = 5", "interval = 0", "state[2].interval: expected int >= 1"),
    ("interval = 5\n", "", "state[2]: interval is missing", "interval = 3\n\n[[state]]"),
    ("state = 1\n", "state = 2\n", "state 2: a second row of this state", "interval = 3\n\n[[state]]\nstate = 2"),
    ("state = -2\naccelerate = -2\nbrake = -3", "state = -3\naccelerate = -2\nbrake = -3",
     "no row for state -2, 3; a ramp has all from -3 to 3", "[[state]]"),
    ("accelerate = 2", "accelerate = -2", "state 2: accelerate distance -2 must have the state's sign",
     "state = 2\naccelerate = -2"),
    ("brake = -2", "brake = 2", "state -1: brake distance 2 must have the state's sign"),
    ("brake = 0", "brake = 1", "state 0: brake distance 1 must have"),
    ("brake = 3", "brake = 1", "state 2: brake distance 1 is below state 1's"),
    ("brake = -3\ninterval = 1\n\n[[state]]\nstate = -1\naccelerate = -1\nbrake = -2",
     "brake = -1\ninterval = 1\n\n[[state]]\nstate = -1\naccelerate = -1\nbrake = -1",
     "state -2: a move of -4 steps is not landed on exactly", "brake = -1"),
    ("accelerate = 2", "accelerate = 1000000", "expected int <= 1000"),
]  # fmt: skip
MOTOR: list[Row] = [
    ("c = 240\n", "c = 240\nd = [1,", "not TOML: Invalid value"),
    ("c = 240\n", "c = " + "[" * 5000, "nested too deeply", None),
    ("c = 240\n", "c = " + "9" * 5000, "a number of thousands of digits", None),
    ("rests_per", "rest_per", "unknown key rest_per_cycle"),
    ("b = 120", 'b = "120"', 'windings: "b": expected int, got str'),
    ("c = 240", "c = 361", 'windings: "c": expected int <= 360'),
    ("b = 120\nc = 240\n", "", "a motor has either [windings]", 'name = "three"'),
    ("zero_degrees", 'direction = "d"\nzero_degrees', "or pulse, direction", 'name = "three"'),
]  # fmt: skip
MACHINE: list[Row] = [
    ("tick_hz = 500", "tick_hz = 500\ntick = 1", "unknown key tick"),
    ("start = 100", "strat = 100", "axis[0]: unknown key strat"),
    ("tick_hz = 500\n", "", "tick_hz is missing", None),
    ('ramp = "gentle"\ncolumns_per_step = 2', "columns_per_step = 2",
     "axis z: no ramp is named, and the file has no [parameters]",
     "start = 100\n\n[[axis]]"),
    ("tick_hz = 500", "tick_hz = 100001", "tick_hz: expected int <= 100000"),
    ("tick_hz = 500", "tick_hz = 500.0", "tick_hz: expected int, got float"),
    ("longest_drilling_s = 9", "longest_drilling_s = nan", "configuration.longest_drilling_s: expected float > 0.0"),
    ('name = "z"', 'name = "x"', "axis x: a second one of this name", 'start = 100\n\n[[axis]]\nname = "x"'),
    ('name = "x"', 'name = "plant"', "axis plant: traces use this name"),
    ('name = "x"', 'name = "x.1"', f"axis[0].name: {NAMES}"),
    ("[[axis]]", "[[axle]]", "unknown key axle"),
    ('phase = "beat"', 'phase = "bee"', "no phase table is named 'bee'"),
    ('ramp = "gentle"', 'ramp = "steep"', "no ramp table is named 'steep'"),
    ("start = 100", 'motor = "two"', "no motor table is named 'two'"),
    ('phase = "beat"', 'phase = "../phase/beat"', "no phase table is named '../phase/beat'"),
    ('phase = "beat"', 'phase = ".."', "no phase table is named '..'"),
    ('phase = "beat"', 'phase = "' + "p" * 300 + '"', "no phase table is named 'ppp"),
    ("range = [-10, 1000]", "range = [1000, -10]", "axis x: range 1000..-10 must reach from 0 or below"),
    ("range = [-10, 1000]", "range = [-10]", "axis[0].range: expected array of length 2, got 1"),
    ("start = 100", "start = 1001", "axis x: start 1001 is outside its range -10..1000"),
    ("columns_per_step = 2", "columns_per_step = 7", "axis z: 7 columns a step, its table has 6"),
    ('"z.c" = 10\n', "", 'wiring: no bit for "z.c", a wire of its phase table', "[wiring]"),
    ('"z.c" = 10', '"z.c" = 10\n"z.d" = 12', 'wiring: no axis has a wire "z.d"'),
    ('"z.c" = 10', '"z.c" = 10\n\'w.a\' = 12', 'wiring: no axis has a wire "w.a"'),
    ('"z.c" = 10', '"z.c" = 9', 'wiring: output bit 9 of "z.c" is z.b\'s already'),
    ("spindle = 20", "spindle = 8", 'outputs: output bit 8 of "spindle" is z.a\'s already'),
    ("spindle = 20", '"a b" = 20', f"outputs: 'a b': {NAMES}"),
    ('"z.c" = 10', '"z.c" = 128', 'wiring: "z.c": expected int <= 127'),
    ("spindle = 20", "spindle = -1", 'outputs: "spindle": expected int >= 0'),
    ('"x.a" = 0', '"x.a" = "0"', 'wiring: "x.a": expected int, got str'),
    ('name = "z_top"', 'name = "x_min"', "sensor x_min: a second one of this name",
     'hysteresis = 2\n\n[[sensor]]\nname = "x_min"'),
    ("bit = 1\n", "bit = 0\n", "sensor z_top: input bit 0 is x_min's already", 'name = "z_top"\nbit = 0'),
    ('axis = "x"', 'axis = "w"', "sensor: no axis is named 'w'; there are x, z"),
    ('end = "max"', 'end = "min"', "sensor z_bottom: z has a min sensor already", 'bit = 2\naxis = "z"\nend = "min"'),
    ('end = "max"', 'end = "top"', "sensor[2].end: invalid enum value 'top'"),
    ("edge = -5", "edge = -9", "sensor x_min: edge -9 leaves no room to brake (2 steps) inside the range -10..1000"),
    ("edge = 290", "edge = 299", "sensor z_bottom: edge 299 leaves no room to brake"),
    ("edge = 290", "edge = -2", "sensor z_bottom: edge -2 of z_top must lie below edge -2 of z_bottom",
     'end = "max"\nedge = -2'),
    ('axes = ["x"]', 'axes = ["y"]', "homing: no axis is named 'y'; there are x, z"),
    ('end = "min"\n\n[drill]', 'end = "max"\n\n[drill]', "homing: seek needs a max sensor, and x has none",
     'do = "seek"\naxes = ["x"]'),
    ('do = "seek"', 'do = "find"', "homing[1].do: invalid enum value 'find'"),
    ('axes = ["x"]', "axes = []", "homing[1].axes: expected array of length >= 1"),
    ('[drill]\naxes = ["z"]', '[drill]\naxes = ["q"]', "drill: no axis is named 'q'; there are x, z"),
    ('[drill]\naxes = ["z"]', '[drill]\naxes = ["z"]\ndown = 301', "drill: down 301 is outside 1..300 of z"),
    ('[drill]\naxes = ["z"]', '[drill]\naxes = ["z"]\ndown = 0', "drill: down 0 is outside 1..300 of z"),
    ('[drill]\naxes = ["z"]', '[drill]\naxes = ["z"]\nclear = -1', "drill: clear -1 is outside 0..299 of z"),
    ('[drill]\naxes = ["z"]', '[drill]\naxes = ["z"]\nclear = 300', "drill: clear 300 is outside 0..299 of z"),
    ('[drill]\naxes = ["z"]', '[drill]\naxes = ["z"]\ndown = 90\nclear = 90', "drill: clear 90 is outside 0..89 of z"),
    ("{ z = 200 }", "{ q = 200 }", "plant: no axis is named 'q'; there are x, z"),
    ("tick_hz = 500", "tick_hz = 500\nonly_zero_after = ['LIMIT']",
     "only_zero_after: no fault 'LIMIT' keeps the position here; there are none", "only_zero_after"),
    ("tick_hz = 500", "tick_hz = 500\nreturn_interval = -1", "return_interval: expected int >= 0"),
    ("[drill]", f"{INPUT}bit = 1\n[drill]", "input stop: input bit 1 is z_top's already", f"{INPUT}bit = 1"),
    ("[drill]", f"{INPUT}bit = 4\n{INPUT}bit = 5\n[drill]", "input stop: a second one of this name",
     f"{INPUT}bit = 4\n{INPUT}"[:-1]),
    ("[drill]", f"{INPUT}bit = 4\naction = 'home'\n[drill]", "input[0].action: invalid enum value 'home'",
     "action = 'home'"),
    ("[drill]", f"{INPUT}bit = 128\n[drill]", "input[0].bit: expected int <= 127", "bit = 128"),
    ("[drill]", "[[input]]\nname = 'x_min'\nbit = 4\n[drill]", "input x_min: a sensor has this name already",
     "[[input]]\nname = 'x_min'"),
    ("[drill]", f"{INDEX}bit = 1\n[drill]", "index pulse: input bit 1 is z_top's already", f"{INDEX}bit = 1"),
    ("[drill]", f"{INDEX}bit = 4\nwidth = 40\n[drill]", "index pulse: width 40 leaves no gap in a turn of 40 steps",
     f"{INDEX}bit = 4\nwidth = 40"),
    ("[drill]", f"{INDEX}bit = 4\n{INDEX.replace('pulse', 'other')}bit = 5\n[drill]",
     "index other: x has an index already", f"{INDEX}bit = 4\n[[index]]\nname = 'other'\naxis = 'x'"),
    ("[drill]", f"{INDEX.replace('pulse', 'z_top')}bit = 4\n[drill]",
     "index z_top: a sensor or an input has this name already", "[[index]]\nname = 'z_top'"),
    ('do = "seek"', 'do = "index"', "homing: index needs an [[index]], and x has none", 'do = "index"\naxes = ["x"]'),
    ("bit = 1\n", "line = 'stop'\n", "sensor z_top: no input is named 'stop'; there are none", "line = 'stop'"),
    ("bit = 1\n", "", "sensor z_top: it has either a bit, or a line that it shares", 'hysteresis = 2\n\n[[sensor]]'),
    ("[drill]", f"{REACTION}'LIMIT'\ndo = 'drop'\nposition = 'kept'\n[drill]",
     "reaction LIMIT: the position can't be kept: a motor without current can be turned by hand", "[[reaction]]"),
    ("[drill]", f"{REACTION}'RANGE'\ndo = 'brake'\nposition = 'kept'\n[drill]",
     "reaction RANGE: the position can't be kept: it is the count of steps that has left the range", "[[reaction]]"),
    ("[drill]", f"{REACTION}'HEAD_NOT_UP'\ndo = 'return'\nposition = 'lost'\n[drill]",
     "reaction HEAD_NOT_UP: the machine can't return: the return to zero begins by raising the head", "[[reaction]]"),
    ("[drill]", f"{REACTION}'PORT_LOST'\ndo = 'brake'\nposition = 'lost'\n[drill]",
     "reaction PORT_LOST: it can't be chosen: the port is gone", "[[reaction]]"),
    ("[drill]", f"{REACTION}'EMERGENCY_STOP'\ndo = 'brake'\nposition = 'kept'\n[drill]",
     "reaction EMERGENCY_STOP: it can't be chosen: emergency_stop says what the machine does", "[[reaction]]"),
    ("[drill]", f"{REACTION}'LIMITS'\ndo = 'brake'\nposition = 'kept'\n[drill]",
     "reaction: no fault is named 'LIMITS'; there are BAD_COMMAND", "fault = 'LIMITS'"),
    ("[drill]", 2 * f"{REACTION}'LIMIT'\ndo = 'brake'\nposition = 'kept'\n" + "[drill]", "reaction LIMIT: a second row",
     f"{REACTION}'LIMIT'\ndo = 'brake'\nposition = 'kept'\n{REACTION}'LIMIT'"),
    ("[drill]", "[[output]]\nname = 'spindle'\nbit = 30\n[drill]", "output spindle: a second one of this name",
     "[[output]]\nname = 'spindle'"),
    ("[drill]", "[[output]]\nname = 'fan'\nbit = 20\n[drill]", "output: output bit 20 of \"fan\" is spindle's already",
     "[[output]]"),
    ("[drill]", "[[output]]\nname = 'fan'\nword = [19, 3]\n[drill]", 'output: output bit 20 of "fan" is spindle',
     "[[output]]"),
    ("[drill]", "[[output]]\nname = 'fan'\n[drill]", "output fan: it has either a bit, or a word of several",
     "[[output]]"),
    ("[drill]", "[[output]]\nname = 'fan'\nword = [40, 8]\nestop = 1\n[drill]",
     'output fan: a word goes to 0 or is kept ("keep"), it can\'t go to 1', "[[output]]"),
    ("[drill]", "[[output]]\nname = 'fan'\nword = [60, 8]\n[drill]", "fan: bits 60 to 67 are not of one card",
     "word = [60, 8]"),
    ("[drill]", "[[output]]\nname = 'fan'\nbit = 64\nstop = 'keep'\n[drill]",
     "output fan: one that is kept or set has a bit below 64", "[[output]]"),
    ("[drill]", "[[output]]\nname = 'fan'\nbit = 30\nstop = 'on'\n[drill]", "output[0].stop: invalid enum value 'on'",
     "stop = 'on'"),
    ("[drill]", "[[input]]\nname = 'speed'\nword = [0, 16]\n[drill]", "input speed: input bit 0 is", "[[input]]"),
    ("[drill]", "[[input]]\nname = 'speed'\nword = [32, 16]\naction = 'stop'\n[drill]",
     "input speed: a word has no active level and asks for nothing", "[[input]]"),
    ("[drill]", "[[input]]\nname = 'speed'\n[drill]", "input speed: it has either a bit, or a word of several",
     "[[input]]"),
    ("{ z = 200 }", '{ z = "200" }', 'board_surface: "z": expected int, got str'),
    ("[plant]\nboard_surface = { z = 200 }", "[plant.board_surface]\nz = 2.5",
     'board_surface: "z": expected int, got float'),
]  # fmt: skip
TABLES = {"phase/beat": PHASE, "ramp/gentle": RAMP, "motor/three": MOTOR, "machines/mini": MACHINE}
CASES = [(table, *row[:3], row[-1] if len(row) > 3 else row[1]) for table, rows in TABLES.items() for row in rows]


def line_of(text: str, at: str | None) -> int | None:
    """The line, from 1, on which the piece ends; pieces are chosen to stand in the text once, or first there."""
    return None if at is None else text.count("\n", 0, text.index(at) + len(at)) + 1


@pytest.mark.parametrize(("table", "old", "new", "reason", "at"), CASES)
def test_refused_with_reason_and_line(
    table: str, old: str, new: str, reason: str, at: str | None, tables: Callable[..., Path], tmp_path: Path
) -> None:
    changed = tables(table, old, new)
    with pytest.raises(TableError) as refused:
        Library((tmp_path,)).machine("mini")
    error = refused.value
    place = f"{changed}" if at is None else f"{changed}:{line_of(changed.read_text(), at)}"
    assert reason in error.reason and "\n" not in error.reason
    assert str(error) == f"{place}: {error.reason}"


def test_the_unchanged_tables_are_sound(tables: Callable[..., Path], tmp_path: Path) -> None:
    tables()
    machine = Library((tmp_path,)).machine("mini")
    assert machine.axis_names == ("x", "z") and machine.axes[0].motor.name == "three"
    assert [Path(file).stem for file in machine.files] == ["mini", *["beat", "gentle", "three"] * 2]
    assert machine.board_surface == (None, 200) and machine.outputs == (("spindle", 20),)

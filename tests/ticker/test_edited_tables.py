"""LOAD: edited tables into a running machine, at rest, whole or not at all; here and in the ticker's own process."""

import json
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drillctl.generation.job import names_of
from drillctl.kmd import parse_program
from drillctl.machine import Library, Machine, TableError, shipped_tables
from drillctl.machine.bundle import bundle, unbundle
from drillctl.machine.edit import set_pattern, set_state_row
from drillctl.plant import IDEAL_PLANT
from drillctl.portio.simulated import SimulatedCard
from drillctl.replay.compare import replay
from drillctl.ticker.edited_tables import AT_WORK, OTHER_MACHINE, differs_in_tables_alone
from drillctl.ticker.link import Link, LocalLink
from drillctl.ticker.paced_link import PacedLink
from drillctl.ticker.ticker import Ticker
from drillctl.trace import TraceError, write_text

pytestmark = pytest.mark.paced

LIBRARY = Library((shipped_tables(),))
MACHINE = LIBRARY.machine("pcb-drill").at_rate(1000)
MOST_TURNS = 3000
LINKS = ["local", pytest.param("paced", marks=pytest.mark.skipif(sys.platform != "linux", reason="real pace"))]
Make = Callable[[], Link]


@pytest.fixture(params=LINKS)
def link(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Link]:
    plant = IDEAL_PLANT.build(MACHINE)
    card = SimulatedCard(plant)
    made: Link
    if request.param == "local":
        made = LocalLink(Ticker(MACHINE, card, plant, traced=True))
    else:
        made = PacedLink(MACHINE, card, plant, tmp_path / "status", traced=True, derived=False)
    yield made
    made.close()


def edited(name: str, change: Callable[[str], str]) -> str:
    """The machine's bundle with one of its files changed."""
    told = json.loads(bundle(MACHINE))
    told["files"] = [(file, change(text) if Path(file).name == name else text) for file, text in told["files"]]
    return json.dumps(told)


def slower(text: str) -> str:
    return set_state_row(text, 0, "interval", 20)


def ramp_file() -> str:
    return f"{MACHINE.axes[0].ramp.name}.toml"


def move(link: Link, text: str) -> int:
    """Runs commands; the ticks they took."""
    first = link.status()
    program = parse_program(text, names_of(MACHINE))
    program["sequence"] += first["done"]
    program["epoch"] = first["epoch"]
    link.queue.put(program)
    for _ in range(MOST_TURNS):
        link.turn()
        if link.status()["done"] == program["sequence"][-1]:
            return int(link.status()["tick"] - first["tick"])
    raise AssertionError("never ended")


def test_a_bundle_is_the_machine() -> None:
    for name in LIBRARY.machine_names():
        machine = LIBRARY.machine(name)
        again = unbundle(bundle(machine))
        assert again == machine and again.digest == machine.digest


def test_a_wrong_bundle_names_the_file_and_line() -> None:
    with pytest.raises(TableError, match=rf"{ramp_file()}.*interval"):
        unbundle(edited(ramp_file(), lambda text: text.replace("interval", "intervall")))


def test_an_edited_ramp_is_driven_by_from_then_on(link: Link) -> None:
    move(link, "KMD_INICJALIZACJA")
    before = move(link, "KMD_RUCHd x=1")
    places = link.status()["position"].tolist()
    assert link.load(edited(ramp_file(), slower)) is None
    assert move(link, "KMD_RUCHd x=1") > before
    status = link.status()
    assert status["position"][0] == places[0] + 1 and not status["position_known"]
    assert not any(status["lost"].tolist()), "the plant was not touched"
    move(link, "KMD_INICJALIZACJA")
    assert link.status()["position_known"]


def test_an_edited_phase_table_puts_its_columns_out(link: Link) -> None:
    move(link, "KMD_RUCHd x=1")
    table = MACHINE.axes[0].phase
    wire = table.wires[0].name
    dark = "." * table.columns
    assert link.load(edited(f"{table.name}.toml", lambda text: set_pattern(text, wire, dark))) is None
    move(link, "KMD_RUCHd x=12")
    assert not int(link.status()["image"]) >> MACHINE.axes[0].wire_bits[0] & 1


@pytest.mark.parametrize("what", ["wrong", "other", "at work"])
def test_a_refusal_changes_nothing(what: str, link: Link) -> None:
    before = move(link, "KMD_RUCHd x=3")
    reasons = {"wrong": ramp_file(), "other": OTHER_MACHINE, "at work": AT_WORK}
    bundles = {
        "wrong": edited(ramp_file(), lambda text: text.replace("interval", "intervall")),
        "other": bundle(LIBRARY.machine("eight-axis")),
        "at work": edited(ramp_file(), slower),
    }
    if what == "at work":
        status = link.status()
        long = parse_program("KMD_RUCHd x=400\nKMD_RUCHd x=-400", names_of(MACHINE))
        long["sequence"] += status["done"]
        link.queue.put(long)
        while not link.status()["job"]:
            link.turn()
    assert reasons[what] in (link.load(bundles[what]) or "")
    if what == "at work":
        while link.status()["job"]:
            link.turn()
    assert move(link, "KMD_RUCHd x=3") == before


def test_the_trace_tells_of_it_and_is_not_replayed(link: Link, tmp_path: Path) -> None:
    move(link, "KMD_RUCHd x=1")
    link.load(edited(ramp_file(), slower))
    for _ in range(50):
        link.turn()
    trace = link.trace([("machine", MACHINE.name), ("digest", MACHINE.digest), ("tick_hz", "1000")])
    assert trace is not None
    write_text(trace, tmp_path / "t.trace")
    with pytest.raises(TraceError, match=r"edited at tick \d+ \(LOAD\)"):
        replay(tmp_path / "t.trace", LIBRARY)


def test_what_else_has_changed_is_seen() -> None:
    def changed(**fields: object) -> Machine:
        return MACHINE.__class__(**{**{name: getattr(MACHINE, name) for name in MACHINE.__slots__}, **fields})

    assert differs_in_tables_alone(unbundle(edited(ramp_file(), slower)).at_rate(1000), MACHINE)
    assert not differs_in_tables_alone(changed(homing=()), MACHINE)
    assert not differs_in_tables_alone(MACHINE.at_rate(500), MACHINE)
    assert not differs_in_tables_alone(LIBRARY.machine("eight-axis"), MACHINE)

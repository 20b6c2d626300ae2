"""The law of the dynamic plant: compiled and plain give the same bits; a stretch of ticks is its single ticks."""

from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.files import compiled
from drillctl.lab.moves import move
from drillctl.machine import Library, shipped_tables
from drillctl.plant.dynamic import law, motors
from drillctl.plant.dynamic.kernel import KERNEL, PLAIN, Kernel
from drillctl.plant.dynamic.plant import DynamicPlant
from tests.support.scripts import script

LIBRARY = Library((shipped_tables(),))
FAULTS = ((), ("blunt=3",), ("broken=1",), ("loose.x=0.4", "jammed.z=3"), ("bouncing.z_top=7", "stuck.x_min=1"))
MOST_TICKS = 2500  # of a move: the drum's ticks are fine
NEEDS_COMPILED = pytest.mark.skipif(not KERNEL.compiled, reason="the law is not compiled here (hatch_build.py)")

moves = st.lists(st.tuples(st.integers(0, 7), st.integers(1, 25), st.booleans()), min_size=1, max_size=3)


def images_of(machine_name: str, wanted: list[tuple[int, int, bool]]) -> np.ndarray:
    """One move after the other, each of one axis, up or down, the others without current."""
    machine = LIBRARY.machine(machine_name)
    parts = []
    for index, steps, up in wanted:
        table = machine.axes[index % len(machine.axes)]
        parts.append(move(table, steps if up else -steps, rest_ticks=3).images[:MOST_TICKS])
    return np.concatenate(parts).astype(np.uint64)


def state(plant: DynamicPlant) -> list[object]:
    motors = [(m.axis.currents, m.axis.speed, m.axis.cycles, m.degrees) for m in plant.motors]
    places = [plant.position_steps(axis) for axis in range(len(plant.motors))]
    return [motors, places, plant.inputs, plant.touches, plant.image, [bit.wear_m for bit in plant.bits]]


@NEEDS_COMPILED
@settings(max_examples=12)
@given(
    name=st.sampled_from(["pcb-drill", "pcb-drill-ramp-lab", "boiler-drum", "eight-axis"]),
    faults=st.sampled_from(FAULTS), wanted=moves,
)  # fmt: skip
def test_compiled_and_plain_give_the_same_bits(
    name: str, faults: tuple[str, ...], wanted: list[tuple[int, int, bool]]
) -> None:
    images = images_of(name, wanted)
    faults = faults if name.startswith("pcb-drill") else ()  # the others have no axis z
    plants = [DynamicPlant(LIBRARY.machine(name), faults, 3, each) for each in (KERNEL, PLAIN)]
    for image in images.tolist():
        for plant in plants:
            plant.drive(image)
        assert state(plants[0]) == state(plants[1])


@pytest.mark.parametrize("form", [KERNEL, PLAIN], ids=["chosen", "plain"])
@settings(max_examples=8)
@given(faults=st.sampled_from(FAULTS), wanted=moves, seed=st.integers(0, 9))
def test_a_stretch_is_its_ticks_and_ends_where_an_input_changes(
    form: Kernel, faults: tuple[str, ...], wanted: list[tuple[int, int, bool]], seed: int
) -> None:
    machine, images = LIBRARY.machine("pcb-drill"), images_of("pcb-drill", wanted)
    whole, single = DynamicPlant(machine, faults, seed, form), DynamicPlant(machine, faults, seed, form)
    done = 0
    while done < len(images):
        ticks = whole.run(images[done:])
        assert ticks > 0
        for number, image in enumerate(images[done : done + ticks].tolist(), 1):
            before = single.inputs, single.touches
            single.drive(image)
            assert number == ticks or before == (single.inputs, single.touches)
        assert state(whole) == state(single)
        done += ticks


@NEEDS_COMPILED
def test_a_kernel_of_another_text_is_not_taken_and_says_so(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    assert all(compiled.compiled_form(module) for module in (motors, law))
    monkeypatch.setattr(compiled, "digest", lambda name, read: "another")
    assert not any(compiled.compiled_form(module) for module in (motors, law))
    assert [record.levelname for record in caplog.records] == ["WARNING"] * 2
    assert "dynamic.motors was changed since it was compiled" in caplog.text


@NEEDS_COMPILED
def test_a_kernel_that_was_built_beside_another_is_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(name: str) -> ModuleType:
        raise TypeError(f"{name}: a C function has the wrong signature")

    monkeypatch.setattr(compiled, "import_module", fail)
    assert compiled.compiled_form(law) is None


@pytest.mark.parametrize("name", ["motors", "law"])
def test_the_build_and_the_program_tell_texts_apart_alike(name: str) -> None:
    folder = Path(law.__file__).parent
    here = compiled.digest(name, lambda file: (folder / file).read_bytes())
    assert script("hatch_build.py")._digest(folder / name) == here


def test_where_nothing_can_be_compiled_the_package_is_built_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def no_compiler(root: Path, loop: str) -> Path:
        raise SystemExit("command 'cc' failed")

    module = script("hatch_build.py")
    monkeypatch.setattr(module, "build", no_compiler)
    hook, build_data = SimpleNamespace(target_name="wheel", root=str(tmp_path)), {"force_include": {}}
    module.CompilingHook.initialize(hook, "editable", build_data)
    assert build_data == {"force_include": {}}
    assert "law runs uncompiled: command 'cc' failed" in capsys.readouterr().err

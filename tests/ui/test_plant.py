"""The Plant screen: plant, faults and seed chosen without an option; from the menu to steps that are lost, and seen."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from msgspec.structs import replace

from drillctl.console.plant import WORDS
from drillctl.language import Message, words
from drillctl.machine import Library
from drillctl.plant.faults import FAULT_KINDS
from drillctl.ui.models.fault_effects import EFFECTS
from drillctl.ui.screens.plant import PlantScreen
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.plant import FaultWord, PlantView
from tests.support.labels import menu
from tests.ui.editor_fakes import Shell, press, text_of
from tests.ui.fake_console import VIEW, FakeConsole, Program
from tests.ui.whole import Whole, at_home

MOST_TURNS = 20_000
BLUNT = FaultWord("blunt=N", 0, 1000, Message("metres of board that the drill has cut already"))
PLANT = PlantView("ideal", (), 0, (BLUNT,), ("x_min",), ("x", "y"))


@dataclass
class Plants:
    """A PlantControl."""

    view: PlantView = PLANT
    answer: Problems = ()
    done: list[tuple[str, ...]] = field(default_factory=list)

    def plant(self) -> PlantView:
        return self.view

    def swap(self) -> Problems:
        self.done.append(("swap",))
        return self.answer

    def choose(self, faults: str, seed: str) -> Problems:
        self.done.append((faults, seed))
        return self.answer


def test_the_plant_in_use_and_every_fault_with_its_range() -> None:
    plants = Plants()
    drawn = PlantScreen(FakeConsole(), Shell(), plants)
    text = text_of(drawn)
    assert all(part in text for part in ("In use        ideal", "blunt=N", "0..1000", "metres", "x_min", "AXIS: x, y"))
    plants.view = replace(PLANT, kind="dynamic", faults=("blunt=3", "loose.x=1"), seed=7)
    drawn.refresh(VIEW)
    text = text_of(drawn)
    assert all(part in text for part in ("dynamic", "blunt=3 loose.x=1", "Seed          7"))
    plants.view = replace(PLANT, real_port="firmata")
    drawn.refresh(VIEW)
    assert "firmata, a real machine" in text_of(drawn)


def test_what_every_fault_does_is_told_and_drawn() -> None:
    assert set(EFFECTS) == set(FAULT_KINDS)
    for name, effect in EFFECTS.items():
        first, *others = [marks for _label, marks in effect.drawn]
        assert others and first not in others and {len(marks) for marks in others} == {len(first)}, name


def test_the_fault_under_the_cursor_is_explained_at_every_size_and_all_are_where_there_is_room() -> None:
    plants = Plants(replace(PLANT, words=WORDS))
    drawn = PlantScreen(FakeConsole(), Shell(), plants, plain=True)
    for language in ("en", "pl"):
        words.use(language)
        for at, (word, effect) in enumerate(zip(WORDS, EFFECTS.values(), strict=True)):
            for size in ((78, 20), (98, 27), (158, 45)):
                shown = text_of(drawn, size)
                assert f">{word.usage}" in shown
                for part in (effect.cause, effect.seen):
                    assert words._(part)[-15:] in shown, (size, word.usage)
            press(drawn, "down")
            assert drawn._at == min(at + 1, len(WORDS) - 1)
        assert all(words._(effect.cause)[-15:] in text_of(drawn, (158, 46)) for effect in EFFECTS.values())
        press(drawn, *["up"] * len(WORDS))


def test_a_refusal_of_the_other_plant_is_told() -> None:
    plants, shell = Plants(answer=(Message("a real machine hangs on gpio"),)), Shell()
    drawn = PlantScreen(FakeConsole(), shell, plants)
    press(drawn, "f6")
    assert plants.done == [] and [line[0] for line in shell.offered] == ["*", " "], "ideal is in force"
    shell.picks = 1
    press(drawn, "f6")
    assert plants.done == [("swap",)]
    assert shell.told == [("Nothing changed", ["a real machine hangs on gpio"])]


def test_the_line_of_the_machine_and_its_window_name_the_plant_while_it_is_dynamic() -> None:
    assert "dynamic" not in Program(FakeConsole()).text()
    shown = Program(FakeConsole(now=replace(VIEW, plant="dynamic blunt=3 loose.x=1")), (100, 40)).text()
    assert "pcb-drill | dynamic, faults: 2 |" in shown and "dynamic blunt=3 loose.x=1" in shown


def keys(screen: str, method: str = "") -> tuple[str, ...]:
    return tuple(f"meta {key[1]}" if key[0] == "\x1b" else key for key in menu(screen, method))


def until(program: Whole, holds: Callable[[], object]) -> None:
    for _ in range(MOST_TURNS):
        if holds():
            return
        program.go_on(1)
    raise AssertionError(program.text())


def test_a_fault_that_cannot_be_is_refused_in_its_box_and_then_put_right(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    at_home(tmp_path, monkeypatch)
    program = Whole((100, 32))
    try:
        program.press(*keys("plant"), "enter", *"blnt=3", "tab", "tab", "enter")
        text = " ".join(program.text().replace("│", " ").split())
        assert "'blnt=3': not known" in text and "did you mean blunt=N, N from 0 to 1000?" in text
        assert program.console.view().plant == ""
        program.press("up", "up", *["left"] * 4, "u", "down", "down", "enter")
        assert program.app.layers.top is None and program.console.view().plant == "dynamic blunt=3"
        program.go_on(1)
        assert "dynamic, faults: 1" in program.text()
    finally:
        program.console.close()


def test_from_the_menu_to_a_table_that_loses_steps_and_to_seeing_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No option at the start: the dynamic plant, the forcing taken out of the table, a motion, the Lost line."""
    at_home(tmp_path, monkeypatch)
    program = Whole((100, 32), Library.standard())
    lost = re.compile(r"Lost +(\S+) (\S+) (\S+)")
    try:
        program.press(*keys("plant"), "f6", "2", "esc")
        program.go_on(1)
        assert "| dynamic |" in program.text()
        program.press(*keys("phase_editor"), "enter")
        assert "two-phase-forced" in program.text()
        program.press(*["down"] * 4, " ", *["right"] * 6, " ", "down", *["left"] * 3, " ", *["right"] * 6, " ")
        program.press("f2", "y", "esc", "esc")
        program.press("i")
        until(program, lambda: program.console.view().position_known and not program.console.at_work)
        program.press("t", *"20 20", "enter")
        until(program, lambda: not program.console.at_work)
        found = lost.search(program.text())
        assert found, program.text()
        assert any(int(steps) for steps in found.groups()), program.text()
    finally:
        program.console.close()

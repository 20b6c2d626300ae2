"""Keys, clicks and new sizes at random on the whole program, with a machine that runs free behind it.

Nothing is raised, nothing moves but by the few actions that the operator knows to move something, the emergency stop
is live in every state that comes up, and every text has its room. Spied on is the console: whatever goes down to the
machine goes through it.
"""

import random
from collections import Counter
from contextlib import suppress
from itertools import product
from pathlib import Path

import pytest
import urwid

from drillctl.language import words
from tests.ui.cuts import Cuts, is_word_cut, noted
from tests.ui.whole import Event, Whole, at_home

EVENTS = 80
MANY_EVENTS = 10_000
MOST_LOOKS = 400  # a hundred turns apart
LONG = (pytest.mark.long, pytest.mark.timeout(3600))  # minutes on an idle computer
MACHINES = ("pcb-drill", "boiler-drum", "eight-axis", "ramp-lab")
SIZES = [(80, 24), (160, 50), (60, 18), (40, 12), (50, 15), (100, 32), (220, 60)]
KEYS = [
    *"abcdefghijklmnopqrstuvwxyzABX0123456789 +-=.,", "enter", "enter", "esc", "esc", "tab", "up", "down", "left",
    "right", "page up", "page down", "home", "end", "backspace", "delete", "insert", *(f"f{n}" for n in range(1, 10)),
    "f11", "f12", "ctrl p", "ctrl g", "meta f", "meta d", "meta t", "meta c", "meta h", "window resize",
]  # fmt: skip
# Now and then somebody knows the way: closes what is open, acknowledges, goes where things happen.
CLOSED = (*("esc",) * 4, "meta d", "a")
WAYS = [
    (*CLOSED, "meta d", "a"), (*CLOSED, "meta d", "i"), (*CLOSED, "meta d", "s", "right", "enter", "right", "enter"),
    (*CLOSED, "meta d", "d"), (*CLOSED, "meta d", "h"), (*CLOSED, "meta f", "o", "down", "enter", "esc"),
    (*CLOSED, "meta t", "q", *"KMD_RUCHd x=9", "f5"), (*CLOSED, "meta t", "p", "enter"), (*CLOSED, "meta t", "s"),
    (*CLOSED, "meta t", "r", "enter"), (*CLOSED, "meta t", "o"), (*CLOSED, "meta c", "p", "enter"),
    *((*CLOSED, "f9", *("right",) * menu, *("down",) * entry, "enter") for menu in (0, 2, 3) for entry in range(8)),
]  # fmt: skip
CLICKS = ("mouse press", "mouse release", "mouse drag")

# What the operator knows to move something: a method of a screen. Each is a key of its table or an entry of a menu.
MOVING = {
    "BoardControls.dry_run", "BoardControls.hold_or_resume", "BoardControls.initialise", "BoardControls.set_base",
    "BoardControls._go_to", "BoardControls.return_to_zero", "JogControls.jog_on", "JogControls.jog_back",
    "QueueEditor.run_all", "QueueEditor.run_to_cursor", "QueueEditor.run_line", "QueueEditor.tick",
    "AlignmentScreen.go_there", "MachineScreen.park", "Signals.toggle", "Panel.return_to_zero",
    "Panel.start", "Panel.resume",
}  # fmt: skip
CARRIED_ON = "Jogging.carry_on"  # the one step that waits while a jog is on its way; it was asked for by a key
ANSWERED = "Dialog._closed_by.<locals>.both"  # a button was pressed


class Chance(Whole):
    """The program, and somebody who presses what comes to hand."""

    def __init__(self, seed: int, machine: str):
        super().__init__()
        if machine != "pcb-drill":
            self.app.take_machine(machine)
        self.random = random.Random(seed)
        self.seen: Counter[tuple[str, str]] = Counter()
        self.waiting = 0  # keys of jogs

    def event(self) -> None:
        """One, or a way of some; and what the machine makes of it."""
        events = self.random.choice(WAYS) if self.random.random() < 0.2 else (self._event(),)
        for event in events:
            with suppress(urwid.ExitMainLoop):  # Quit was found
                self.press(event)
        self.go_on(self.random.choice((0, 1, 5, 50)))
        self.canvas()

    def state(self) -> tuple[str, str]:
        """What is on top, and over which screen."""
        return type(self.app.layers.top).__name__, type(self.app.screens[-1]).__name__

    def _event(self) -> Event:
        if self.random.random() < 0.2:
            columns, rows = self.paper.size
            place = self.random.randrange(columns), self.random.randrange(rows)
            return (self.random.choice(CLICKS), self.random.choice((1, 1, 1, 3, 4, 5)), *place)
        key = self.random.choice(KEYS)
        if key == "window resize":
            self.paper.size = self.random.choice(SIZES)
        return key


def check_moves(chance: Chance) -> None:
    """What moved since the last look was asked for; what bores or goes on with a job, in answer to a question."""
    for what, by in chance.console.moved:
        chance.waiting += {"jog": 1, "run_queue": -int(CARRIED_ON in by and not by & MOVING)}.get(what, 0)
        assert chance.waiting >= 0, "more steps were made than keys pressed"
        assert by & MOVING or ANSWERED in by or CARRIED_ON in by, (what, by)
        assert what not in ("start", "go_on", "tool_changed") or ANSWERED in by, (what, by)
        assert "App._beat" not in by and "App.turn" not in by, (what, by)
    chance.console.moved.clear()


def check_stop(chance: Chance) -> None:
    """F10 reaches the machine from here; one that brakes down its ramps takes thousands of ticks to rest."""
    before = chance.console.stops
    chance.press("f10")
    for _ in range(MOST_LOOKS):
        chance.go_on(100)
        if not (view := chance.console.view()).moving:
            break
    assert chance.console.stops == before + 1, chance.state()
    assert view.condition == "latched" and not view.moving, chance.state()


def check_fit(chance: Chance, cuts: Cuts) -> None:
    """No text is cut that the program itself has put there."""
    assert not (cut := [each for each in cuts.take() if is_word_cut(each)]), (chance.state(), chance.paper.size, cut)


@pytest.mark.parametrize(
    ("machine", "language", "seed", "events"),
    [
        *((machine, language, 1996, EVENTS) for machine, language in zip(MACHINES, ("en", "pl") * 2, strict=True)),
        *(
            pytest.param(machine, language, seed, MANY_EVENTS, marks=LONG)
            for seed, (machine, language) in enumerate(product(MACHINES, words.LANGUAGES))
        ),
    ],
)
def test_random_events_raise_nothing_move_nothing_unasked_and_leave_the_stop_alive(
    machine: str, language: str, seed: int, events: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    at_home(tmp_path, monkeypatch)
    words.use(language)
    with noted() as cuts:
        chance = Chance(seed, machine)
        try:
            for _ in range(events):
                chance.event()
                check_moves(chance)
                check_fit(chance, cuts)
                chance.seen[chance.state()] += 1
                if chance.seen[chance.state()] == 1 or chance.random.random() < 0.005:
                    check_stop(chance)
            tops, screens = {top for top, _screen in chance.seen}, {screen for _top, screen in chance.seen}
            assert {"NoneType", "Dialog", "PullDown"} <= tops and len(screens) >= 3, chance.seen
        finally:
            chance.console.close()
            words.use("en")

"""Stand-ins for the editors' tests: tables and queues in memory, a shell that remembers, a console."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import urwid
from msgspec.structs import replace

from drillctl.language import Message
from drillctl.viewmodel.bench import BenchReport, CyclePath, MotorRun, PathColumn
from drillctl.viewmodel.console import Problems, Watch
from drillctl.viewmodel.signals import SignalView
from drillctl.viewmodel.tables import (
    Checked,
    CommandHelp,
    FieldPath,
    FieldView,
    PhaseRow,
    RampDrawing,
    StateRow,
    TableEntry,
    TableKind,
    TextFinding,
)  # fmt: skip

SIZE = (90, 30)  # no room for a panel


def text_of(widget: urwid.Widget, size: tuple[int, int] = SIZE) -> str:
    return "\n".join(row.decode().rstrip() for row in widget.render(size, focus=True).text)


def attributes_of(widget: urwid.Widget, word: str) -> set[Hashable]:
    """The attributes in which a word stands on the screen."""
    runs = [run for row in widget.render(SIZE, focus=True).content() for run in row]
    return {attribute for attribute, _charset, text in runs if word in text.decode()}


def press(widget: urwid.Widget, *keys: str) -> list[str]:
    """The keys that the widget left to others."""
    left = [widget.keypress(SIZE, key) for key in keys]
    return [key for key in left if key is not None]


@dataclass
class Shell:
    """Answers yes where ``says_yes``; types ``types`` where it is asked for a text; takes line ``picks`` of a list."""

    says_yes: bool = False
    types: str = ""
    picks: int = 0
    told: list[tuple[str, list[str]]] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)
    opened: list[urwid.Widget] = field(default_factory=list)
    offered: list[str] = field(default_factory=list)
    closed: int = 0

    def say(self, text: str) -> None:
        self.told.append(("", [text]))

    def message(self, title: str, lines: Sequence[str]) -> None:
        self.told.append((title, list(lines)))

    def ask(self, question: str, yes: Callable[[], None]) -> None:
        self.asked.append(question)
        if self.says_yes:
            yes()

    def ask_text(self, title: str, prompt: str, text: str, accept: Callable[[str], None]) -> None:
        self.asked.append(prompt)
        accept(self.types)

    def choose(self, title: str, lines: Sequence[str], chosen: Callable[[int], object]) -> None:
        self.offered = [*lines]
        chosen(self.picks)

    def open(self, screen: urwid.Widget) -> None:
        self.opened.append(screen)

    def work(self, work: Callable[[Watch], Problems], then: Callable[[Problems], object]) -> None:
        then(work(lambda what: lambda done, total: None))

    def back(self) -> None:
        self.closed += 1


class Console:
    """Remembers what was run and chosen; refuses where ``refusal`` is set."""

    def __init__(self) -> None:
        self.ran: list[str] = []
        self.chosen: list[str] = []
        self.refusal: Problems = ()
        self.paused = False

    def view(self) -> Any:
        axis = SimpleNamespace(name="x", column=3, state=1, position_steps=7)
        return SimpleNamespace(
            machine="drill",
            at_work=False,
            paused=self.paused,
            tick=41,
            command="KMD_CZEKAJ 5",
            axes=(axis,),
            position_known=True,
            hot_s=0.0,
            cut_off=False,
        )

    def choose_machine(self, name: str) -> Problems:
        self.chosen.append(name)
        return self.refusal

    def run_queue(self, text: str) -> Problems:
        self.ran.append(text)
        return self.refusal


class Hands:
    """A ManualControl over some signals; ``done`` is what was asked, in order. ``port`` names a real one."""

    def __init__(self, console: Console, signals: Sequence[SignalView] = (), port: str = ""):
        self.console, self.shown, self.port = console, list(signals), port
        self.done: list[tuple[object, ...]] = []
        self.refusal: Problems = ()

    def signals(self) -> Sequence[SignalView]:
        return list(self.shown)

    def real_port(self) -> str:
        return self.port

    def set_output(self, bit: int, on: bool) -> Problems:
        if not self.refusal:
            self.shown = [replace(s, level=int(on)) if s.bit == bit and s.kind != "input" else s for s in self.shown]
        return self._keep("set_output", bit, on)

    def press_input(self, bit: int, on: bool) -> Problems:
        if not self.refusal:
            self.shown = [replace(s, held=on) if s.bit == bit and s.kind == "input" else s for s in self.shown]
        return self._keep("press_input", bit, on)

    def run_paused(self, text: str) -> Problems:
        self.console.paused = not self.refusal
        return self._keep("run_paused", text)

    def tick(self, ticks: int) -> Problems:
        return self._keep("tick", ticks)

    def go(self) -> Problems:
        self.console.paused = False
        return self._keep("go")

    def _keep(self, *asked: object) -> Problems:
        self.done.append(asked)
        return self.refusal


class Tables:
    """A TableEditing over one table a kind, its own format: ``name volts pattern [reverse]``, four numbers, or
    ``place value``, a line each. A line with ``bad`` is a problem, a lone ``....`` a warning."""

    def __init__(self, **shipped: str):
        self.shipped: dict[str, str] = dict(shipped)
        self.own: dict[str, str] = {}
        self.in_use = True
        self.rows = self  # its RowEditing too

    def tables(self, kind: TableKind) -> list[TableEntry]:
        return [TableEntry("one", "yours" if kind in self.own else "shipped", in_use=self.in_use)]

    def users(self, kind: TableKind, name: str) -> list[tuple[str, tuple[str, ...]]]:
        return [("drill", ("x", "y"))]

    def effects(self, before: str, after: str) -> list[Message]:
        return [Message("what was typed does something")] if before != after else []

    def read(self, kind: TableKind, name: str) -> str:
        return self.own.get(kind, self.shipped.get(kind, ""))

    def check(self, kind: TableKind, text: str) -> Checked:
        lines = list(enumerate(text.split("\n"), start=1))
        problems = tuple(TextFinding(number, Message("it is bad")) for number, line in lines if "bad" in line)
        return Checked(
            problems, tuple(TextFinding(None, Message("all dark")) for _number, line in lines if "...." in line)
        )

    def save(self, kind: TableKind, name: str, text: str) -> Problems:
        if problems := self.check(kind, text).problems:
            return tuple(problem.message for problem in problems)
        self.own[kind] = text
        return ()

    def reset(self, kind: TableKind, name: str) -> Problems:
        return () if self.own.pop(kind, None) is not None else ("there is no copy of your own",)

    def delete(self, kind: TableKind, name: str) -> Problems:
        return () if self.own.pop(kind, None) is not None else ("it stays",)

    def diff(self, kind: TableKind, name: str, text: str) -> tuple[str, ...]:
        return () if text == self.shipped[kind] else ("-before", "+after")

    def copy(self, kind: TableKind, name: str, new_name: str) -> Problems:
        return ("there is one already",) if new_name == name else ()

    def phase_rows(self, text: str) -> tuple[PhaseRow, ...]:
        rows = (line.split() for line in text.split("\n"))
        return tuple(PhaseRow(row[0], float(row[1]), row[2], *row[3:]) for row in rows)

    def with_phase_rows(self, text: str, rows: Sequence[PhaseRow]) -> str:
        return "\n".join(" ".join([row.name, f"{row.volts:g}", row.pattern, row.reverse or ""]).strip() for row in rows)

    def ramp(self, text: str) -> RampDrawing:
        """Sound while no interval is 0."""
        numbers = [list(map(int, line.split())) for line in text.split("\n")]
        rows = [StateRow(*row) for row in numbers]
        if any(row.interval == 0 for row in rows):
            return RampDrawing(tuple(rows))
        told = (replace(row, stop_steps=abs(row.state), stop_ticks=row.interval) for row in rows)
        return RampDrawing(tuple(told), tuple(row.interval for row in rows))

    def with_state(self, text: str, state: int, name: str, value: int) -> str:
        rows = [line.split() for line in text.split("\n")]
        row = next(row for row in rows if int(row[0]) == state)
        row[("state", "accelerate", "brake", "interval").index(name)] = str(value)
        return "\n".join(map(" ".join, rows))

    def with_top(self, text: str, higher: bool) -> str:
        """A pair of rows more, all like the outermost; or less."""
        rows = [list(map(int, line.split())) for line in text.split("\n")]
        low, high = rows[0], rows[-1]
        rows = [[low[0] - 1, *low[1:]], *rows, [high[0] + 1, *high[1:]]] if higher else rows[1:-1] or rows
        return "\n".join(" ".join(map(str, row)) for row in rows)

    def fields(self, text: str) -> tuple[FieldView, ...]:
        pairs = [line.partition(" ") for line in text.split("\n") if line]
        places: dict[str, tuple[FieldPath, str, tuple[str, ...]]] = {
            "tick_hz": (("tick_hz",), "", ()),
            "mode": (("configuration", "mode"), "", ("REAL", "SIMULATED")),
            "scale": (("axis", 0, "columns_per_inch"), "x", ()),
        }
        return tuple(
            FieldView(places[name][0], places[name][1], value, places[name][2], "1..9999") for name, _, value in pairs
        )

    def wires(self, text: str) -> tuple[FieldView, ...]:
        return ()

    def with_field(self, text: str, place: FieldPath, typed: str) -> tuple[str, Problems]:
        if not typed or not typed.isalnum():
            return text, (f"{typed!r}: not that",)
        fields = self.fields(text)
        names = [line.partition(" ")[0] for line in text.split("\n")]
        values = [typed if told.place == place else told.value for told in fields]
        return "\n".join(f"{name} {value}" for name, value in zip(names, values, strict=True)), ()


class Bench:
    """A motor x, which loses a step for every ``.`` in the first line of a text beyond the second. ``refusal``: why
    nothing is tried. ``tried`` is what was."""

    def __init__(self) -> None:
        self.tried: list[str] = []
        self.refusal: Problems = ()

    def path(self, name: str, text: str) -> CyclePath:
        marks = text.split("\n", maxsplit=1)[0].rsplit(maxsplit=1)[-1]
        columns = tuple(PathColumn(float(place), 1.0 if mark == "x" else 0.0) for place, mark in enumerate(marks, 1))
        return CyclePath("x", True, columns, float(marks.count("x")), len(marks), 100.0)

    def run(self, kind: TableKind, name: str, text: str, watch: Watch) -> tuple[BenchReport | None, Problems]:
        self.tried.append(text)
        if self.refusal:
            return None, self.refusal
        lost = max(text.split("\n", maxsplit=1)[0].count(".") - 2, 0)
        return BenchReport(500, True, (MotorRun("x", True, 2, lost, 30, (0.0, 0.5, float(lost))),)), ()

    def carried_hz(self, tick_hz: int, watch: Watch) -> tuple[int | None, Problems]:
        return (None, self.refusal) if self.refusal else (2 * tick_hz, ())


class Queues:
    """A QueueEditing: a line that begins with KMD_ is right; files are a dictionary."""

    def __init__(self) -> None:
        self.files: dict[str, str] = {}

    def commands(self) -> list[CommandHelp]:
        return [
            CommandHelp("KMD_CZEKAJ", "ticks", "wait"),
            CommandHelp("KMD_RUCH", "axis=steps", "move"),
            CommandHelp("KMD_RUCHd", "axis=steps", "move from here"),
        ]

    def words(self) -> list[str]:
        return ["x", "y", "spindle"]

    def check_queue(self, text: str) -> tuple[TextFinding, ...]:
        lines = enumerate(text.split("\n"), start=1)
        return tuple(
            TextFinding(n, Message("unknown command"), 1) for n, line in lines if line and not line.startswith("KMD_")
        )

    def too_far(self, text: str) -> tuple[TextFinding, ...]:
        return tuple(
            TextFinding(n, Message("too far")) for n, line in enumerate(text.split("\n"), start=1) if "9999" in line
        )

    def open_queue(self, file: str) -> tuple[str, Problems]:
        return (self.files[file], ()) if file in self.files else ("", (f"{file}: can't be read",))

    def save_queue(self, file: str, text: str) -> Problems:
        self.files[file] = text
        return ()

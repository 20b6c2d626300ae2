"""Writes the pages of docs/ that tables, docstrings and the command line's parser already say. A test compares."""

import argparse
import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from drillctl import __version__
from drillctl.api import PUBLIC, load
from drillctl.cli import DESCRIPTION, EPILOG, parser
from drillctl.cli.parsing import Parser
from drillctl.execution.conditions import TABLE, Event
from drillctl.execution.controller import CONDITIONS, Stage
from drillctl.generation.boiler_drum.gears import GEARS_MM_MIN, LETTERS, MM_PER_M, GearRow, gear_rows
from drillctl.kmd import COMMANDS, FAULTS, Reaction
from drillctl.kmd.commands import Spec
from drillctl.machine import Library, shipped_tables
from drillctl.machine.reactions import FIXED, NO_RETURN, NOT_KEPT
from drillctl.viewmodel.fault_texts import FAULT_WORDS

ROW = "| {} | `{}` | {} |"
DOCS = Path(__file__).resolve().parent
MADE = "<!-- made by docs/generate.py from {}; do not edit -->"
INTRO = """
Every operation of a machine is a queue of these elementary commands. `axis=steps ...` is one or more of the machine's
axes; distances are steps, times are ticks. `KMD_GOTOdXdY`, `KMD_GOTO_X_Y` and `KMD_WIERTLO_DOL` are the paper's; the
others are in its style. Names are Polish: *wiertło* drill, *dół* down, *góra* up, *baza* base, *ruch* motion, *linia*
line, *prędkość* speed, *czekaj* wait, *wyjście* output, *wejście* input, *wrzeciono* spindle, *narzędzie* tool, *fazy
wyłączone* phases off, *koniec* end, *powrót* return,
*krok* step, *dom* home, *suw* stroke. `axis=ticks` gives a head its own feed: the least ticks
between its steps.
"""
STATES_INTRO = """
What execution does on each event at each stage of a controller. The page is the table `TABLE` in
`drillctl/execution/conditions.py`, whose first lines explain stages and events; in brackets stands the condition that
the status record shows. An empty cell changes nothing. A cell names what is done, and the next stage if it
is another.
"""
GEARS_INTRO = """
The sixteen gears of `boiler-drum`: preferred numbers R10, as the paper gives no figures. A gear is the slowest allowed
interval of a move. *Ticks*: whole ticks between steps; *error*: of the speed that they give. *Ramp*: travel from rest
until the gear is reached; *peak*: the most by which the speed grows from one interval to the next, over the time of the
former.
"""
REACTIONS = {
    Reaction.STOP: "brakes down the ramp and stops",
    Reaction.DROP: "outputs safe in the same tick",
    Reaction.STOP_AND_RETURN: "brakes, head up, home by the sensors",
    Reaction.MACHINE: "as the machine's file says: outputs safe at once (`drop`), pulses stopped and current held "
    "(`hold`), or down the ramps (`brake`)",
}


def commands_page() -> str:
    rows = [ROW.format(spec.op.value, _usage(spec), spec.meaning) for spec in COMMANDS.values()]
    intro = INTRO.strip()
    table = ["| opcode | command | what it does |", "|---|---|---|", *rows]
    return "\n".join([MADE.format("drillctl/kmd/commands.py"), "", "# Commands", "", intro, "", *table, ""])


def _usage(spec: Spec) -> str:
    return f"{spec.name} {spec.usage}".strip().replace("|", "\\|")


def faults_page() -> str:
    parts = [MADE.format("drillctl/kmd/faults.py and drillctl/viewmodel/fault_texts.py"), "", "# Faults", ""]
    parts += [
        "A fault stops the job, empties the queue, and stays until it is acknowledged.",
        "*Position kept* holds where the position was known. A machine's file may set another reaction",
        "(`brake`, `hold`, `drop`, `return`) and keep the position or not ([TABLES.md](TABLES.md)), but",
        "for what is refused below.",
        "",
    ]
    for spec in FAULTS.values():
        words = FAULT_WORDS[spec.fault]
        kept = "kept" if spec.position_kept else "lost"
        if spec.reaction is Reaction.MACHINE:
            kept = "lost where the outputs drop; where they hold, kept from states 0 and 1; where they brake, kept"
        parts += [
            f"## {spec.fault.value} {spec.fault.name}",
            "",
            f"- Cause: {words.cause}.",
            f"- Remedy: {words.remedy}.",
            f"- Reaction: {REACTIONS[spec.reaction]}. Position {kept}.",
            *_bounds(spec.fault.name),
            "",
        ]
    return "\n".join(parts)


def _bounds(name: str) -> list[str]:
    """What a machine's file can't set of a fault."""
    found = [
        ("Another reaction is refused", FIXED.get(name)),
        ("A position that is kept is refused", NOT_KEPT.get(name)),
        ("`return` is refused", NO_RETURN.get(name)),
    ]
    return [f"- {what}: {why}." for what, why in found if why]


def states_page() -> str:
    stages = [f"{stage.name}<br>({CONDITIONS[stage].name})" for stage in Stage]
    rows = [[event.name, *(_cell(stage, event) for stage in Stage)] for event in Event]
    actions = {action.__name__: action for _, action in TABLE.values()}
    parts = [MADE.format("drillctl/execution/conditions.py"), "", "# States", "", STATES_INTRO.strip(), ""]
    parts += ["```mermaid", "stateDiagram-v2", "    [*] --> IDLE", *_arrows(), "```", "", "## The table", ""]
    parts += ["| event | " + " | ".join(stages) + " |", "|---" * (1 + len(stages)) + "|"]
    parts += ["| " + " | ".join(row) + " |" for row in rows]
    parts += ["", "## The actions", "", "| action | what it does |", "|---|---|"]
    parts += [f"| `{_plain(name)}` | {_first_paragraph(action.__doc__)} |" for name, action in sorted(actions.items())]
    return "\n".join([*parts, ""])


def _arrows() -> list[str]:
    """The transitions to another stage, the events between the same two joined."""
    events: dict[tuple[int, Stage], list[str]] = {}
    for (stage, event), (following, _) in TABLE.items():
        if following != stage:
            events.setdefault((stage, following), []).append(Event(event).name)
    return [f"    {Stage(stage).name} --> {to.name}: {', '.join(names)}" for (stage, to), names in events.items()]


def _cell(stage: Stage, event: Event) -> str:
    if (stage, event) not in TABLE:
        return ""
    following, action = TABLE[stage, event]
    return f"`{_plain(action.__name__)}`" + (f"<br>→ {following.name}" if following != stage else "")


def _plain(name: str) -> str:
    return name.lstrip("_")


def _first_paragraph(text: str | None) -> str:
    return " ".join((text or "").strip().split("\n\n")[0].split())


def gears_page() -> str:
    machine = Library((shipped_tables(),)).machine("boiler-drum")
    parts = [MADE.format("drillctl/generation/boiler_drum/gears.py and tables/machines/boiler-drum.toml"), ""]
    parts += ["# Gears", "", GEARS_INTRO.strip(), f"At {machine.tick_hz} ticks a second:", ""]
    for axis in machine.axes:
        parts += [f"## Axis {axis.name}", ""]
        parts += ["| gear | m/min | steps/s | ticks | error | ramp, mm | peak, m/s2 |", "|---|---|---|---|---|---|---|"]
        parts += [_gear(row) for row in gear_rows(axis, machine)] + [""]
    return "\n".join(parts)


def _gear(row: GearRow) -> str:
    speed = f"{GEARS_MM_MIN[row.gear] / MM_PER_M:g}"
    cells = (LETTERS[row.gear], speed, f"{row.hz:.1f}", row.ticks, f"{row.error:+.2%}", f"{row.ramp_mm:.2f}")
    return f"| {' | '.join(map(str, cells))} | {row.peak_m_s2:.2f} |"


API_INTRO = """
A script, a notebook or a test drives and simulates machines by these names of `import drillctl`, which alone is
public. The import itself costs nothing: each name is loaded when it is first used. Arrays are numpy's; a tick is a
row. What a caller got wrong is raised as `drillctl.Refused`, whose text says what and where.

Lost steps against the tick rate, drawn by matplotlib:

```python
import drillctl
import matplotlib.pyplot as plt

rates = range(300, 1000, 50)
lost = []
for hz in rates:
    run = drillctl.run("KMD_GOTOdXdY 600 0", plant="dynamic", tick_hz=hz)
    lost.append(abs(run.lost_steps["x"]))
plt.plot(rates, lost, "o-")
plt.xlabel("interrupt frequency, Hz")
plt.ylabel("lost steps")
plt.savefig("lost.png")
```

In pytest the same functions are in the fixture `drill`, which every test of a repository has where drillctl is
installed (its type: `drillctl.api.fixture.Drill`); files are looked for beside the test, and two runs that are
compared are told apart by the first tick that differs:

```python
def test_the_head_comes_up_again(drill):
    run = drill.run("hole.kmd", plant="dynamic")
    assert run.fault is None
    assert run.positions("z")[-1] <= 0  # at its upper sensor, or braked a few steps above it
    assert not any(run.lost_steps.values())
    assert run == drill.run("hole.kmd", plant="dynamic")
```
"""


def api_page() -> str:
    parts = [MADE.format("the docstrings of drillctl/api"), "", "# Python", "", API_INTRO.strip(), ""]
    for name in PUBLIC:
        found = load(name)
        parts += [f"## {name}", "", *_documented(found)]
        members = vars(found).items() if isinstance(found, type) and found.__module__.endswith(".result") else ()
        for member, value in members:
            if not member.startswith("_") and (told := inspect.getdoc(value)) and not isinstance(value, type):
                parts += [f"### Run.{member}", "", *_documented(getattr(value, "fget", value), told)]
    return "\n".join(parts)


def _documented(found: Any, told: str = "") -> list[str]:
    text = told or inspect.getdoc(found) or ""
    head = [] if isinstance(found, type) or not callable(found) else [f"{found.__name__}{_signature(found)}", ""]
    return ["```text", *head, *text.splitlines(), "```", ""]


def _signature(found: Any) -> str:
    """As it is called, a parameter a line; types stand in the source."""
    names = [str(each.replace(annotation=each.empty)) for each in inspect.signature(found).parameters.values()]
    return f"({', '.join(name for name in names if name != 'self')})"


def man_page() -> str:
    """roff of the whole command line, from its parser (man(7))."""
    top = parser()
    lines = [f'.TH DRILLCTL 1 "" "drillctl {__version__}" "User Commands"', ".SH NAME"]
    lines += [f"drillctl \\- {_roff(DESCRIPTION[:1].lower() + DESCRIPTION[1:].rstrip('.'))}"]
    lines += [".SH SYNOPSIS", ".B drillctl", "[VERB] [OPTION]...", ".SH VERBS"]
    for name, verb in top.verbs().items():
        for inner_name, inner in (verb.verbs() or {"": verb}).items():
            lines += [f'.SS "drillctl {name}{inner_name and " "}{inner_name}"', _roff(inner.description or "")]
            lines += _options(inner)
    lines += [".SH EXIT STATUS", _roff(EPILOG.removeprefix("exit: "))]
    lines += [".SH FILES", "drillctl where prints the folders in use.", ""]
    return "\n".join(lines)


def _options(verb: Parser) -> list[str]:
    return [line for option, told in _told_options(verb) for line in (".TP", f".B {_roff(option)}", _roff(told))]


def verbs_page() -> str:
    """The command line as a page, from its parser."""
    intro = f"{DESCRIPTION} {EPILOG[:1].upper()}{EPILOG[1:]}."
    parts = [MADE.format("the command line's parser"), "", "# Verbs", "", intro, ""]
    for name, verb in parser().verbs().items():
        for inner_name, inner in (verb.verbs() or {"": verb}).items():
            parts += [f"## drillctl {name}{inner_name and ' '}{inner_name}", "", _one_paragraph(inner.description), ""]
            rows = [f"| `{_cell_text(option)}` | {_cell_text(told)} |" for option, told in _told_options(inner)]
            parts += ["| | |", "|---|---|", *rows, ""] if rows else []
            parts += ["```text", *inner.examples, "```", ""] if inner.examples else []
    return "\n".join(parts)


def _cell_text(text: str) -> str:
    return _one_paragraph(text).replace("|", "\\|")


def _one_paragraph(text: str | None) -> str:
    return " ".join((text or "").replace("``", "`").split())


def _told_options(verb: Parser) -> Iterator[tuple[str, str]]:
    """Each option that help shows, with its value, and what is said of it."""
    for action in verb._actions:
        if action.help and action.help != "==SUPPRESS==" and "help" not in action.dest:
            name = ", ".join(action.option_strings) or str(action.metavar or action.dest)
            value = f" {_value(action)}" if action.option_strings and action.nargs != 0 else ""
            told = action.help % {"default": action.default, "prog": "drillctl"}
            yield name + value, told


def _value(action: argparse.Action) -> str:
    choices = f"{{{','.join(map(str, action.choices))}}}" if action.choices else ""
    return str(action.metavar or choices or action.dest.upper())


def _roff(text: str) -> str:
    """Without the marks of docstrings; what begins a request, a backslash and a minus are escaped."""
    words = " ".join(text.replace("``", "").split()).replace("\\", "\\e").replace("-", "\\-")
    return f"\\&{words}" if words[:1] in (".", "'") else words


PAGES = {
    "drillctl.1": man_page,
    "VERBS.md": verbs_page,
    "KMD.md": commands_page,
    "FAULTS.md": faults_page,
    "STATES.md": states_page,
    "GEARS.md": gears_page,
    "API.md": api_page,
}

if __name__ == "__main__":
    for name, page in PAGES.items():
        (DOCS / name).write_text(page(), "utf-8")

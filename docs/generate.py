"""Writes docs/KMD.md and docs/FAULTS.md from the tables in the code. A test holds that they are up to date."""

from pathlib import Path

from drillctl.kmd import COMMANDS, FAULTS, Reaction
from drillctl.kmd.commands import Spec
from drillctl.viewmodel import FAULT_WORDS

ROW = "| {} | `{}` | {} |"
DOCS = Path(__file__).resolve().parent
MADE = "<!-- made by docs/generate.py from {}; do not edit -->"
INTRO = """
Every operation of a machine is a queue of these elementary commands. `axis=steps ...` is one or more of the machine's
axes; distances are steps, times are ticks. `KMD_GOTOdXdY`, `KMD_GOTO_X_Y` and `KMD_WIERTLO_DOL` are the paper's; the
others are in its style. Names are Polish: *wiertło* drill, *dół* down, *góra* up, *baza* base, *ruch* motion, *linia*
line, *prędkość* speed, *czekaj* wait, *wyjście* output, *wejście* input, *wrzeciono* spindle, *narzędzie* tool, *fazy
wyłączone* phases off, *koniec* end.
"""
REACTIONS = {
    Reaction.STOP: "brakes down the ramp and stops",
    Reaction.DROP: "outputs safe in the same tick",
    Reaction.STOP_AND_RETURN: "brakes, head up, home by the sensors",
    Reaction.MACHINE: "as the machine's file says: outputs safe at once, or pulses stopped and current held",
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
        "*Position kept* holds where the position was known.",
        "",
    ]
    for spec in FAULTS.values():
        words = FAULT_WORDS[spec.fault]
        kept = "kept" if spec.position_kept else "lost"
        if spec.reaction is Reaction.MACHINE:
            kept = "lost where the outputs drop; where they hold, kept from states 0 and 1"
        parts += [
            f"## {spec.fault.value} {spec.fault.name}",
            "",
            f"- Cause: {words.cause}.",
            f"- Remedy: {words.remedy}.",
            f"- Reaction: {REACTIONS[spec.reaction]}. Position {kept}.",
            "",
        ]
    return "\n".join(parts)


PAGES = {"KMD.md": commands_page, "FAULTS.md": faults_page}

if __name__ == "__main__":
    for name, page in PAGES.items():
        (DOCS / name).write_text(page(), "utf-8")

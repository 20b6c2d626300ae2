"""A ramp's outermost pair of states added or taken away in its text, comments and layout kept: text in, text out.

Rule: as edit.py has it: what the result means is the readers' business. Called by the workbench for the ramp editor.
"""

import tomlkit
from tomlkit.items import AoT, Table

from drillctl.machine.edit import opened


def with_states(text: str, state: int, accelerate: int, brake: int, interval: int) -> str:
    """With a row of this state above the others, and its mirror image below. Raises TableError for a text not TOML."""
    document = opened(text)
    rows = document["state"]
    assert isinstance(rows, AoT)
    below, above = (_row(sign * state, sign * accelerate, sign * brake, interval) for sign in (-1, 1))
    below.add(tomlkit.nl())  # empty lines stand between the rows
    above.trivia.indent = "\n"
    rows.insert(0, below)
    rows.append(above)
    return tomlkit.dumps(document)


def _row(state: int, accelerate: int, brake: int, interval: int) -> Table:
    row = tomlkit.table()
    row.update({"state": state, "accelerate": accelerate, "brake": brake, "interval": interval})
    return row


def without_states(text: str, state: int) -> str:
    """Without the rows of this state and of its mirror image. Raises TableError for a text not TOML."""
    document = opened(text)
    rows = document["state"]
    for index in reversed(range(len(rows))):
        if abs(rows[index]["state"]) == state:
            del rows[index]
    return tomlkit.dumps(document).rstrip() + "\n"  # without the empty line that stood above the last row

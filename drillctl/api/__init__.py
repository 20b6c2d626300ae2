"""What another Python program uses: ``import drillctl`` has each name of PUBLIC, and loads it when it is first used.

    load_machine, machine_names  a machine by name or file, with changes made in memory
    job                          what is run: a drill file, a queue, or commands in a list
    run -> Run                   the run as arrays: ticks, wires, columns, positions, states, currents, lag, holes
    estimate, inspect            how long a job takes; what a drill file holds
    replay_trace                 a recorded run once more, compared
    sweep                        many variants of an axis, a row each
    Refused                      the error of every function here: what was wrong, where, in one sentence

Rule: plain functions over the rooms below; nothing is computed here. docs/API.md is made from these docstrings.
"""

from importlib import import_module
from typing import Any

PUBLIC = {
    "load_machine": "machines",
    "machine_names": "machines",
    "job": "jobs",
    "run": "runs",
    "Run": "result",
    "estimate": "jobs",
    "inspect": "jobs",
    "replay_trace": "jobs",
    "sweep": "sweeps",
    "Refused": "errors",
}


def load(name: str) -> Any:
    """Returns a public name's function or class; its module is imported by this. Raises AttributeError for others."""
    if name not in PUBLIC:
        raise AttributeError(f"module 'drillctl' has no attribute {name!r}")
    return getattr(import_module(f"drillctl.api.{PUBLIC[name]}"), name)

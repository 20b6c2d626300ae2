"""Journals with a few things changed and every line sealed anew: what stands behind the checksum is reached.

Rule: as in fuzz_makers.py. Used by fuzz_readers.py.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from benchmarks.fuzz_makers import Material, Random, text_input
from drillctl.jobs.journal.chain import NO_SEAL, sealed

Line = dict[str, Any]
SEAL = "chain"
BARE_SHARE = 0.1  # of all inputs are changed as text, their checksums left as they were
VALUES: tuple[Any, ...] = (
    None, True, False, -1, 0, 1, 2, 3, 26, 27, 2**31 - 1, 2**31, 2**63, 2**64, -(2**63) - 1, 10**4000, 0.5, 1e308,
    float("nan"), float("inf"), "", "done", "stopped", "x" * 5000, "\x1b[2J\u202e", "\ud800", "a\nb", "\0", [], [1, 2],
    [[1]] * 50, {}, {"port": 1}, {"begun": 1},
)  # fmt: skip
DEEP = "[" * 400 + "]" * 400


def resealed_input(rng: Random, material: Material) -> bytes:
    """A seed with one to four changes to what its lines say, each line sealed behind the one before it."""
    if rng.random() < BARE_SHARE:
        return text_input(rng, material)
    lines = [json.loads(line) for line in rng.choice(material.seeds).splitlines()]
    for line in lines:
        del line[SEAL]
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        rng.choice(CHANGES)(lines, rng)
    found, seal = [], NO_SEAL
    for line in lines:
        data, seal = sealed(line, seal)
        found.append(data)
    return b"".join(found)[: rng.choice((None, None, None, -1, -20))]


def _other_value(lines: list[Line], rng: Random) -> None:
    """A value somewhere within a line, however deep it lies."""
    here, key = _place(lines, rng)
    if here is not None:
        here[key] = json.loads(DEEP) if rng.random() < 0.03 else rng.choice(VALUES)


def _other_name(lines: list[Line], rng: Random) -> None:
    here, key = _place(lines, rng)
    if isinstance(here, dict):
        here[rng.choice(("begun", "done", "ended", "resumed", "again", "", "x" * 300, "\x1b"))] = here.pop(key)


def _without_name(lines: list[Line], rng: Random) -> None:
    here, key = _place(lines, rng)
    if here is not None:
        del here[key]


def _further_name(lines: list[Line], rng: Random) -> None:
    here, _ = _place(lines, rng)
    if isinstance(here, dict):
        here[rng.choice(("again", "options", "machine", "x"))] = rng.choice(VALUES)


def _further_line(lines: list[Line], rng: Random) -> None:
    kind = rng.choice((("begun",), ("done",), ("ended",), ("resumed", "again")))
    made = {name: rng.choice(VALUES) for name in kind}
    if "resumed" in made and lines and rng.random() < 0.7:
        made["resumed"] = lines[0].get("site")
    lines.insert(rng.randrange(len(lines) + 1), made)


def _other_order(lines: list[Line], rng: Random) -> None:
    """A line left out, doubled, or moved."""
    if lines:
        line = lines.pop(rng.randrange(len(lines)))
        for _ in range(rng.randrange(3)):
            lines.insert(rng.randrange(len(lines) + 1), json.loads(json.dumps(line)))


def _place(lines: list[Line], rng: Random) -> tuple[Any, Any]:
    """A dictionary or list somewhere within a line, and a key of it; None where there is no such thing."""
    here, key = None, None
    inner: Any = rng.choice(lines) if lines else None
    while isinstance(inner, dict | list) and inner and (here is None or rng.random() < 0.7):
        here, key = inner, rng.choice(list(inner) if isinstance(inner, dict) else range(len(inner)))
        inner = inner[key]
    return here, key


CHANGES: tuple[Callable[[list[Line], Random], None], ...] = (
    _other_value, _other_value, _other_value, _other_name, _without_name, _further_name, _further_line, _further_line,
    _other_order,
)  # fmt: skip

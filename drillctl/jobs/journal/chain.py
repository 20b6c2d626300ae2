"""A journal's lines as bytes: one JSON object each, whose last key ``chain`` is a checksum over the line and the
checksum of the line before it.

Rule: a line that was altered, removed, doubled or moved breaks the chain there, and nothing behind it is believed. The
checksum guards against accidents, not against somebody who means to forge a journal.
"""

import hashlib
import json
import re
from collections.abc import Mapping
from typing import Any

from drillctl.files.inputs import json_of
from drillctl.language import Refusal

SEAL_DIGITS = 16
NO_SEAL = ""  # before the first line
SEALED = re.compile(rb'(\{.+), "chain": "([0-9a-f]{%d})"\}' % SEAL_DIGITS, re.DOTALL)


class JournalError(Refusal):
    """A journal that can't be read, written or believed. ``str()`` is ``FILE:LINE: reason`` or ``FILE: reason``."""

    kind = "journal"


class Damaged(Refusal):
    """Raised for bytes that are no line of this chain."""


def sealed(line: Mapping[str, Any], before: str) -> tuple[bytes, str]:
    """A line as bytes for the file, newline included, and its seal; ``before`` is the seal of the line before it."""
    body = json.dumps(line).encode().removesuffix(b"}")
    seal = _seal(body, before)
    return body + f', "chain": "{seal}"}}\n'.encode(), seal


def unsealed(data: bytes, before: str) -> tuple[dict[str, Any], str]:
    """Reads a line of the file, without its newline: its keys and values, and its seal. Raises Damaged."""
    found = SEALED.fullmatch(data)
    if found is None or found[2].decode() != _seal(found[1], before):
        raise Damaged
    try:
        line = json_of(found[1] + b"}")
    except ValueError as error:
        raise Damaged from error
    if not isinstance(line, dict):
        raise Damaged
    return line, found[2].decode()


def _seal(body: bytes, before: str) -> str:
    return hashlib.sha256(before.encode() + b"\n" + body).hexdigest()[:SEAL_DIGITS]

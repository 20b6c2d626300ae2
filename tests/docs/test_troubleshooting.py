"""What TROUBLESHOOTING.md quotes is what the program says: each message stands in its code, each fault is one.

So are the messages that a tutorial or how-to lists, a point each: ``- `message`: what to do``.
"""

import ast
import re
from pathlib import Path

from drillctl.kmd import Fault

ROOT = Path(__file__).resolve().parents[2]
ROWS = [
    row.strip("|").split(" | ")
    for row in (ROOT / "docs" / "TROUBLESHOOTING.md").read_text("utf-8").splitlines()
    if row.startswith("| ") and not row.startswith("| you ")
]
OTHER_PAGES = [page for folder in ("tutorials", "howto") for page in sorted((ROOT / "docs" / folder).glob("*.md"))]
GAP = "…"
NOT_OURS = {"drillctl: command not found"}


def texts() -> list[str]:
    """Every string of the program's code, its fields as gaps."""
    found = []
    for file in sorted((ROOT / "drillctl").rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.JoinedStr):
                parts = (part.value if isinstance(part, ast.Constant) else GAP for part in node.values)
                found.append("".join(map(str, parts)))
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.append(re.sub(r"\{.*?\}", GAP, node.value))
    return found


def messages() -> list[str]:
    listed = [found for page in OTHER_PAGES for found in re.findall(r"^- `([^`]+)`: ", page.read_text("utf-8"), re.M)]
    quoted = [message for row in ROWS for message in re.findall(r"`([^`]+)`", row[0])]
    assert listed
    return [message for message in (*quoted, *listed) if message not in NOT_OURS]


def test_each_quoted_message_is_one_of_the_program() -> None:
    quoted, known = messages(), texts()
    assert len(quoted) > 35
    patterns = {message: re.compile(".*".join(map(re.escape, message.split(GAP)))) for message in quoted}
    missing = [message for message, pattern in patterns.items() if not any(pattern.search(text) for text in known)]
    assert missing == []


def test_each_named_fault_is_one_and_each_row_says_what_to_do() -> None:
    named = {name for row in ROWS for name in re.findall(r"\b[A-Z]+_[A-Z_]+\b|^ ?LIMIT\b", row[0])}
    named = {name.strip() for name in named}
    assert len(named) > 7 and named <= {fault.name for fault in Fault}
    assert all(len(row) == 3 and all(cell.strip() for cell in row) for row in ROWS)

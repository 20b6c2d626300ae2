"""Tutorials and how-tos are done as they stand: a page's shell blocks in one shell, in an empty folder, by a new user.

Above a block may stand, as a comment of Markdown:

    <!-- not run: REASON -->     it is left out
    <!-- exits with N -->        its last command does

A block of text below it quotes what it prints: each line begins a line of the output, or is part of one.
"""

import os
import re
import subprocess
import sys
from pathlib import Path
from textwrap import dedent
from typing import NamedTuple

import pytest
from _pytest.mark import ParameterSet

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = sorted([*DOCS.glob("tutorials/*.md"), *DOCS.glob("howto/*.md"), DOCS / "OWN-MACHINE.md"])
FENCE = re.compile(r"^ *(?:<!-- (?P<mark>.*?) -->\n\s*)?```(?P<kind>\w*)\n(?P<text>.*?)^ *```$", re.M | re.S)
MARK = re.compile(r"not run: \w.{9,}|exits with (\d+)")
NEXT = "@@ next block"


class Block(NamedTuple):
    """A shell block: its commands, the exit code of the last, and the lines that the page says it prints."""

    commands: str
    code: int
    printed: list[str]


def blocks(page: Path) -> list[Block]:
    found: list[Block] = []
    for fence in FENCE.finditer(page.read_text("utf-8")):
        text, mark = dedent(fence["text"]), fence["mark"] or ""
        if fence["kind"] == "text" and found:
            found[-1].printed.extend(line for line in text.splitlines() if line.strip())
        elif fence["kind"] == "sh":
            marked = MARK.fullmatch(mark)
            assert marked or not mark, f"{page.name}: {mark}"
            left_out = marked is not None and marked[1] is None
            found.append(Block("" if left_out else text, int(marked[1]) if marked and marked[1] else 0, []))
    return found


def script(found: list[Block]) -> str:
    """All blocks for one bash, which ends where an exit code is not the one that the page has."""
    lines = ["set -e"]
    for block in found:
        lines += [f"echo '{NEXT}'", "set +e" if block.code else "", block.commands]
        lines += [f"[ $? = {block.code} ] || exit 99", "set -e"] if block.code else []
    return "\n".join([*lines, f"echo '{NEXT}'"])


@pytest.fixture
def new_user(tmp_path: Path) -> dict[str, str]:
    """The surroundings of a user's shell in a clone that was set up; ``pip`` there has nothing left to do."""
    (tmp_path / "home").mkdir()
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "pip").write_text("#!/bin/sh\n")
    (tmp_path / "bin" / "pip").chmod(0o755)
    path = os.pathsep.join((str(tmp_path / "bin"), str(Path(sys.executable).parent), os.environ["PATH"]))
    only_ours = {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_ADDOPTS": "-p no:cacheprovider -p drillctl"}  # quicker
    return {"PATH": path, "HOME": str(tmp_path / "home"), "LANG": "C.UTF-8", **only_ours}


def with_marks(page: Path) -> ParameterSet:
    """Marked ``paced`` where it has a run by the clock."""
    return pytest.param(page, marks=[pytest.mark.paced] if "--pace real" in page.read_text("utf-8") else [])


@pytest.mark.timeout(310)
@pytest.mark.parametrize("page", [with_marks(page) for page in PAGES], ids=lambda page: page.stem)
def test_a_page_can_be_done_as_it_stands(page: Path, new_user: dict[str, str], tmp_path: Path) -> None:
    found = blocks(page)
    assert found, "a page without a command"
    (tmp_path / "work").mkdir()
    for name in ("examples", "tables"):  # as in a clone
        if "Set up first" not in page.read_text("utf-8") and page.parent == DOCS:
            (tmp_path / "work" / name).symlink_to(ROOT / name)
    done = subprocess.run(
        ["bash", "-c", script(found)], cwd=tmp_path / "work", env=new_user, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, check=False,
    )  # fmt: skip
    outputs = done.stdout.split(NEXT)[1:]
    assert done.returncode == 0, f"block {len(outputs)} of {page.name}: {outputs[-1][-2000:]}"
    for block, output in zip(found, outputs, strict=False):
        missing = [line for line in block.printed if line.strip() not in output]
        assert not missing, f"{page.name}: {missing} is not in what it prints: {output[-2000:]}"


def test_what_is_not_run_is_little_and_has_a_reason() -> None:
    found = [block for page in PAGES for block in blocks(page)]
    assert len(found) > 30
    assert sum(not block.commands for block in found) < 6

"""Docs are executed: README's commands run, the generated pages are current, every link leads somewhere."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.ui.pcb_drill.menus import MENUS
from tests.support.scripts import script

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text("utf-8")
FOLDERS = ("docs/*.md", "docs/lab/*.md", "docs/tutorials/*.md", "docs/howto/*.md", "*.md")
PAGES = [page for pattern in FOLDERS for page in sorted(ROOT.glob(pattern))]


def drillctl_lines() -> list[list[str]]:
    blocks = re.findall(r"```sh\n(.*?)```", README, re.S)
    lines = [part.strip() for block in blocks for line in block.splitlines() for part in line.split("&&")]
    return [shlex.split(line, comments=True) for line in lines if line.startswith(".venv/bin/drillctl")]


@pytest.mark.parametrize("name", ["KMD.md", "FAULTS.md", "STATES.md", "GEARS.md", "API.md", "VERBS.md", "drillctl.1"])
def test_generated_page_is_current(name: str) -> None:
    assert (ROOT / "docs" / name).read_text("utf-8") == script("docs/generate.py").PAGES[name]()


def test_readme_commands_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    (tmp_path / "tables").symlink_to(ROOT / "tables")
    commands = drillctl_lines()
    assert len(commands) >= 7
    monkeypatch.chdir(tmp_path)
    for command in commands:
        assert main(command[1:]) == 0, f"{command}: {capsys.readouterr().err}"


def test_every_menu_path_of_the_readme_is_in_the_menus() -> None:
    labels = {item.label.replace("&", "").removesuffix("..."): item for item in MENUS}
    table = README.partition("## On the screen")[2].partition("\n## ")[0]
    paths = re.findall(r"([A-Z][a-z]+) > ([A-Z][\w ]+?(?:, drill up)?)(?=[,;|)]| \||$)", table)
    assert len(paths) > 20
    for first, entry in paths:
        entries = [item.label.replace("&", "").removesuffix("...") for item in labels[first].items]
        assert entry.strip() in entries, f"README: {first} > {entry}"


def test_readme_shows_what_the_example_prints() -> None:
    call = [sys.executable, "-m", "drillctl", "run", "examples/blinker.drl"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.strip() in README


def test_ci_runs_the_readme_test_command() -> None:
    ci = (ROOT / ".ci" / "run").read_text("utf-8")
    command = next(line for line in README.splitlines() if line.endswith("-m pytest"))
    assert command in ci.splitlines()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\((?!https?://)([^)\s]+)\)", page.read_text("utf-8")):
        name, _, anchor = target.partition("#")
        aim = page.parent / name if name else page
        assert aim.exists(), f"{page.name} links to {target}"
        assert not anchor or anchor in anchors(aim), f"{page.name} links to {target}"


def anchors(page: Path) -> set[str]:
    """Of a page's headings, as forges and docs/conf.py make them."""
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.S | re.M)
    headings = re.findall(r"^#+ (.+)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-") for heading in headings}


def sources() -> str:
    return "\n".join(file.read_text("utf-8") for file in sorted((ROOT / "drillctl").rglob("*.py")))


def glossary_rows() -> list[list[str]]:
    terms, _, _not_used = (ROOT / "docs" / "GLOSSARY.md").read_text("utf-8").partition("## Words that are not used")
    lines = [line for line in terms.splitlines() if line.startswith("| ")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [row for row in rows if row[0] != "term"]


def test_every_name_of_the_glossary_is_in_the_code() -> None:
    words = set(re.findall(r"\w+", sources()))
    rows = glossary_rows()
    assert len(rows) > 80 and all(len(row) == 4 and all(row) for row in rows)
    names = {name for row in rows for name in re.findall(r"`(\w+)`", row[3])}
    assert sorted(names - words) == []
    assert all(re.search(r"`\w+`", row[3]) for row in rows), "a term without a name in code"


def test_no_term_of_the_glossary_stands_twice() -> None:
    terms = [term.strip() for row in glossary_rows() for term in row[0].split(",")]
    assert sorted(terms) == sorted(set(terms))


def places_named(page: str) -> set[tuple[str, str]]:
    """Modules that a page names in backticks, with the name behind each: ``execution/axis.py: Axis.hold``."""
    text = (ROOT / "docs" / page).read_text("utf-8")
    return set(re.findall(r"`(?:drillctl/)?((?:[a-z_0-9]+/)*[a-z_0-9]+\.py)(?:: ([\w.]+))?`", text))


@pytest.mark.parametrize("page", ["ARCHITECTURE.md", "CHANGING.md"])
def test_modules_and_names_that_a_page_points_at_exist(page: str) -> None:
    places = places_named(page)
    assert len(places) > 30
    missing = []
    for module, name in places:
        beside = [file for file in [ROOT / "drillctl" / module, ROOT / module] if file.is_file()]
        if not beside and "/" not in module:  # `heads.py` beside a module that is named in full
            beside = sorted((ROOT / "drillctl").rglob(module))
        text = beside[0].read_text("utf-8") if beside else ""
        defined = set(re.findall(r"(?:def|class) (\w+)|^(\w+)\s*(?::[^=\n]+)?=", text, re.M))
        words = {word for pair in defined for word in pair if word}
        if not beside or not set(filter(None, name.split("."))) <= words:
            missing.append((module, name))
    assert missing == []

"""How the house is cut: modules and their sizes, rows of the room table, short docstrings, the longest function.

    python benchmarks/house.py [--tree PATH]      PATH: another checkout, to compare with

Only files are read, nothing of the checkout is imported, so that any commit can be measured by this version.
"""

import argparse
import ast
from collections.abc import Iterator
from pathlib import Path
from statistics import median

HERE = Path(__file__).resolve().parent.parent
SHORT_WORDS = 4  # a docstring of so few words can only repeat its function's name
SMALL_LINES = 70
Definition = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
Function = ast.FunctionDef | ast.AsyncFunctionDef


def sizes(sources: dict[str, str]) -> Iterator[str]:
    """Lines a module; a package's ``__init__`` is a table of contents and not counted in the median."""
    lines = {name: len(text.splitlines()) for name, text in sources.items()}
    own = {name: count for name, count in lines.items() if not name.endswith("__init__.py")}
    largest = max(own, key=own.__getitem__)
    yield f"modules {len(lines)}, {len(lines) - len(own)} of them __init__.py; {sum(lines.values())} lines"
    yield f"lines of a module: median {median(own.values()):.0f}, largest {own[largest]} ({largest})"
    yield f"modules under {SMALL_LINES} lines: {sum(count < SMALL_LINES for count in own.values())}"


def rooms(tree: Path) -> str:
    """Rows of the table under "## Rooms" in docs/ARCHITECTURE.md, and how many imports between rooms they allow."""
    section = (tree / "docs" / "ARCHITECTURE.md").read_text("utf-8").split("## Rooms")[1].split("\n## ")[0]
    rows = [line.strip("|").split("|") for line in section.splitlines() if line.startswith("|")][2:]
    allowed = sum(len([name for name in row[2].split(",") if name.strip()]) for row in rows)
    return f"room table: {len(rows)} rows, {allowed} allowed imports"


def docstrings(sources: dict[str, str]) -> str:
    """How many docstrings have at most SHORT_WORDS words."""
    found = [text for source in sources.values() for text in _docstrings(ast.parse(source))]
    short = [text for text in found if len(text.split()) <= SHORT_WORDS]
    return f"docstrings: {len(found)}, of at most {SHORT_WORDS} words {len(short)}"


def longest_function(sources: dict[str, str]) -> str:
    """The function with most lines, decorators and docstring left out."""
    lines, where = max(
        (_body_lines(node), f"{name}:{node.lineno} {node.name}")
        for name, source in sources.items()
        for node in ast.walk(ast.parse(source))
        if isinstance(node, Function)
    )
    return f"longest function: {lines} lines ({where})"


def _docstrings(module: ast.Module) -> Iterator[str]:
    for node in ast.walk(module):
        if isinstance(node, Definition) and (text := ast.get_docstring(node)):
            yield text


def _body_lines(node: Function) -> int:
    first = node.body[0]
    documented = ast.get_docstring(node, clean=False) is not None
    skipped = (first.end_lineno or 0) - first.lineno + 1 if documented else 0
    return (node.end_lineno or 0) - node.lineno + 1 - skipped


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tree", type=Path, default=HERE, metavar="PATH", help="a checkout; default: this one")
    tree: Path = parser.parse_args().tree
    files = sorted((tree / "drillctl").rglob("*.py"))
    sources = {str(file.relative_to(tree)): file.read_text("utf-8") for file in files}
    print("\n".join((*sizes(sources), rooms(tree), docstrings(sources), longest_function(sources))))


if __name__ == "__main__":
    main()

"""The sentences that rooms below the screen tell people, found in their source: with ``{}`` where a value stands."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import drillctl

PACKAGE = Path(drillctl.__file__).parent
FIELD = re.compile(r"\{[^{}]*\}")
OF_MSGSPEC = {"expected {}, got {}", "expected {}", "invalid enum value {}", "unknown key {}", "{} is missing"}
TELLING = ("trace",
    *(
        "console",
        "files",
        "generation",
        "jobs",
        "kmd",
        "language",
        "machine",
        "portio",
        "replay",
        "ticker",
        "viewmodel",
    ),
)
ERRORS = {"JobError", "PlacingError", "AlignmentError", "JournalError"}


def form_of(sentence: str) -> str:
    """A catalogue's sentence with its fields left nameless."""
    return FIELD.sub("{}", sentence)


def texts(node: ast.AST) -> Iterator[str]:
    """Every string below a node, an f-string as its form; not the pieces of one."""
    if isinstance(node, ast.JoinedStr):
        parts = (part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
        yield "".join(map(str, parts))
    elif isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    if not isinstance(node, ast.JoinedStr):
        for child in ast.iter_child_nodes(node):
            yield from texts(child)


def trees(*rooms: str) -> Iterator[ast.Module]:
    """The modules of each room, which must have some."""
    for room in rooms:
        files = sorted((PACKAGE / room).rglob("*.py"))
        assert files, f"no room {room}"
        yield from (ast.parse(file.read_text("utf-8")) for file in files)


def all_forms() -> set[str]:
    """Every string below the screen that might be told; what msgspec says of a table is put plainly by machine."""
    return {without_place(text) for tree in trees(*TELLING) for text in texts(tree)} | OF_MSGSPEC


def refusals() -> set[str]:
    """What generation raises and warns of, without the ``{}: `` of a place before it."""
    nodes = [node for tree in trees("generation") for node in ast.walk(tree)]
    raised = [node for node in nodes if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ERRORS]
    yielded = [node for node in nodes if isinstance(node, ast.Yield)]
    found = {text for node in [*raised, *yielded] for text in texts(node)}
    return {bare for text in found if len(re.findall(r"[a-z]{2,}", bare := without_place(text))) >= 3 and " " in bare}


def editors_findings() -> set[str]:
    """What the editors of queues, tables and the configuration find wrong with a text, or dangerous."""
    readers = (ast.parse((PACKAGE / name).read_text("utf-8")) for name in ("kmd/text.py", "files/inputs.py"))
    trees_read = [*readers, *trees("machine")]
    nodes = [node for tree in trees_read for node in ast.walk(tree)]
    called = [node for node in nodes if isinstance(node, ast.Call) and _name(node.func) in {"TableError", "error"}]
    forms = {form for node in nodes if isinstance(node, ast.JoinedStr) for form in texts(node)}
    forms |= {form for node in called for form in texts(node)}
    return {bare for form in forms if len(re.findall(r"[a-z]{2,}", bare := without_place(form))) >= 3 and " " in bare}


def _name(called: ast.expr) -> str:
    return called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")


def without_place(text: str) -> str:
    """What follows the place that a sentence begins with."""
    return re.sub(r"^(\{\}(:\{\}|:1)*: )+", "", text)

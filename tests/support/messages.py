"""The messages of the package, found in its source: every template that a person may be shown."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import polib

import drillctl

PACKAGE = Path(drillctl.__file__).parent
MARKS = {"Message": 1, "_": 1, "N_": 1, "Counted": 2, "ngettext": 2}  # how many of the first arguments are templates
CATALOGUE = polib.pofile(str(PACKAGE / "locale/pl/LC_MESSAGES/drillctl.po"), check_for_duplicates=True)
POLISH = {entry.msgid: entry.msgstr for entry in CATALOGUE if not entry.msgid_plural}
# By both forms of the source: its forms for 1, for 2 to 4, and for 5 and more.
POLISH_FORMS = {
    (entry.msgid, entry.msgid_plural): [*entry.msgstr_plural.values()] for entry in CATALOGUE if entry.msgid_plural
}
TRANSLATED = {*POLISH, *(form for forms in POLISH_FORMS for form in forms)}
# Their messages go to a terminal or a test's report, in English; no screen of the program shows them.
IN_ENGLISH = ("cli", "lab", "api", "ui.terminal")


def templates_in(source: str) -> Iterator[str]:
    """Every literal handed to one of MARKS in a source text; both of one behind an ``if``."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in MARKS:
            for argument in node.args[: MARKS[node.func.id]]:
                yield from _literals(argument)


def _literals(node: ast.expr) -> Iterator[str]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from (*_literals(node.body), *_literals(node.orelse))


def modules() -> Iterator[tuple[str, str]]:
    """Every module's name, without ``drillctl.``, and its source."""
    for file in sorted(PACKAGE.rglob("*.py")):
        yield ".".join(file.relative_to(PACKAGE).with_suffix("").parts), file.read_text("utf-8")


@cache
def all_templates() -> frozenset[str]:
    """The templates of the whole package."""
    return frozenset(template for _name, source in modules() for template in templates_in(source))


@cache
def screen_templates() -> frozenset[str]:
    """The templates that a screen may show: those of every room but IN_ENGLISH, as far as they have words."""
    found = {template for name, source in modules() if not _in_english(name) for template in templates_in(source)}
    return frozenset(text for text in found if any(letter.isalpha() for letter in without_fields(text)))


def _in_english(name: str) -> bool:
    return any(name == room or name.startswith(f"{room}.") for room in IN_ENGLISH)


def without_fields(template: str) -> str:
    """What is left of a template without its ``{fields}``."""
    kept, _, rest = template.partition("{")
    return kept + without_fields(rest.partition("}")[2]) if rest else kept

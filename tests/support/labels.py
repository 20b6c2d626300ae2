"""What the operator reads and presses, in the language that is spoken: words of the catalogue, letters of the menus.

Rule: a word that the catalogue does not have is a mistake of the caller, not a word that happens to stay English.
Used by tests/ui and by the pictures in docs.
"""

from drillctl.language import words
from drillctl.ui.pcb_drill.menus import MENUS
from drillctl.ui.widgets.menus import Item, hot_letter
from tests.support.messages import POLISH, POLISH_FORMS


def word(message: str) -> str:
    """A message as the screen says it."""
    assert message in POLISH, f"the screen does not say {message!r}"
    return words._(message)


def counted(many: str, count: int, **fields: object) -> str:
    """A message with a number as the screen says it, by the source's form for many."""
    one = next((one for one, form in POLISH_FORMS if form == many), None)
    assert one is not None, f"the screen does not say {many!r}"
    return words.ngettext(one, many, count).format(count=count, **fields)


def menu(screen: str, method: str = "", argument: str | None = None) -> tuple[str, ...]:
    """The letters that lead to an entry of the menus: Alt with the first, then the others."""
    path = _path(MENUS, (screen, method, argument))
    assert path, f"no menu leads to {screen} {method} {argument}"
    first, *others = map(hot_letter, path)
    return (f"\x1b{first}", *others)


def _path(items: tuple[Item, ...], wanted: tuple[str, str, str | None]) -> tuple[Item, ...]:
    """From the bar down to the first entry that calls this; empty where there is none."""
    for item in items:
        if not item.items and (item.screen, item.method, item.argument) == wanted:
            return (item,)
        if found := _path(item.items, wanted):
            return (item, *found)
    return ()

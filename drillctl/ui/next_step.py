"""The line that says what the machine waits for: the sentence of a Step, with the keys of the screen on top in it."""

from collections.abc import Sequence

import urwid

from drillctl.language.words import _
from drillctl.ui.frame import screen_keys
from drillctl.ui.screens.own_steps import FIELD
from drillctl.ui.screens.shell import Step
from drillctl.ui.widgets.keys import STOP
from drillctl.ui.widgets.menus import Item, hot_letter
from drillctl.ui.widgets.texts import Line


def step_line(
    step: Step, screen: urwid.Widget, menus: Sequence[Item], typing: bool = False, entered: str = ""
) -> Line:
    """A Step as marked text. An action that the screen has no key for is named by its letters in the menus; a screen
    that the action leads to says by ``keys_here`` which method of its own goes on with it.

    ``typing``: a text field has the cursor, so that a letter is none of the keys. ``entered``: the action that Enter
    does in the box on top.
    """
    line: Line = [(step.attribute, f" {_('Next')} "), " "]
    for index, part in enumerate(FIELD.split(_(step.text))):
        if index % 2 == 0:
            line.append(part)
        elif part in step.values:
            line.append(("title", step.values[part]))
        else:
            name, method = step.actions[part]
            in_box = bool(entered) and entered in (name, method)
            line.append(("accent", "Enter" if in_box else _key(name, method, screen, menus, typing)))
    return line


def _key(name: str, method: str, screen: urwid.Widget, menus: Sequence[Item], typing: bool) -> str:
    wanted = method or name
    wanted = getattr(screen, "keys_here", {}).get(wanted, wanted)
    if wanted == STOP.method:
        return "Ctrl-X" if typing else STOP.printed
    own = next((key for key in screen_keys(screen) if key.method == wanted), None)
    return _(own.printed) if own else " ".join(_path(menus, name, method))


def _path(items: Sequence[Item], name: str, method: str, before: str = "Alt-") -> list[str]:
    """The letters that lead to an entry, the first with Alt; an empty list where there is none."""
    for item in items:
        letter = before + hot_letter(item).upper()
        if (item.screen, item.method) == (name, method) and not item.items:
            return [letter]
        if further := _path(item.items, name, method, ""):
            return [letter, *further]
    return []

"""The screens of the program: each is made by its name when it is first wanted, and kept; those that are open lie one
above the other.

Rule: the first screen of the machine's family is never closed; from the top it goes to the bottom.
"""

from collections.abc import Callable, Mapping

import urwid

from drillctl.ui.screens.shell import unsaved

Make = Callable[[], urwid.Widget]


class OpenScreens:
    """``general`` makes the screens that every machine has, by the names that the menus use.

    stack  the screens that are open; the last is on top
    """

    def __init__(self, general: Mapping[str, Make]):
        self._general, self._own = general, dict[str, Make]()
        self._made: dict[str, urwid.Widget] = {}
        self._first: urwid.Widget | None = None
        self.stack: list[urwid.Widget] = []

    @property
    def top(self) -> urwid.Widget:
        """The screen on top."""
        return self.stack[-1]

    @property
    def top_is_lowest(self) -> bool:
        """Whether no other screen lies below the one on top."""
        return len(self.stack) == 1

    @property
    def every(self) -> list[urwid.Widget]:
        """The screens that are open, and those that were made."""
        return [*self.stack, *self._made.values()]

    @property
    def unsaved(self) -> list[urwid.Widget]:
        """Those that hold something which would be lost."""
        return [screen for screen in self.every if unsaved(screen)]

    def use(self, own: Mapping[str, Make], first: str) -> None:
        """Makes from now on a family's own screens too, and opens its ``first``; forgets those of the family before."""
        self._own = dict(own)
        self._made = {name: screen for name, screen in self._made.items() if name in self._general}
        kept = [screen for screen in self.stack if screen in self._made.values()]
        self._first = self.named(first)
        assert self._first is not None, "a family has its first screen"
        self.stack = [self._first, *kept]

    def named(self, name: str) -> urwid.Widget | None:
        """Returns a screen; None for a name that no screen has."""
        if name not in self._made:
            make = self._general.get(name) or self._own.get(name)
            if make is None:
                return None
            self._made[name] = make()
        return self._made[name]

    def put_on_top(self, screen: urwid.Widget) -> None:
        """Opens a screen; one that is open already comes to the top."""
        self.stack = [other for other in self.stack if other is not screen] + [screen]

    def close_top(self) -> None:
        """Closes the screen on top, where another lies below it."""
        top = self.stack.pop()
        if top is self._first:
            self.stack.insert(0, top)

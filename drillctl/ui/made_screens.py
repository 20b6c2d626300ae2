"""The screens by the names that the menus use, each made when it is first wanted and kept from then on."""

from collections.abc import Callable, Iterator, Mapping

import urwid

Make = Callable[[], urwid.Widget]


class MadeScreens:
    """``general`` makes the screens that every machine has. Iterates over the screens that were made."""

    def __init__(self, general: Mapping[str, Make]):
        self._general, self._own = general, dict[str, Make]()
        self._made: dict[str, urwid.Widget] = {}

    def __iter__(self) -> Iterator[urwid.Widget]:
        return iter(self._made.values())

    def use(self, own: Mapping[str, Make]) -> None:
        """Makes from now on a family's own screens too; forgets those of the family before."""
        self._own = dict(own)
        self._made = {name: screen for name, screen in self._made.items() if name in self._general}

    def named(self, name: str) -> urwid.Widget | None:
        """Returns a screen; None for a name that no screen has."""
        if name not in self._made:
            make = self._general.get(name) or self._own.get(name)
            if make is None:
                return None
            self._made[name] = make()
        return self._made[name]

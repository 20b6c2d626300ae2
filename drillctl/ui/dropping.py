"""The menus that drop from the bar: which is open, and what a choice or a click does to them.

Rule: one menu of the bar is open at a time; what its entries do is decided in app.py.
"""

from collections.abc import Callable, Sequence

from drillctl.ui.frame import MenuBar
from drillctl.ui.layers import Layers
from drillctl.ui.widgets.menus import Item, PullDown


class Dropping:
    """Opens menus of ``bar`` on ``layers``; ``choose`` is called with an entry, after all menus are closed."""

    def __init__(self, bar: MenuBar, layers: Layers, choose: Callable[[Item], object]):
        self._bar, self._layers, self._choose = bar, layers, choose

    def drop(self, index: int | None) -> bool:
        """Opens a menu of the bar in place of any that is open; False for no menu."""
        if index is None:
            return False
        self._layers.close_menus()
        menus = self._bar.menus
        index %= len(menus)

        def sideways(by: int) -> None:
            self.drop(index + by)

        self.pull(menus[index].items, self._bar.left_of(index), 1, sideways)
        return True

    def pull(
        self, items: Sequence[Item], left: int, top: int, sideways: Callable[[int], None] = lambda by: None
    ) -> None:
        """Opens a box of entries at a place; a further box lies a little below it and to the right."""

        def chosen(item: Item) -> None:
            if item.items:
                self.pull(item.items, left + 4, top + 2, lambda by: self._layers.pop() if by < 0 else None)
            else:
                self._layers.close_menus()
                self._choose(item)

        box = PullDown(items, chosen, sideways, self._layers.pop)
        self._layers.push_menu(box, left, top)

    def clicked(self, event: str, column: int, row: int) -> bool:
        """Closes the menus for a click that none of them took, and opens the one of the bar that was clicked."""
        if event != "mouse press" or not isinstance(self._layers.top, PullDown | None):
            return False
        self._layers.close_menus()
        return row == 0 and self.drop(self._bar.at(column))

"""How the scope looks for events of a kind, and for commands by a part of their text.

Rule: it moves the cursor of the Scope that it is part of, or says that there is nothing further.
"""

from drillctl.language.words import _
from drillctl.ui.models.viewport import SignalRows, Viewport
from drillctl.ui.screens.scope_keys import KINDS, SEARCH_OF
from drillctl.ui.screens.scope_measure import command_after
from drillctl.ui.screens.shell import Shell
from drillctl.viewmodel.scope import BACKWARDS, FORWARDS, Find, ScopeSource


class Searching:
    """The part of the Scope that looks for something in its run."""

    _shell: Shell
    _source: ScopeSource
    _view: Viewport
    _rows: SignalRows
    _kind: Find = KINDS[0]  # of event, that N looks for
    _sought = ""

    def _go(self, tick: int) -> None:
        raise NotImplementedError  # by the Scope, as the one below

    def _say(self, text: str) -> None:
        raise NotImplementedError

    def search(self) -> None:
        """Asks for a part of a command's text, then moves the cursor to the next such command."""
        self._shell.ask_text(_("Find a command"), _("A part of its text:"), self._sought, self._search)

    def next_kind(self) -> None:
        """Chooses the next kind of event to be looked for, and says which."""
        self._kind = KINDS[(KINDS.index(self._kind) + 1) % len(KINDS)]
        self._say(_("N: {event}").format(event=_(SEARCH_OF[self._kind].on)))

    def look_for(self, kind: Find) -> None:
        """Chooses a kind of event, and moves the cursor to the next one."""
        self._kind = kind
        self.find_on()

    def find_on(self) -> None:
        """Moves the cursor to the next event of the kind that was chosen."""
        self._find(FORWARDS)

    def find_back(self) -> None:
        """Moves the cursor to the event of the kind that was chosen before it."""
        self._find(BACKWARDS)

    def _search(self, typed: str) -> None:
        self._sought = typed.strip()
        tick = command_after(self._source, self._view.cursor, self._sought)
        if tick is None:
            self._say(_("no further command with {text!r} in it").format(text=self._sought))
        else:
            self._go(tick)

    def _find(self, direction: int) -> None:
        tick = self._source.find(self._kind, self._view.cursor, direction, self._rows.at)
        if tick is None:
            self._say(_(SEARCH_OF[self._kind].none))
        else:
            self._go(tick)

"""The question for another interrupt frequency, for the first screen of every family of machines."""

from collections.abc import Callable

from drillctl.language.words import _, ngettext
from drillctl.ui.screens.shell import Shell
from drillctl.viewmodel.console import Console, Problems

Answer = Callable[[Problems, str], object]


def ask_tick_hz(console: Console, shell: Shell, answer: Answer, say: Callable[[str, str], object]) -> None:
    """Asks for the ticks a second, which take effect at rest and keep the position.

    answer  is called with the problems, and what is done where there are none; ``say`` with a role and a text
    """

    def typed(text: str) -> None:
        if not text.strip().isdecimal():
            say("warning", _("a whole number of ticks a second is wanted, not {text!r}").format(text=text))
            return
        hz = int(text)
        said = ngettext(
            "{count} tick a second; the position is kept", "{count} ticks a second; the position is kept", hz
        )
        answer(console.set_tick_hz(hz), said.format(count=hz))

    prompt = _("Ticks a second, until the machine is chosen again:")
    shell.ask_text(_("Interrupt frequency"), prompt, str(console.view().tick_hz), typed)

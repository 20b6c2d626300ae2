"""A question before a real machine is touched. Rule: on a simulated one nobody is asked. Used by the Tests screens."""

from collections.abc import Callable

from drillctl.panel.handwork import HandDesk
from drillctl.ui.shell import Shell
from drillctl.ui.words import _


def asked_if_real(desk: HandDesk, shell: Shell, what: str, act: Callable[[], None], warning: str = "") -> None:
    """Does it at once on a simulated machine, without a ``warning``; else after a yes."""
    port = desk.real_port()
    real = _("A real machine hangs on {port}.").format(port=port) if port else ""
    reasons = " ".join(filter(None, (real, warning)))
    if reasons:
        shell.ask(f"{reasons} {what}", act)
    else:
        act()

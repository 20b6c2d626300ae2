"""The panel beside the configuration: what a field means, what it may be, and what the changes will do once saved."""

from drillctl.language.words import _, translated
from drillctl.ui.models.machine_fields import ConfigurationDraft, words_of
from drillctl.ui.screens.table_actions import label_of
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.panel import titled
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.tables import FieldView

TICK_RATE = ("tick_hz",)  # the place of the interrupt frequency


def about_field(draft: ConfigurationDraft, field: FieldView | None, carried: str, columns: int) -> list[Line]:
    """The lines of the panel. ``carried``: the tick rate that this computer carries, in words; empty: not measured."""
    if field is None:
        return []
    words, typed = words_of(field), draft.shown(field)
    allowed = " | ".join(field.choices) or field.bounds or _("any text")
    lines: list[Line] = [
        [("title", label_of(field))],
        [_(words.meaning)],
        [""],
        [_("unit: {unit}").format(unit=_(words.unit) or "-")],
        [_("may be: {allowed}").format(allowed=allowed)],
        [_("in the file: {value}").format(value=field.value)],
    ]
    if typed != field.value:
        lines.append([("warning", _("typed: {value}").format(value=typed))])
    if field.place == TICK_RATE:
        lines.append([carried or _("F12 measures which tick rate this computer carries.")])
    lines += [[""], titled(_("What the changes will do"), columns), *effect_lines(draft)]
    return folded(lines, columns)


def effect_lines(draft: ConfigurationDraft) -> list[Line]:
    """What saving will do, a line each; or that nothing was changed."""
    if not draft.changed:
        return [[("dark", _("nothing was changed"))]]
    lines: list[Line] = [[("warning", translated(effect))] for effect in draft.effects()]
    return [*lines, [_("In force when the machine is started anew; its position is lost then.")]]

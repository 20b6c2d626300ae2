"""A field of the configuration in words: its row, and the panel beside: what it means and may be, what the changes will
do once saved.
"""

import urwid

from drillctl.language.words import _, ngettext, translated
from drillctl.ui.models.machine_fields import ConfigurationDraft, words_of
from drillctl.ui.screens.table_actions import label_of
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.panel import titled
from drillctl.ui.widgets.texts import Edit, Line, Text, WholeText
from drillctl.viewmodel.tables import FieldView

TICK_RATE = ("tick_hz",)  # the place of the interrupt frequency
LABEL_COLUMNS, VALUE_COLUMNS = 28, 18
HINT_COLUMNS = 32  # in fewer the hint of the field under the cursor stands below the fields


def field_row(field: FieldView, edit: Edit, carried_hz: int | None) -> urwid.Widget:
    """The row of a field: label, value, hint; a field of free text has the whole line."""
    hint = hint_of(field, carried_hz)
    label, box = Text(label_of(field)), urwid.AttrMap(edit, "field", "focus")
    if not hint:
        return urwid.Columns([(LABEL_COLUMNS, label), box], 1)
    return urwid.Columns([(LABEL_COLUMNS, label), (VALUE_COLUMNS, box), WholeText(hint)], 1)


def hint_of(field: FieldView, carried_hz: int | None) -> Line:
    """Unit and bounds, or what can be chosen; that it is locked; beside the tick rate what this computer carries, or
    the key that measures it. Nothing for a field of free text.
    """
    unit = _(words_of(field).unit)
    allowed = "" if field.locked else _choices(field) or field.bounds
    sign: Line = [("warning", _("locked") + "  ")] if field.locked else []
    if field.place == TICK_RATE:
        allowed += "  " + (_("here {hz}").format(hz=carried_hz) if carried_hz else _("F12 measures"))
    return [*sign, ("dark", f"{unit}  {allowed}" if unit else allowed)] if sign or allowed else []


def _choices(field: FieldView) -> str:
    """The values that can be chosen, or how many where they have no room in the row."""
    listed, count = " | ".join(field.choices), len(field.choices)
    if len(listed) <= HINT_COLUMNS:
        return listed
    return ngettext("{count} value: F6", "{count} values: F6", count).format(count=count)


def carried_words(hz: int) -> str:
    """The tick rate that this computer carries, in words."""
    return _("this computer carries {hz} Hz").format(hz=hz)


def about_field(draft: ConfigurationDraft, field: FieldView | None, carried_hz: int | None, columns: int) -> list[Line]:
    """The lines of the panel. ``carried_hz``: the tick rate that this computer carries; None: not measured."""
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
        told = carried_words(carried_hz) if carried_hz else _("F12 measures which tick rate this computer carries.")
        lines.append([told])
    lines += [[""], titled(_("What the changes will do"), columns), *effect_lines(draft)]
    return folded(lines, columns)


def effect_lines(draft: ConfigurationDraft) -> list[Line]:
    """What saving will do, a line each; or that nothing was changed."""
    if not draft.changed:
        return [[("dark", _("nothing was changed"))]]
    lines: list[Line] = [[("warning", translated(effect))] for effect in draft.effects()]
    return [*lines, [_("In force when the machine is started anew; its position is lost then.")]]

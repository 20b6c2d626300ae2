"""What the menu Drilling of the eight-axis drill has beside: parking, and a form for each group of parameters."""

from drillctl.language.words import N_
from drillctl.ui.widgets.menus import Item

MACHINE = Item(N_("&Machine"), items=(
    Item(N_("&Parking place"), "drilling", "park"),
    Item(N_("&Tools..."), "drilling", "tools"),
    Item(N_("&Magazine..."), "drilling", "magazine"),
    Item(N_("&Axes..."), "drilling", "form", "axis"),
    Item(N_("&System..."), "drilling", "form", "system"),
    Item(N_("Ma&chining..."), "drilling", "form", "machining"),
    Item(N_("C&oordinates..."), "drilling", "form", "coordinates"),
))  # fmt: skip

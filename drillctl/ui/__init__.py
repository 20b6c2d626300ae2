"""LAYER 1: what a person sees. Every view is a function of a record from viewmodel.

    app.py     the loop of the program on the screen: news in, keys out
    frame.py   menu bar, the line on the machine, the key line       menus.py   the menus as a table
    layers.py  dialogs and menus over the frame                      alerts.py  faults, tool changes, mode REAL
    screens/   Files, Drilling, the editors, the scope               models/    what they know, without a widget
    widgets/   dialogs, lists, charts, keys: no machine is known     terminal/  what the verbs print and draw
"""

"""LAYER 1: what a person sees. Every view is a function of a record from viewmodel.

    app.py     the loop of the program on the screen: the machine's news in, keys out
    first_keys.py  emergency stop, stop and copy, looked for before any widget sees a key
    frame.py   the menu bar, the line on the machine, the next step, the line of keys
    explanations.py  what F1 says of each screen and its signs, before its keys
    next_step.py  what the machine waits for, with the keys of the screen on top
    preferences.py  the theme that was chosen, kept in the user's configuration
    background.py  work that may take seconds, done beside the screen
    painter.py  the terminal: of each row only the part that has changed is written
    canvas_rows.py  the rows of a frame; parts that have not changed give those of the frame before
    layers.py  dialogs and menus over the frame          alerts.py  faults, tool changes, mode REAL
    open_screens.py  the screens: each made when it is first wanted, those that are open one above the other
    machines.py  which screens and menus a machine has: a row for each family of machines

    pcb_drill/ the screens and menus of the PCB drill: Drilling, Files, placing by measured holes
    screens/   what every machine has: tables, ramps, configuration, queue, signals, port, scope
    models/    what the editors and the scope work on, without a widget
    widgets/   dialogs, menus, texts, keys, colours: no machine is known
    terminal/  what the verbs print and draw

The program on the screen imports nothing of terminal/, nor terminal/ of it (tests/ui/test_machines.py).
"""

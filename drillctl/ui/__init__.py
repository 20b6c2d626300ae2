"""LAYER 1: what a person sees. Every view is a function of a record from panel.

    progress.py  a job on its way: a bar on a terminal, plain lines in a pipe
    tools.py     the operator changes the tool, on a terminal
    summary.py   how a job ended, in words
    latency.py   how punctual this computer is
    board.py     holes as braille dots
    charts.py    pictures of numbers in characters
    plotted.py   the same as PNG or SVG, by matplotlib

The program on the screen, in urwid:

    app.py       the loop: news in, keys out
    layers.py    dialogs and menus over the frame
    frame.py     menu bar, the line on the machine, the key line
    menus.py     the menus as a table       keys.py    the keys as tables
    real.py      a question before a real machine is touched
    alerts.py    faults, tool changes, mode REAL, told wherever the operator is
    dialogs.py   tell, ask, ask for text    pick.py    a line that can be chosen
    forms.py     several fields, choices    formats.py the drill files' formats by name
    unfinished.py  jobs that were cut off   told.py    sentences from below, translated
    shell.py     what a screen is offered   lines.py   lines of marked text in a box
    themes.py    colours by meaning         words.py   the operator's language
    wave.py      waves in characters        phase_lines.py   a motor's phases
    screens/     Files, Drilling, and the editors

May import panel.
"""

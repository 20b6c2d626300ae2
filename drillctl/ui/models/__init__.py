"""What the editors think, apart from how they look: pure values and functions, without urwid.

    history.py      undo and redo of any value
    phase_grid.py   a phase table as cells that can be toggled, inserted, removed and mirrored
    completion.py   what Tab makes of a half-written command
    form.py         fields being typed over, and the text that they would make
"""

"""What the editors and the scope think, apart from how they look: pure values and functions, without urwid.

history.py      undo and redo of any value
phase_grid.py   a phase table as cells that can be toggled, inserted, removed and mirrored
completion.py   what Tab makes of a half-written command
signal_grid.py  signals as cells, as many a line as there is room for
form.py         fields being typed over, and the text that they would make
viewport.py     which ticks of a run are on the screen
rows.py         which rows of a long list are
jog_sizes.py    how far a press of a jog key goes
scale.py        the scale of an axis from a measurement
"""

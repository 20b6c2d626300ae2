"""What the editors and the scope work on, apart from how it looks: pure values and functions, without urwid.

    editing.py         undo and redo of any value; what Tab makes of a half-written command
    phase_grid.py      a phase table as cells, and the bits that switch its wires
    machine_fields.py  the fields of a machine's file: their words, and what is typed over them
    signal_grid.py     signals as cells, as many a line as there is room for
    fault_effects.py   what each fault of the dynamic plant does, in words and drawn
    bench_lines.py     the trial of a table on bench motors, as lines and charts
    events.py          what happened at the machine, from one view to the next
    board_map.py       where a board lies on the screen: scale, zoom and pan
    board_work.py      which holes of a board are drilled, in work, failed
    speeds.py          how fast each axis moves
    viewport.py        which ticks and which signals of a run are on the screen
"""

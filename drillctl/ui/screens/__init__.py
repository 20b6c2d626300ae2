"""The screens that every machine has: each is made with a Console and a Shell, and draws the records it is given.

    shell.py         what a screen may ask of the program around it, and what a family of machines must name
    menus.py         the menus Tests, Configuration and Help
    step_rows.py     what a machine waits for: the rows that every machine has
    board_steps.py   and those of a machine that drills boards
    own_steps.py     what can be done next on a screen itself
    folded_screen.py what screens share that only show lines
    table_list.py    the tables of one kind, to be opened     table_editor.py   what the editors of tables share
    table_actions.py save, reset, compare, copy, delete       phase_editor.py  ramp_editor.py  queue_editor.py
    configuration.py the machine's file as fields             scale_guide.py    the scale of an axis measured
    field_panel.py   what a field of it means, and what changes will do
    field_form.py    a list of fields to type into
    tick_log.py      single ticks of a queue as a picture     queue_lines.py   what stands around the queue
    scope.py         a run as a logic analyser shows it: its keys are in scope_keys.py, its lines in scope_view.py,
                     its waves in scope_wave.py, its curves in scope_curve.py, what is measured in scope_measure.py
    signals.py       every input and output, live             port.py           the port, tested and chosen
    plant.py         ideal or dynamic motors, faults and seed of the simulated machine
    board_controls.py what is asked of a machine that drills boards; board_view.py   the picture of the board
    board_layers.py  what lies in each cell of that picture   rulers.py         what stands around it
    unfinished.py    jobs that were interrupted, offered  window_lines.py   hole, tool, time, lamps, ticks as lines
    event_list.py    what happened at the machine
    reader.py        a text to be read
    machine_lines.py phases and tools as lines of text        jog_controls.py   jog keys, and the line that answers
"""

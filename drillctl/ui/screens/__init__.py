"""The screens: each is made with a Console and a Shell, and draws what the Console's records say.

    files.py         find a drill file, see what it says, place it
    drilling.py      the machine at work: jog, base, start, hold, stop
    side_window.py   the paper's window at the right: a function of the machine's view
    board_view.py    the board: done, current, to do, and the head
    phase_editor.py  ramp_editor.py  queue_editor.py  configuration.py    the Tests and Configuration menus
    table_list.py    which table to edit      table_editor.py, field_words.py    what the editors share
"""

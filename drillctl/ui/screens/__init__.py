"""The screens: each is made with a Console and a Shell, and draws what the Console's records say.

files.py         find a drill file, see what it says, place it
browser.py  board_facts.py  typed.py    its list, words, what is typed      alignment.py  placing by measured holes
drilling.py      the machine at work: jog, base, start, hold, stop
at_machine.py    what the screens with jog keys share
side_window.py   the paper's window at the right: a function of the machine's view
board_view.py    the board: done, current, to do, and the head
phase_editor.py  ramp_editor.py  queue_editor.py  configuration.py    the Tests and Configuration menus
scope.py         a run as a logic analyser shows it: keys and cursor    scope_view.py  its lines    scope_keys.py
signals.py       every input and output, live    port.py    the port, tested and chosen
table_list.py    which table to edit
table_editor.py  shelf.py  compare.py  field_words.py    what the editors share
scale_guide.py   the scale of an axis measured, step by step
"""

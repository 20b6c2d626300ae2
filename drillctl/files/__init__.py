"""Files, whatever they hold.

    inputs.py   every file that is read is opened here, within a limit of bytes
    outputs.py  files reserved before anything moves, complete or absent afterwards
    scratch.py  files that live as long as their run, and what a killed run left
"""

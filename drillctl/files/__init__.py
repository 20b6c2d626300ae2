"""Files, whatever they hold.

inputs.py   opens every file that is read, within a limit of bytes
outputs.py  files reserved before anything moves, complete or absent afterwards
kept.py     a file kept across power loss: replaced whole, and on the disk
shipped.py  where the files are that come with the program
scratch.py  files that live as long as their run, and the removal of what a killed run left
"""

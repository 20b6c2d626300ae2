"""What only a machine that drills boards needs of layer 2: the program of a board, hole by hole.

board.py    a drill file as a job          program.py  a work list as a program of KMD records
strokes.py  how one hole is drilled: straight, in pecks, with a spot first
milling.py  how one slot is milled
"""

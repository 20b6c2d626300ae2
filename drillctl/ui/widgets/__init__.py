"""Widgets and lines of text that know no machine.

    texts.py    widgets with words in them, and lines of marked text       dots.py    points as braille dots, to scale
    dialogs.py  boxes that tell and ask      menus.py  boxes of entries    keys.py    keys, their help and dispatch
    themes.py   colours by meaning           borders.py  the lines of frames  windows.py parts in a border, with a title
    sizes.py    what a screen has room for   text_graphics.py  large digits, bars, and charts a row high
    pages.py    blocks of lines on pages of a window            drawn.py  a box of lines that a function gives
"""

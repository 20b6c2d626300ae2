"""A run for a browser: one page of HTML with all that it needs in it; no network.

    page     a whole report: ``report_page``
    facts    its words: how the run ended, what each axis did, commands and events
    drawings its drawings without a script: the board, curves over time
    waves    its waves as data for page.js, which draws and zooms them
    board    the holes of a run in a notebook
    page.css, page.js   looks (light and dark, wide and narrow) and zoom
"""

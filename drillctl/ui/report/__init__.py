"""A run for a browser: one page of HTML with all that it needs in it; no network.

    page     a whole report: ``report_page``
    facts    its words: how the run ended, what each axis did, commands and events
    board_plan  its board as a drawing: holes, errors, tools
    drawings its curves over time; svg.py: what both drawings share
    waves    its waves as data for page.js, which draws and zooms them
    board    the holes of a run in a notebook
    page.css, page.js   looks (light and dark, wide and narrow) and zoom
"""

"""A run for a browser, in one piece of HTML that needs no network.

    board    the holes as SVG; what a notebook shows of a run
"""

"""LAYER 1: what a person sees. Every view is a function of a record from panel.

    progress.py  a job on its way: a bar on a terminal, plain lines in a pipe
    tools.py     the operator changes the tool, on a terminal
    summary.py   how a job ended, in words
    latency.py   how punctual this computer is

May import panel.
"""

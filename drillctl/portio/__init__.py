"""LAYER 4: drivers, one file each. They carry the port image to a card and bring the sensors back.

    simulated.py   a card whose wires end in a plant
    playback.py    a card whose inputs are a recording's

May import ports; simulated alone also plant.
"""

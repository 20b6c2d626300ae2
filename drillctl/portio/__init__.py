"""LAYER 4: drivers, one file each. They carry the output image to a card and bring the input image back.

    registry.py          the ports as a table: opened by name, or refused with a reason
    simulated.py         a card whose wires end in a plant; a card whose outputs drive a plant beside it
    mapped.py            the simulated card with its image in a file, which stays after a crash
    playback.py          a card whose inputs come from a recorded trace
    firmata.py           an Arduino on a serial line, with firmata_pins, _line, _protocol and _watch
    pcl720.py            the paper's card, through /dev/port
    gpiod_lines.py       the GPIO lines of a Linux board

Rule: a driver imports ports (and files, for its settings); simulated.py alone imports plant.
"""

"""LAYER 4: drivers, one file each. They carry the port image to a card and bring the sensors back.

    registry.py          the ports as a table: opened by name, refused with a reason
    simulated.py         a card whose wires end in a plant, and one beside which a plant is watched
    mapped.py            the same with its image in a file that outlives a crash
    playback.py          a card whose inputs are a recording's
    recording.py         around any other: keeps what went through
    firmata.py           an Arduino on a serial line: firmata_pins, _line, _protocol and _watch below it
    pcl720.py            the paper's own card, through /dev/port
    gpiod_lines.py       the lines of a Raspberry Pi and its like

May import ports; simulated alone also plant.
"""

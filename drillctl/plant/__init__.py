"""Beyond the ports: the machine itself, as far as a port can tell. It sees coil bits only and believes nobody.

    rotor.py   one motor: where the windings that are on pull it, or what its drive has counted
    ideal.py   the ideal plant: rotors without inertia, carriages, sensors, the bit meeting the board

An instrument, not a layer: the wiring builds it, hands it to portio/simulated and reads what it observed.
May import machine. On a real port it is not there.
"""

from drillctl.plant.ideal import IdealPlant

__all__ = ["IdealPlant"]

"""Beyond the ports: the machine itself, as far as a port can tell. It sees coil bits only and believes nobody.

    base.py      what every plant offers            choice.py   which one stands behind a card
    rotor.py     one motor: where the windings that are on pull it, or what its drive has counted
    carriage.py  what it moves, and the sensors that this passes
    ideal.py     the ideal plant: rotors without inertia      foreseen.py  where they will be, without driving them
    dynamic/     the dynamic plant: currents, inertia, friction; rotors that lose steps
    faults.py    what can be told to be wrong with a machine

An instrument, not a layer: the wiring builds it, hands it to portio/simulated and reads what it observed.
May import machine. On a real port it is not there.
"""

from drillctl.plant.base import Plant
from drillctl.plant.choice import IDEAL_PLANT, PlantChoice
from drillctl.plant.faults import PlantRefused
from drillctl.plant.ideal import IdealPlant

__all__ = ["IDEAL_PLANT", "IdealPlant", "Plant", "PlantChoice", "PlantRefused"]

"""The simulated machine beyond the ports. It sees output bits only, and takes nothing from the controller.

    base.py      what every plant offers            choice.py   which plant stands behind a card
    rotor.py     one motor: where the windings that are on pull it, or how many pulses its drive has counted
    carriage.py  what a motor moves, and the sensors that it passes
    ideal.py     the ideal plant: motors without inertia
    forecast.py  where its rotors will be, without driving them
    dynamic/     the dynamic plant: currents, inertia, friction; motors that lose steps
    faults.py    what can be wrong with a machine (--fault)

Not a layer: whoever opens the simulated port builds a plant, hands it to portio/simulated, and reads holes and lost
steps from it. May import machine. On a real port there is no plant.
"""

from drillctl.plant.base import Plant
from drillctl.plant.choice import IDEAL_PLANT, PlantChoice
from drillctl.plant.faults import PlantRefused
from drillctl.plant.ideal import IdealPlant

__all__ = ["IDEAL_PLANT", "IdealPlant", "Plant", "PlantChoice", "PlantRefused"]

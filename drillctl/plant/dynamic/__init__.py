"""The dynamic plant: a motor as four half-winding currents, an inertia, friction and a detent. docs/PLANT.md.

coefficients.py  the equations, and the numbers that a substep multiplies with
axis.py          one rotor, in plain floats: the law
fleet.py         many variants of one at once, the same to the bit (numpy; not needed to run a machine)
rotor.py         an axis's motor between port images and columns
drilling.py      the drill in the board          worn.py   sensors and belts as they are
plant.py         all of it together              recorder.py   currents, speed and place of every tick
"""

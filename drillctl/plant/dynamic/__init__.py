"""The dynamic plant: a motor as the currents of its windings, an inertia, friction and a detent. docs/PLANT.md.

coefficients.py  the equations, and the constants that a substep multiplies with
motors.py        what a tick does to a motor, in plain floats; motors.pxd: its C types
law.py           the same for the whole machine: motors, carriages, bits; law.pxd: its C types
kernel.py        which form of the law runs: compiled, or as it stands
axis.py          one rotor, a tick at a time
fleet.py         many variants of one rotor at once, the same to the bit (numpy; not needed to run a machine)
rotor.py         an axis's motor between port images and columns
drilling.py      the drill in the board, sensors with faults, belts with play
plant.py         all of it together              recorder.py   place, speed and currents of every tick
"""

"""In what order the holes of a tool are drilled, so that the machine travels little between them.

    travel.py      what a move costs: travel ticks from the axes' ramp tables
    neighbours.py  every hole's nearest others by that cost
    nearest.py     always to the nearest hole left: quick, and a start for better
    path.py        an order under repair: pieces of it turned round, and turned back
    improve.py     2-opt and Or-opt moves until none shortens the path
    optimise.py    the same again from many small disturbances, keeping what is shorter
    plan.py        the front door: one tool, or one tool after the other

Rule: whole numbers only and no clock, so the same holes always give the same order. It knows steps and
ticks, no millimetres and no machine. Called by whoever makes a job out of a drill file.
"""

from drillctl.generation.order.plan import HOWS, path_ticks, plan, plan_groups
from drillctl.generation.order.travel import OrderError, TravelCost

__all__ = ["HOWS", "OrderError", "TravelCost", "path_ticks", "plan", "plan_groups"]

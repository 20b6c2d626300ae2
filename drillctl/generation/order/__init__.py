"""In what order the holes of a tool are drilled, so that the machine travels little between them.

    travel.py      what a move costs: travel ticks from the axes' ramp tables
    stops.py       where a path goes: the start, the holes tool by tool, the end
    neighbours.py  every hole's nearest others by that cost
    nearest.py     always to the nearest hole left: quick, and a start for better
    loop.py        the cost of each way in a path under repair, and of a change of the tool
    path.py        an order under repair: pieces of it turned round, and turned back
    improve.py     2-opt and Or-opt moves until none shortens the path
    optimise.py    the same again from many small disturbances, keeping what is shorter
    budget.py      how long that may go on: to the end, for so many steps or seconds
    plan.py        the front door: one tool, or one tool after the other

Rule: whole numbers only, and no clock but that of a budget of seconds, so the same holes always give the same order.
It knows steps and ticks, no millimetres and no machine.
"""

from drillctl.generation.order.budget import Budget
from drillctl.generation.order.plan import path_ticks, plan, plan_groups
from drillctl.generation.order.travel import OrderError, TravelCost

__all__ = ["Budget", "OrderError", "TravelCost", "path_ticks", "plan", "plan_groups"]

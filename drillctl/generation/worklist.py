"""The work list: what is drilled with which tool, where, in steps from the working base, in drilling order.

Rule: holes that the machine can't reach are refused here, each by name, before anything moves. Slots become chains
of holes, panels become boards.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.drills import Drill, drill_problems
from drillctl.generation.errors import JobError
from drillctl.generation.order import Budget, TravelCost, plan_groups
from drillctl.generation.placing import Affine, boards
from drillctl.generation.waits import Advance, ignored
from drillctl.generation.work_settings import WorkSettings
from drillctl.language import Counted, Message
from drillctl.machine import Machine, travel_table

if TYPE_CHECKING:
    from drillctl.generation.drillfile import DrillFile

# A chain overlaps by half its drill: the waist left between two holes is then an eighth of the diameter.
CHAIN_PITCH = 0.5
CHAIN_DRILL_MM = 1.0  # for a slot whose tool has no diameter
Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Group:
    """The holes of one tool: ``start`` to ``stop`` of the work list, and the drill at hand that serves them."""

    number: int
    diameter_mm: float | None
    start: int
    stop: int
    drill: Drill | None = None


@dataclass(frozen=True, eq=False)
class Hits:
    """Every place where a bit goes down (n holes): file millimetres (n, 2), tool index, line of the file, board; and
    where it comes up, ``end_mm`` (n, 2): the same place, but of a slot that is milled.
    """

    xy_mm: Floats
    end_mm: Floats
    tool: Integers
    line: Integers
    board: Integers

    def take(self, chosen: NDArray[np.intp] | NDArray[np.bool_]) -> "Hits":
        """These holes, in this order."""
        return Hits(self.xy_mm[chosen], self.end_mm[chosen], self.tool[chosen], self.line[chosen], self.board[chosen])


@dataclass(frozen=True, eq=False)
class WorkList:
    """Holes in drilling order, grouped by tool; ``steps`` (n, 2) are X and Y from the working base, ``ends`` (n, 2)
    where the bit comes up: elsewhere for a slot that is milled.

    number (n,)  the holes' numbers in the whole job, from 1; what is left of a job keeps them
    order_steps  after how many steps the search for a shorter order was cut short; None where it came to its end
    """

    groups: tuple[Group, ...]
    hits: Hits
    steps: Integers
    ends: Integers
    boards: tuple[Affine, ...]
    number: Integers
    order_steps: int | None = None

    def without(self, done: set[int]) -> "WorkList":
        """What is left when these holes, by number, are drilled."""
        left = np.flatnonzero(~np.isin(self.number, list(done)))
        bounds = [(int(np.searchsorted(left, g.start)), int(np.searchsorted(left, g.stop)), g) for g in self.groups]
        groups = tuple(replace(group, start=start, stop=stop) for start, stop, group in bounds if stop > start)
        steps, ends = self.steps[left], self.ends[left]
        return WorkList(groups, self.hits.take(left), steps, ends, self.boards, self.number[left], self.order_steps)


def build(drill_file: "DrillFile", settings: WorkSettings, machine: Machine, advance: Advance = ignored) -> WorkList:
    """The work list of a file on a machine; ``advance`` is called with how far the ordering is.

    Raises JobError for a machine, tools or holes that don't fit.
    """
    axes = positioning_axes(machine)
    extent_mm = np.concatenate([drill_file.hole_xy_mm, drill_file.slot_mm.reshape(-1, 2)])
    maps = boards(settings.placing, extent_mm)
    hits = _on_every_board(_chosen(drill_file, _hits(drill_file, settings.mill), settings), len(maps))
    hits = hits.take(np.argsort(hits.tool, kind="stable"))
    scale = np.array([machine.axes[axis].steps_per_mm for axis in axes])
    steps, ends = (np.rint(placed_mm(maps, hits, of) * scale).astype(np.int64) for of in (hits.xy_mm, hits.end_mm))
    for places in (steps, ends):
        _check_reach(drill_file, hits, places, settings.base_steps, machine)
    groups = _groups(drill_file, hits, settings)
    budget = Budget(settings.order_seconds, settings.order_steps)
    order = _order(groups, steps, ends, settings, machine, budget, advance)
    order_steps = budget.steps if budget.cut else None
    numbers = np.arange(1, len(order) + 1)
    return WorkList(groups, hits.take(order), steps[order], ends[order], maps, numbers, order_steps)


def placed_mm(maps: tuple[Affine, ...], hits: Hits, of_mm: Floats) -> Floats:
    """Places of the holes (n, 2), in the file's millimetres, as millimetres from the working base; each by its
    board.
    """
    placed = np.empty_like(of_mm)
    for board, place in enumerate(maps):
        placed[hits.board == board] = place.apply(of_mm[hits.board == board])
    return placed


def positioning_axes(machine: Machine) -> tuple[int, int]:
    """The indexes of X and Y. Raises JobError where a machine does not position a board with them."""
    x, y = machine.axis_index("x"), machine.axis_index("y")
    if x is None or y is None or {x, y} & set(machine.drill_axes):
        heads = ", ".join(machine.axis_names[index] for index in machine.drill_axes)
        raise JobError(
            Message("a board needs axes x and y beside the drilling ones ({heads})", heads=heads).at(machine.name)
        )
    return x, y


def _hits(drill_file: "DrillFile", mill: bool) -> Hits:
    """Holes and slots, merged in the order of the file: a slot is milled from its beginning to its end, or a chain."""
    slots = drill_file.slot_mm.reshape(-1, 2, 2)
    chains = [each[:1] if mill else _chain(drill_file, index) for index, each in enumerate(slots)]
    counts = [len(chain) for chain in chains]
    at = np.concatenate([np.arange(len(drill_file.hole_xy_mm)) + 0.5, np.repeat(drill_file.slot_at, counts)])
    xy_mm = np.concatenate([drill_file.hole_xy_mm, *chains])
    tool = np.concatenate([drill_file.hole_tool, np.repeat(drill_file.slot_tool, counts)]).astype(np.int64)
    line = np.concatenate([drill_file.hole_line, np.repeat(drill_file.slot_line, counts)]).astype(np.int64)
    end_mm = np.concatenate([drill_file.hole_xy_mm, *(slots[:, 1:] if mill else chains)])
    return Hits(xy_mm, end_mm, tool, line, np.zeros(len(tool), np.int64)).take(np.argsort(at, kind="stable"))


def _chain(drill_file: "DrillFile", index: int) -> Floats:
    """A slot as holes from end to end, evenly apart."""
    start, end = drill_file.slot_mm[index].reshape(2, 2)
    diameter_mm = drill_file.tools[int(drill_file.slot_tool[index])].diameter_mm or CHAIN_DRILL_MM
    pieces = max(1, int(np.ceil(np.hypot(*(end - start)) / (diameter_mm * CHAIN_PITCH))))
    along: Floats = np.linspace(0.0, 1.0, pieces + 1)[:, None]
    return start + along * (end - start)


def _chosen(drill_file: "DrillFile", hits: Hits, settings: WorkSettings) -> Hits:
    """Without the tools to skip. Raises JobError for a skipped tool that is not there, or when nothing is left."""
    numbers = np.array([tool.number for tool in drill_file.tools], np.int64)
    unknown = settings.skip_tools - set(numbers.tolist())
    if unknown:
        there = ", ".join(f"T{number}" for number in numbers.tolist())
        raise JobError(
            Message(
                "tools to skip: {file} has no tool T{number}; there are {tools}",
                file=drill_file.name,
                number=min(unknown),
                tools=there,
            )
        )
    skipped = np.isin(hits.tool, np.flatnonzero(np.isin(numbers, list(settings.skip_tools))))
    left = hits.take(~skipped)
    if not len(left.xy_mm):
        raise JobError(Message("there is no hole to drill").at(drill_file.name))
    return left


def _on_every_board(hits: Hits, count: int) -> Hits:
    repeated = hits.take(np.tile(np.arange(len(hits.tool)), count))
    return replace(repeated, board=np.repeat(np.arange(count), len(hits.tool)))


def _groups(drill_file: "DrillFile", hits: Hits, settings: WorkSettings) -> tuple[Group, ...]:
    used, starts = np.unique(hits.tool, return_index=True)
    bounds = [*starts.tolist(), len(hits.tool)]
    tools = [drill_file.tools[index] for index in used.tolist()]
    drills: list[Drill | None] = [None] * len(tools)
    if settings.drills is not None:
        pairs = [(tool.number, tool.diameter_mm) for tool in tools]
        if problems := list(drill_problems(settings.drills, pairs, drill_file.name)):
            raise JobError(*problems)
        drills = [settings.drills.serving(tool.diameter_mm or 0.0) for tool in tools]
    return tuple(
        Group(tool.number, tool.diameter_mm, bounds[index], bounds[index + 1], drills[index])
        for index, tool in enumerate(tools)
    )


def approaches(steps: Integers, ends: Integers, here: Integers, backlash_steps: Integers) -> Integers:
    """Where to go first, so that the last motion of each axis is forward: (n, 2), the hole itself where it is so;
    ``ends`` (n, 2): where each is left.
    """
    came_from = np.concatenate([here[None], ends[:-1]])
    return steps - np.where(steps < came_from, backlash_steps, 0)


def backlash_of(machine: Machine) -> Integers:
    """(2,): the backlash of X and Y, in steps."""
    return np.array([machine.axes[axis].backlash_steps for axis in positioning_axes(machine)])


def _order(
    groups: tuple[Group, ...],
    steps: Integers,
    ends: Integers,
    settings: WorkSettings,
    machine: Machine,
    budget: Budget,
    advance: Advance,
) -> NDArray[np.intp]:
    """Rows of ``steps`` in drilling order; the head starts at the working base and goes back there."""
    backlash, base = backlash_of(machine), np.zeros(2, np.int64)
    reach = np.ptp(np.concatenate([base[None], steps, ends]), axis=0) + backlash
    axes = positioning_axes(machine)
    travel = TravelCost(*(_travel(machine, axis, int(longest)) for axis, longest in zip(axes, reach, strict=True)))
    parts = [steps[group.start : group.stop] for group in groups]
    passes = [ends] if settings.spot_mm is None else [steps, ends]  # a spot is left where it is made

    def cost(orders: list[Integers]) -> int:
        rows = [(group.start + order, left) for group, order in zip(groups, orders, strict=True) for left in passes]
        begun, left = (np.concatenate(each) for each in
                       ([steps[row] for row, _ in rows], [left[row] for row, left in rows]))  # fmt: skip
        return driven_ticks(begun, left, backlash, travel)

    orders = plan_groups(parts, travel, settings.order, base, base, cost=cost, budget=budget, advance=advance)
    return np.concatenate([group.start + order for group, order in zip(groups, orders, strict=True)])


def driven_ticks(holes: Integers, ends: Integers, backlash_steps: Integers, travel: TravelCost) -> int:
    """Ticks of the moves from the base to these holes and back, each left at its end; those that take up backlash
    among them, and the milling not.
    """
    base = np.zeros((1, 2), np.int64)
    before = approaches(holes, ends, base[0], backlash_steps)
    there = travel.between(np.concatenate([base, ends[:-1]]), before)
    taken_up = np.where((before != holes).any(axis=1), travel.between(before, holes), 0)
    return int((there + taken_up).sum() + travel.between(ends[-1:], base).sum())


def _travel(machine: Machine, axis: int, longest_steps: int) -> Integers:
    table = machine.axes[axis]
    return travel_table(table.ramp, longest_steps, columns_per_step=table.columns_per_step)


def _check_reach(
    drill_file: "DrillFile", hits: Hits, steps: Integers, base_steps: tuple[int, int], machine: Machine
) -> None:
    """``steps`` and what is told of them count from the working base."""
    reach = np.array([_reach(machine, axis) for axis in positioning_axes(machine)]) - np.array([base_steps]).T
    outside = (steps < reach[:, 0]) | (steps > reach[:, 1])
    problems = []
    for hole in np.flatnonzero(outside.any(axis=1)).tolist():
        listed = "; ".join(
            Counted(
                "{axis} {count} step is outside {low}..{high}",
                "{axis} {count} steps is outside {low}..{high}",
                int(steps[hole, k]),
                axis="XY"[k],
                low=reach[k, 0],
                high=reach[k, 1],
            )
            for k in (0, 1)
            if outside[hole, k]
        )
        x_mm, y_mm = hits.xy_mm[hole]
        problems.append(
            Message(
                "hole of tool T{number} at X{x:.4f} Y{y:.4f} mm is out of reach of {machine}: {axes}",
                number=drill_file.tools[hits.tool[hole]].number,
                x=x_mm,
                y=y_mm,
                machine=machine.name,
                axes=listed,
            ).at(drill_file.name, int(hits.line[hole]) or None)  # a pin stands in no line
        )
    if problems:
        raise JobError(*problems)


def _reach(machine: Machine, axis: int) -> tuple[int, int]:
    """Short of the limit sensors, and with room to come from below where there is backlash to take up."""
    low, high = machine.reach(axis)
    return low + machine.axes[axis].backlash_steps, high

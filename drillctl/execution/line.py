"""Axes linked in a straight line: the axis with the farthest to go runs its automaton, the others follow it.

Rule: integer DDA (Bresenham); after the leader's last step every follower stands on its target too.
Created once by the controller; started by commands, carried by the leading axis.
"""

from drillctl.execution.axis import Axis


class Line:
    """The one line of a controller. The lists are by axis: reach in steps, the DDA's error, part in this step."""

    __slots__ = ("axes", "error", "joins", "lead_reach", "leader", "reach")

    def __init__(self, axes: tuple[Axis, ...]):
        self.axes = axes
        self.leader = axes[0]
        self.lead_reach = 0
        self.reach = [0] * len(axes)
        self.error = [0] * len(axes)
        self.joins = [False] * len(axes)

    def start(self, leader: Axis, mask: int, min_interval: int) -> None:
        """All axes of the mask rest, with their new targets set; the leader begins to count."""
        self.leader = leader
        self.lead_reach = abs(leader.target - leader.position)
        for index, axis in enumerate(self.axes):
            self.reach[index] = abs(axis.target - axis.position) if mask >> index & 1 else 0
            self.error[index] = 0
            self.joins[index] = False
            axis.follower = self.reach[index] > 0 and axis is not leader
            if axis.follower:
                axis.set_direction(1 if axis.target > axis.position else -1)
        leader.line = self
        leader.set_target(leader.target, min_interval)

    def carry(self) -> None:
        """Before each column of the leader: the followers that take part in this step put theirs out."""
        if self.leader.column_in_step == 0:
            self._choose()
        for index, axis in enumerate(self.axes):
            if self.joins[index]:
                axis.put_column()

    def rest(self) -> None:
        """The leader has come to rest: forcing goes off everywhere; at its target (or given up) the line ends."""
        over = self.leader.position == self.leader.target
        for axis in self.axes:
            if axis.follower:
                axis.cooling = True
                axis.follower = not over
                axis.target = axis.position if over else axis.target
        if over:
            self.leader.line = None

    def _choose(self) -> None:
        """A follower that sits a step out rests meanwhile: a flat line must not hold 24 V for long."""
        for index, axis in enumerate(self.axes):
            if not axis.follower:
                self.joins[index] = False
                continue
            error = self.error[index] + self.reach[index]
            join = 2 * error >= self.lead_reach
            self.joins[index] = join
            self.error[index] = error - self.lead_reach if join else error
            if not join:
                axis.cool()

"""Axes linked in a straight line: the axis with the farthest to go runs its automaton, the others follow it.

Rule: integer DDA (Bresenham); after the leader's last step every follower stands on its target too. No follower passes
its own speed or acceleration: the leader keeps to the interval that the quickest follower can have, and takes the ramp
of the follower that has the least acceleration for its share of the way. The first interval of a ramp tells that.
"""

from drillctl.execution.axis import Axis
from drillctl.execution.motion import FOLLOWER_SETTLING, SETTLING


class Line:
    """The one line of a controller; to its leader it is the axis's Followers. The lists are by axis: reach in steps,
    the DDA's error, whether it steps in this step of the leader.
    """

    __slots__ = ("axes", "error", "joins", "lead_reach", "leader", "own", "reach")

    def __init__(self, axes: tuple[Axis, ...]):
        self.axes = axes
        self.leader = axes[0]
        self.lead_reach = 0
        self.own = self.leader.ramp_tables()  # the leader's, while it has another's
        self.reach = [0] * len(axes)
        self.error = [0] * len(axes)
        self.joins = [False] * len(axes)

    def start(self, leader: Axis, mask: int, min_interval: int) -> None:
        """Starts a line of the axes in ``mask``, which rest and have their new targets; the leader begins to count."""
        self.leader, slowest = leader, leader
        self.lead_reach = need = abs(leader.target - leader.position)
        need *= leader.interval[0] ** 2  # an acceleration is as 2 / interval**2, and a follower has its share of it
        for index, axis in enumerate(self.axes):
            self.reach[index] = abs(axis.target - axis.position) if mask >> index & 1 else 0
            self.error[index] = 0
            self.joins[index] = False
            if self.reach[index] > 0 and axis is not leader:
                axis.follow(1 if axis.target > axis.position else -1)
                min_interval = max(min_interval, -(-_quickest(axis) * self.reach[index] // self.lead_reach))
                if self.reach[index] * axis.interval[0] ** 2 > need:
                    slowest, need = axis, self.reach[index] * axis.interval[0] ** 2
        if slowest is not leader:
            min_interval = max(min_interval, _quickest(leader))
        self.own = leader.ramp_tables()
        leader.take_ramp(*slowest.ramp_tables())
        leader.followers = self
        leader.set_target(leader.target, min_interval)

    def carry(self) -> None:
        """Before each column of the leader: the followers that take part in this step put theirs out."""
        if self.leader.column_in_step == 0:
            self._choose()
        for index, axis in enumerate(self.axes):
            if self.joins[index]:
                axis.put_column()

    def rest(self) -> None:
        """The leader has come to rest: the followers' forcing goes off. At its target, or stopped, the line ends."""
        over = self.leader.position == self.leader.target
        for axis in self.axes:
            if axis.follows:
                axis.motion = SETTLING if over else FOLLOWER_SETTLING
                axis.target = axis.position if over else axis.target
        if over:
            self.leader.followers = None
            self.leader.take_ramp(*self.own)

    def _choose(self) -> None:
        """A follower that sits a step out rests meanwhile: a flat line must not hold 24 V for long."""
        for index, axis in enumerate(self.axes):
            if not axis.follows:
                self.joins[index] = False
                continue
            error = self.error[index] + self.reach[index]
            join = 2 * error >= self.lead_reach
            self.joins[index] = join
            self.error[index] = error - self.lead_reach if join else error
            if not join:
                axis.cool()


def _quickest(axis: Axis) -> int:
    """The least interval of an axis, whichever way it goes."""
    top = axis.ramp.top
    return max(axis.interval[top], axis.interval[-top])

"""How far the holes of a board are: drilled, in work, failed. Seen from outside, view by view.

Rule: a function of the views alone. A hole has failed where a fault came while it was in work; it stays so until the
board is begun anew or the hole is drilled after all.
"""

from typing import NamedTuple

from drillctl.viewmodel.console import BoardView, MachineView
from drillctl.viewmodel.records import Progress


class Work(NamedTuple):
    """``done`` holes are drilled, in drilling order; ``current`` and ``failed``: index of the hole, None for none."""

    done: int = 0
    current: int | None = None
    failed: int | None = None


class BoardWork:
    """Follows the job of the board that is loaded."""

    def __init__(self) -> None:
        self.work = Work()
        self._board: BoardView | None = None

    def see(self, view: MachineView, board: BoardView | None, progress: Progress | None) -> Work:
        """Takes the newest views; a job of another number of holes is not the board's."""
        ours = board is not None and progress is not None and progress.holes_total == len(board.xy_mm)
        done = progress.holes_done if ours and progress else 0
        before = self.work if board is self._board and done >= self.work.done else Work()
        running = bool(ours and view.command) and board is not None and done < len(board.xy_mm)
        failed = before.failed if before.failed is not None and before.failed >= done and not running else None
        if view.fault is not None and before.current is not None:
            failed, running = before.current, False
        self._board, self.work = board, Work(done, done if running else None, failed)
        return self.work

"""How submissions of a lab sheet were judged. Made by lab/grading.py, printed by ui/terminal/grades.py."""

import msgspec


class Check(msgspec.Struct, frozen=True):
    """How one check of a sheet went; ``why`` is a sentence, empty where it passed."""

    name: str
    passed: bool
    why: str = ""


class SubmissionGrade(msgspec.Struct, frozen=True):
    """How a submission was judged, check by check; ``name`` is that of its folder."""

    name: str
    checks: tuple[Check, ...]

    @property
    def points(self) -> int:
        """How many checks passed."""
        return sum(check.passed for check in self.checks)

    @property
    def passed(self) -> bool:
        """Whether every check passed."""
        return self.points == len(self.checks)

    @property
    def why(self) -> str:
        """Why not all passed, a sentence for each that did not."""
        return "; ".join(f"{check.name}: {check.why}" for check in self.checks if not check.passed)

"""Random boards in every way of declaring: right, told or refused (long run: benchmarks/drillfile_boards.py)."""

from collections import Counter
from types import ModuleType

import pytest

from tests.support.scripts import script


@pytest.fixture(scope="module")
def boards() -> ModuleType:
    return script("benchmarks/drillfile_boards.py")


def test_no_board_is_silently_wrong(boards: ModuleType) -> None:
    verdicts = boards.campaign(150, 7)
    counts = Counter(verdict.outcome for verdict in verdicts)
    assert not counts["silent"], [verdict.text for verdict in verdicts if verdict.outcome == "silent"]
    assert counts["right"] >= 0.97 * len(verdicts)
    sure = [verdict for verdict in verdicts if (verdict.confidence or 0) >= 0.98]
    assert sum(verdict.outcome == "right" for verdict in sure) >= 0.98 * len(sure)


def test_the_format_has_a_rule_and_it_holds(boards: ModuleType) -> None:
    declared = ("units and zeros", "decimal points")
    verdicts = [verdict for verdict in boards.campaign(150, 8) if verdict.way.case in declared]
    assert len(verdicts) > 30 and {verdict.outcome for verdict in verdicts} == {"right"}


def test_the_judge_sees_a_wrong_board(boards: ModuleType) -> None:
    way = boards.Way("mm", (3, 3), "leading", "word", "mask", "word")
    text, places = boards.compose([(10.0, 10.0, 0.8), (50.0, 20.0, 0.8)], way)
    found = boards.decode(text, name="board.drl")
    assert boards.outcome(found, places) == "right"
    assert boards.outcome(found, [(x * 10, y * 10) for x, y in places]) == "silent"

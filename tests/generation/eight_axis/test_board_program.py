"""A board's program on a production drill: speeds, tools by diameter and life, changes step by step, the stroke."""

from dataclasses import replace

import numpy as np
import pytest

from drillctl.generation.eight_axis.feeds import interval_of
from drillctl.generation.eight_axis.magazine import EMPTY, Magazine, full_magazine
from drillctl.generation.eight_axis.program import board_program
from drillctl.generation.eight_axis.tools import Stretch, stretches
from drillctl.generation.eight_axis.transfers import transfers
from drillctl.generation.errors import JobError
from drillctl.generation.job import names_of
from drillctl.generation.sequences import Records, asked_changes, drill_up, tool_changes
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import Group, WorkList, build
from drillctl.kmd import Op, program_texts
from drillctl.machine import Library, Machine
from drillctl.machine.parameters import ParameterRow
from drillctl.machine.tool_change import IN_TURN
from tests.generation.test_worklist import drill_file

MANUAL = Library.standard().machine("eight-axis")
assert MANUAL.parameters is not None and MANUAL.tool_changer is not None
BOARD = "T1\nX10Y10\nX20Y10\nT2\nX20Y20"  # 0.8 and 1.0 mm


def with_tools(*rows: dict[str, object], automatic: bool = True, order: str = "together") -> Machine:
    """The machine with these tools: number, diameter_mm, hits_left, magazine_place; the rest as the shipped ones."""
    assert MANUAL.parameters is not None and MANUAL.tool_changer is not None
    common = {"kind": "DRILL", "lift_mm_min": 2400.0, "feed_mm_min": 600.0, "offset_mm": 0.05, "life_hits": 5000,
              "spindle_rev_min": 30000, "hits_left": 5000}  # fmt: skip
    tools = tuple(ParameterRow(tuple({**common, **row}.items())) for row in rows)  # type: ignore[arg-type]
    machining = dict(MANUAL.parameters.machining.values) | {"tool_change": "AUTOMATIC" if automatic else "MANUAL"}
    parameters = replace(MANUAL.parameters, tools=tools, machining=ParameterRow(tuple(machining.items())))
    pitch_mm = 30.0 if order == IN_TURN else 90.0
    changer = replace(MANUAL.tool_changer, order=order, magazine_pitch_mm=pitch_mm)
    return replace(MANUAL, parameters=parameters, tool_changer=changer)


def tool(number: int, diameter_mm: float, **more: object) -> dict[str, object]:
    return {"number": number, "diameter_mm": diameter_mm, "magazine_place": number, **more}


AUTO = with_tools(tool(1, 0.8), tool(2, 1.0))


def work_on(machine: Machine, body: str = BOARD) -> WorkList:
    return build(drill_file(body), WorkSettings(), machine)


def program(machine: Machine, spindles: tuple[int, ...] = (1, 3), magazine: Magazine | None = None) -> Records:
    return board_program(work_on(machine), machine, WorkSettings(spindles=spindles), magazine)


def lines(machine: Machine, made: Records) -> list[str]:
    return list(program_texts(made, names_of(machine)))


def steps_of(made: Records) -> list[int]:
    return [int(number) for number in made["args"][made["opcode"] == Op.KROK, 0] if number]


def test_a_change_goes_through_the_23_steps_in_order() -> None:
    made = program(AUTO)
    assert steps_of(made) == [1, 2, *range(11, 24), *range(1, 24)]  # at first no tool is in the spindles
    assert len(tool_changes(made)) == 2 and not len(asked_changes(made))
    assert lines(AUTO, made)[-4:] == [
        "KMD_WIERTLO_DOM", "KMD_WYJSCIE presser_foot 0", "KMD_GOTO_X_Y 2000 48000", "KMD_KONIEC",
    ]  # fmt: skip


def test_spindles_that_change_in_turn_go_to_the_place_one_after_the_other() -> None:
    machine = with_tools(tool(1, 0.8), tool(2, 1.0), order=IN_TURN)
    made = program(machine, (1, 2))
    assert steps_of(made)[:16] == [1, 2, 11, 12, *range(13, 19), *range(13, 19)]
    text = lines(machine, made)
    # place 1 lies at X 100 mm; spindles are 90 mm apart and their bits 30 mm, so the second goes 60 mm less far
    assert [line for line in text if line.startswith("KMD_RUCH x=")][:3] == [
        "KMD_RUCH x=2000 y=48000", "KMD_RUCH x=10000", "KMD_RUCH x=4000",
    ]  # fmt: skip


def test_the_transfers_of_a_program_are_found_with_tool_place_and_spindles() -> None:
    made = program(AUTO)
    found = list(transfers(made, AUTO))
    assert [(m.transfer.kind, m.transfer.tool, m.transfer.place, m.transfer.spindles) for m in found] == [
        ("take", 1, 1, (1, 3)), ("leave", 1, 1, (1, 3)), ("take", 2, 2, (1, 3)),
    ]  # fmt: skip
    for moved in found:
        row = {"take": (16, 20), "leave": (6, 10)}[moved.transfer.kind]
        krok = [
            int(made["args"][np.flatnonzero(made["opcode"][:at] == Op.KROK)[-1], 0]) for at in (moved.begin, moved.end)
        ]
        assert tuple(krok) == row


def test_by_hand_the_machine_parks_and_asks_for_each_tool() -> None:
    machine = with_tools(tool(1, 0.8), tool(2, 1.0), automatic=False)
    made = program(machine)
    text = lines(machine, made)
    assert len(asked_changes(made)) == 2 and steps_of(made) == []
    asked = text.index("KMD_NARZEDZIE 1")
    assert text[asked - 4 : asked] == [
        "KMD_WRZECIONO 0", "KMD_WIERTLO_DOM", "KMD_WYJSCIE presser_foot 0", "KMD_GOTO_X_Y 2000 48000",
    ]  # fmt: skip


def test_a_tool_has_its_own_speeds_and_the_heads_lift_by_the_working_stroke() -> None:
    text = lines(AUTO, program(AUTO))
    assert "KMD_WRZECIONO 30000" in text
    assert "KMD_SUW z1=3400 z3=3400" in text  # 6 mm above 40 mm
    assert "KMD_WIERTLO_DOL z1=4 z3=4" in text and "KMD_GORA_X_Y 1000 0 z1=1 z3=1" in text


@pytest.mark.parametrize(
    ("rows", "holes", "wanted"),
    [
        ([tool(1, 0.8)], 9, [(9, 1, False)]),
        ([tool(1, 0.8, hits_left=4), tool(7, 0.8)], 9, [(4, 1, False), (9, 7, False)]),
        ([tool(1, 0.8, hits_left=4)], 9, [(4, 1, False), (9, 1, True)]),
        ([tool(1, 0.8, hits_left=0, life_hits=4)], 9, [(4, 1, True), (8, 1, True), (9, 1, True)]),
        ([tool(1, 0.3), tool(5, 0.82), tool(6, 0.81)], 9, [(9, 6, False)]),  # the nearest
    ],
)
def test_a_sister_goes_on_where_a_life_is_used_up_and_else_an_operator_is_asked(
    rows: list[dict[str, object]], holes: int, wanted: list[tuple[int, int, bool]]
) -> None:
    machine = with_tools(*rows)
    found = list(stretches(Group(1, 0.8, 0, holes), machine, (1,), full_magazine(machine)))
    assert [(each.stop, each.tool, each.renewed) for each in found] == wanted
    assert [each.start for each in found] == [0, *(each.stop for each in found[:-1])]


def test_by_hand_a_tool_that_the_machine_does_not_know_is_asked_for() -> None:
    machine = with_tools(tool(1, 0.3), automatic=False)
    assert list(stretches(Group(1, 0.8, 0, 9), machine, (1,), full_magazine(machine))) == [Stretch(0, 9, None)]


@pytest.mark.parametrize("there", [False, None])
def test_a_tool_whose_place_is_empty_or_unknown_is_not_taken(there: bool | None) -> None:
    magazine = full_magazine(AUTO).with_bits(1, [3], there)
    with pytest.raises(JobError, match=r"no tool of the magazine serves tool T1 \(0.800 mm\)"):
        program(AUTO, (1, 3), magazine)
    assert len(program(AUTO, (1, 2), magazine))  # another spindle's bit


def test_a_tool_that_the_spindles_hold_already_is_not_changed() -> None:
    magazine = full_magazine(AUTO).with_chucks((1, 3), 1).with_bits(1, (1, 3), False)
    assert steps_of(program(AUTO, (1, 3), magazine)) == list(range(1, 24))


def test_spindles_that_hold_different_tools_leave_them_first() -> None:
    magazine = full_magazine(AUTO).with_chucks((3,), 2).with_bits(2, (3,), False)
    moved = [each.transfer for each in transfers(program(AUTO, (1, 3), magazine), AUTO)]
    assert [(each.kind, each.tool, each.spindles) for each in moved][:2] == [("leave", 2, (3,)), ("take", 1, (1, 3))]


def test_a_chuck_that_nobody_knows_is_refused_by_the_number_of_its_spindle() -> None:
    with pytest.raises(JobError, match="what the chucks of spindles 3 hold"):
        program(AUTO, (1, 3), full_magazine(AUTO).with_chucks((3, 5), None))


def test_the_record_knows_nothing_of_a_transfer_that_was_begun_and_not_confirmed() -> None:
    made = full_magazine(AUTO)
    take = next(transfers(program(AUTO), AUTO)).transfer
    begun = made.begun(take)
    assert begun.unknown() == ([1, 3], [(1, 1), (1, 3)])
    ended = begun.ended(take)
    assert [ended.chucks[n] for n in (1, 2, 3)] == [1, EMPTY, 1] and ended.unknown() == ([], [])


def test_life_is_counted_from_the_parameter_and_anew_once_renewed() -> None:
    machine = with_tools(tool(1, 0.8, hits_left=10, life_hits=50))
    made = full_magazine(machine).hit(1, 4)
    assert made.hits_left(machine, 1) == 6
    assert made.broken(1).hits_left(machine, 1) == 0
    assert made.broken(1).renew(1).hit(1, 5).hits_left(machine, 1) == 45


@pytest.mark.parametrize(("mm_min", "ticks"), [(2400, 1), (1200, 2), (300, 8), (302, 8), (295, 8)])
def test_a_feed_is_kept_within_2_percent(mm_min: float, ticks: int) -> None:
    assert interval_of(MANUAL, 2, mm_min, "feed_mm_min") == ticks


@pytest.mark.parametrize(("mm_min", "slower", "faster"), [(900, "800.0", "1200.0"), (3000, "1200.0", "2400.0")])
def test_a_feed_that_the_tick_rate_can_not_give_is_refused_with_the_nearest(
    mm_min: float, slower: str, faster: str
) -> None:
    with pytest.raises(JobError, match=f"lift_mm_min: {mm_min} mm/min .* nearest are {slower} and {faster}"):
        interval_of(MANUAL, 2, mm_min, "lift_mm_min")


def test_a_dry_run_changes_no_tool_and_keeps_the_heads_all_the_way_up() -> None:
    text = lines(AUTO, drill_up(program(AUTO)))
    assert not [line for line in text if line.startswith(("KMD_KROK", "KMD_SUW", "KMD_RUCH", "KMD_NARZ", "KMD_CZEKAJ"))]
    assert not [line for line in text if "chuck" in line or "WIERTLO_DOL" in line]
    assert len([line for line in text if line.startswith(("KMD_GOTO_X_Y", "KMD_GORA_X_Y"))]) >= 3

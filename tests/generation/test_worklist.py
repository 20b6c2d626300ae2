"""Drill file to work list to program: tools, slots, panels, reach, backlash, pecks, drills."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from drillctl.generation.drillfile import DrillFile, decode
from drillctl.generation.drills import DrillTable, read_drills
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.pcb_drill.program import board_program
from drillctl.generation.placing import Panel, Placing
from drillctl.generation.queues import queue_text
from drillctl.generation.readers import load_job
from drillctl.generation.sequences import holes
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import build
from drillctl.kmd import Op
from drillctl.machine import Library, Machine
from drillctl.viewmodel.job_options import JobOptions

PCB = Library.standard().machine("pcb-drill")
HEADER = "M48\nMETRIC\nT1C0.800\nT2C1.000\n%\n"


def drill_file(body: str) -> DrillFile:
    """Whole millimetres written with a point, so that nothing has to be guessed."""
    text = re.sub(r"([XY])(-?\d+)(?![\d.])", r"\1\2.0", body)
    return decode((HEADER + text + "\nM30\n").encode(), name="board.drl")


def ops(machine: Machine, body: str, settings: WorkSettings) -> list[Op]:
    program = board_program(build(drill_file(body), settings, machine), machine, settings)
    return [Op(op) for op in program["opcode"].tolist()]


SQUARE = "T1\nX10Y10\nX20Y10\nT2\nX20Y20\nT1\nX10Y20"


def test_holes_are_grouped_by_tool_and_keep_the_files_order_within() -> None:
    work = build(drill_file(SQUARE), WorkSettings(), PCB)
    assert [(g.number, g.start, g.stop) for g in work.groups] == [(1, 0, 3), (2, 3, 4)]
    assert work.hits.xy_mm.tolist() == [[10, 10], [20, 10], [10, 20], [20, 20]]


def test_the_lowest_corner_lies_at_the_base_and_steps_are_rounded() -> None:
    work = build(drill_file(SQUARE), WorkSettings(), PCB)
    assert work.steps.tolist() == [[0, 0], [472, 0], [0, 472], [472, 472]]


def test_origin_file_takes_coordinates_as_they_are() -> None:
    work = build(drill_file(SQUARE), WorkSettings(Placing(origin="file")), PCB)
    assert work.steps[0].tolist() == [round(10 / 25.4 * 1200)] * 2


def test_a_slot_becomes_a_chain_in_its_place() -> None:
    work = build(drill_file("T1\nX0Y0\nX10Y0G85X14Y0\nX0Y5"), WorkSettings(), PCB)
    chain = work.hits.xy_mm[1:-1]
    assert chain[0].tolist() == [10, 0] and chain[-1].tolist() == [14, 0]
    assert np.diff(chain[:, 0]).max() <= 0.4 + 1e-9
    assert work.hits.xy_mm[-1].tolist() == [0, 5]


def test_unreachable_holes_are_all_named_with_their_lines() -> None:
    with pytest.raises(JobError) as caught:
        build(drill_file("T1\nX0Y0\nX360Y0\nT2\nX10Y300\nX400Y400"), WorkSettings(), PCB)
    lines = caught.value.messages
    assert [line.partition(": ")[0] for line in lines] == ["board.drl:8", "board.drl:10", "board.drl:11"]
    assert "X360.0000 Y0.0000 mm is out of reach of pcb-drill: X 17008 steps is outside 0..16528" in lines[0]
    assert "X 18898" in lines[2] and "Y 18898" in lines[2]


def test_a_long_list_of_unreachable_holes_is_cut_in_print_only() -> None:
    body = "T1\n" + "\n".join(f"X{400 + n}Y0" for n in range(80)) + "\nX0Y0"
    with pytest.raises(JobError) as caught:
        build(drill_file(body), WorkSettings(), PCB)
    assert len(caught.value.messages) == 80
    assert str(caught.value).splitlines()[-1] == "and 30 more"


def test_a_machine_that_drills_along_y_takes_no_board() -> None:
    with pytest.raises(JobError, match="boiler-drum: a board needs axes x and y beside the drilling ones"):
        build(drill_file(SQUARE), WorkSettings(), Library.standard().machine("boiler-drum"))


def test_skipped_tools_are_left_out_and_unknown_ones_refused() -> None:
    work = build(drill_file(SQUARE), WorkSettings(skip_tools=frozenset({1})), PCB)
    assert [g.number for g in work.groups] == [2]
    with pytest.raises(JobError, match="has no tool T7; there are T1, T2"):
        build(drill_file(SQUARE), WorkSettings(skip_tools=frozenset({7})), PCB)
    with pytest.raises(JobError, match="no hole to drill"):
        build(drill_file(SQUARE), WorkSettings(skip_tools=frozenset({1, 2})), PCB)


def test_a_panel_repeats_the_board_tool_by_tool() -> None:
    work = build(drill_file(SQUARE), WorkSettings(Placing(panel=Panel(2, 1, 30.0, 0.0))), PCB)
    assert [(g.number, g.stop - g.start) for g in work.groups] == [(1, 6), (2, 2)]
    assert work.hits.board.tolist() == [0, 0, 0, 1, 1, 1, 0, 1]
    job = Job("b", board_program(work, PCB, WorkSettings()), PCB, work)
    shift_steps = round(30 / 25.4 * 1200)
    made = job.made_hole(0, 4, (float(shift_steps), 0.0, 0.0), 2)
    assert (made.x_mm, made.y_mm) == pytest.approx((10.0, 10.0), abs=0.011)


def test_order_by_machine_time_is_no_longer_than_the_files() -> None:
    body = "T1\n" + "\n".join(f"X{x}Y{y}" for x, y in [(0, 0), (90, 80), (1, 1), (89, 79), (2, 0), (91, 81)])
    ticks = {}
    for order in ("file", "nearest", "optimised"):
        steps = build(drill_file(body), WorkSettings(order=order), PCB).steps
        ticks[order] = np.abs(np.diff(steps, axis=0, prepend=0, append=0)).max(axis=1).sum()  # to the base and back
    assert ticks["optimised"] <= ticks["nearest"] < ticks["file"]


def test_program_initialises_drills_and_comes_back() -> None:
    assert ops(PCB, "T1\nX1Y1", WorkSettings()) == [
        Op.INICJALIZACJA, Op.NARZEDZIE, Op.GOTO_X_Y, Op.WIERTLO_DOL, Op.WIERTLO_GORA, Op.GOTO_X_Y, Op.KONIEC,
    ]  # fmt: skip


def test_the_spindle_of_a_machine_that_has_one_is_on_while_drilling() -> None:
    machine = Library.standard().machine("eight-axis")
    work = build(drill_file("T1\nX1Y1\nT2\nX2Y1"), WorkSettings(), machine)
    program = board_program(work, machine, WorkSettings())
    found = [Op(op) for op in program["opcode"]]
    level, levels = 0, []
    for op, args in zip(found, program["args"].tolist(), strict=True):
        level = args[1] if op is Op.WYJSCIE else level
        levels.append(level)
    of = {op: {levels[at] for at, other in enumerate(found) if other is op} for op in found}
    assert of[Op.NARZEDZIE] == {0}, "nobody changes a tool that turns"
    assert of[Op.WIERTLO_DOL] == of[Op.WIERTLO_GORA] == {1} and levels[-1] == 0
    for at in (at for at, op in enumerate(found) if op is Op.NARZEDZIE):
        assert found[at + 1 : at + 3] == [Op.WYJSCIE, Op.CZEKAJ], "on, and time to spin up"
        assert program["args"][at + 2, 0] == machine.configuration.spin_up_s * machine.tick_hz > 0


@pytest.mark.parametrize("backlash", [0, 7])
def test_where_the_bits_are_clear_is_known_the_way_to_the_next_hole_begins_during_the_lift(backlash: int) -> None:
    """Between the holes of a tool; the hole's number stays with its stroke. The same places are drilled in the same
    order as one after the other.
    """
    axes = tuple(replace(axis, backlash_steps=backlash) for axis in PCB.axes)
    body, plain = "T1\nX1Y1\nX3Y2\nX2Y1\nT2\nX2Y9", replace(PCB, axes=axes)
    clear = replace(plain, drill_clear_steps=500)
    settings = WorkSettings(base_steps=(9, 9))
    programs = [board_program(build(drill_file(body), settings, m), m, settings) for m in (plain, clear)]
    ups = programs[1][np.isin(programs[1]["opcode"], [Op.WIERTLO_GORA, Op.GORA_X_Y])]
    assert [(Op(up["opcode"]), int(up["tag"])) for up in ups] == [
        (Op.GORA_X_Y, 1), (Op.GORA_X_Y, 2), (Op.WIERTLO_GORA, 3), (Op.WIERTLO_GORA, 4),
    ]  # fmt: skip
    places = [each["args"][np.isin(each["opcode"], [Op.GOTO_X_Y, Op.GORA_X_Y])][:, :2].tolist() for each in programs]
    assert places[0] == places[1]
    assert [len(ends) for _, ends in map(holes, programs)] == [4, 4]


def test_pecks_go_deeper_each_time_and_end_at_the_sensor() -> None:
    settings = WorkSettings(peck_mm=1.5)
    work = build(drill_file("T1\nX1Y1"), settings, PCB)
    program = board_program(work, PCB, settings)
    depths = program["args"][program["opcode"] == Op.RUCH][:, 2].tolist()
    surface, drawn = 600, 600 - round(0.5 / 25.4 * 1200)
    assert depths == [surface + 71, drawn, surface + 142, drawn]
    assert Op(program["opcode"][-4]) is Op.WIERTLO_DOL


def test_spots_come_before_the_drilling_of_a_tool() -> None:
    found = ops(PCB, "T1\nX1Y1\nX3Y1", WorkSettings(spot_mm=0.3))
    assert found.index(Op.WIERTLO_DOL) > max(i for i, op in enumerate(found) if op is Op.RUCH)


@pytest.mark.parametrize("depth_mm", [0.0, -1.0, 0.01, float("nan"), float("inf")])
def test_a_peck_that_never_ends_is_refused(depth_mm: float) -> None:
    with pytest.raises(JobError, match="peck depth"):
        WorkSettings(peck_mm=depth_mm)


def test_backlash_is_taken_up_by_coming_from_below() -> None:
    machine = replace(PCB, axes=(replace(PCB.axes[0], backlash_steps=12), *PCB.axes[1:]))
    settings = WorkSettings(Placing(offset_mm=(5.0, 5.0)))
    program = board_program(build(drill_file("T1\nX9Y0\nX0Y3\nX4Y3"), settings, machine), machine, settings)
    places = program["args"][program["opcode"] == Op.GOTO_X_Y][:, 0]
    moves = np.diff(places)
    downward = np.flatnonzero(moves[:-1] < 0)  # the way home apart
    assert len(downward) == 1 and moves[downward[0] + 1] == 12


def test_backlash_keeps_room_below_the_lowest_hole() -> None:
    machine = replace(PCB, axes=(replace(PCB.axes[0], backlash_steps=12), *PCB.axes[1:]))
    with pytest.raises(JobError, match=r"X 0 steps is outside 12\.\."):
        build(drill_file("T1\nX0Y0"), WorkSettings(), machine)


def drills(tmp_path: Path, text: str) -> DrillTable:
    (tmp_path / "drills.toml").write_text(text)
    return read_drills(tmp_path / "drills.toml")


def test_a_hole_is_served_by_the_nearest_drill_within_tolerance(tmp_path: Path) -> None:
    table = drills(tmp_path, "".join(f"[[drill]]\ndiameter_mm = {mm}\n" for mm in (0.75, 0.82, 1)))
    work = build(drill_file(SQUARE), WorkSettings(drills=table), PCB)
    assert [g.drill.diameter_mm if g.drill else None for g in work.groups] == [0.82, 1]


def test_a_tool_without_a_drill_is_refused_by_name(tmp_path: Path) -> None:
    table = drills(tmp_path, "tolerance_mm = 0.01\n[[drill]]\ndiameter_mm = 0.82\n[[drill]]\ndiameter_mm = 1\n")
    with pytest.raises(JobError, match=r"no drill serves tool T1 \(0\.800 mm\); the nearest is 0\.820 mm"):
        build(drill_file(SQUARE), WorkSettings(drills=table), PCB)


def test_a_worn_drill_is_warned_about(tmp_path: Path) -> None:
    worn = "[[drill]]\ndiameter_mm = 0.8\nlife_hits = 12\nused_hits = 10\n"
    drills(tmp_path, worn + "[[drill]]\ndiameter_mm = 1\n")
    (tmp_path / "board.drl").write_text(HEADER + SQUARE.replace("0", "0.0") + "\nM30\n")
    job = load_job(tmp_path / "board.drl", PCB, JobSetup("pcb-drill", JobOptions(drills=str(tmp_path / "drills.toml"))))
    assert any("T1 makes 3 holes; its drill is good for 2 more" in warning for warning in job.warnings)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "drill"),
        ("[[drill]]\ndiameter_mm = -1\n", "diameter_mm"),
        ("drill = 3", "drill"),
        ("= 3", "drills.toml:1: not TOML"),
    ],
)
def test_a_bad_drill_table_is_refused(tmp_path: Path, text: str, reason: str) -> None:
    with pytest.raises(JobError, match=reason):
        drills(tmp_path, text)


def test_a_queue_text_is_the_program(tmp_path: Path) -> None:
    (tmp_path / "board.drl").write_text(HEADER + SQUARE.replace("0", "0.0") + "\nM30\n")
    job = load_job(tmp_path / "board.drl", PCB, JobSetup("pcb-drill"))
    (tmp_path / "board.kmd").write_text(queue_text(job))
    again = load_job(tmp_path / "board.kmd", PCB, JobSetup("pcb-drill"))
    for field in ("opcode", "axes", "flags", "args"):
        assert np.array_equal(again.program[field], job.program[field])

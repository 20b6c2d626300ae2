"""Cuts of the router: the straight ones as slots for whoever mills, each in its place; the others are counted alone."""

from pathlib import Path

import pytest

import drillctl
from drillctl.cli import main
from drillctl.generation.drillfile import DrillFile, decode, milled

HEAD = "M48\nMETRIC\nT1C1.0\nT2C1.2\n%\nG90\nG05\nT1\nX5.0Y5.0\nX20.0Y5.0\n"
OVAL = "T2\nG00X10.0Y10.0\nM15\nG01X10.0Y12.0\nM16\nG05\n"  # as KiCad writes an oval hole
FRAME = "G00X0.0Y0.0\nM15\nG01X30.0\nY20.0\nX0.0\nY0.0\nM16\nG05\n"


def of(body: str) -> DrillFile:
    return decode((HEAD + body + "M30\n").encode(), name="board.drl")


def test_an_oval_hole_is_a_slot_for_whoever_mills() -> None:
    read = of(OVAL + "X25.0Y5.0\n")
    assert (read.routs, len(read.slot_mm)) == (1, 0) and read.bbox_mm == (5.0, 5.0, 25.0, 5.0)
    made = milled(read)
    assert made.slot_mm.tolist() == [[10.0, 10.0, 10.0, 12.0]] and made.slot_at.tolist() == [2]
    assert (made.tools[made.slot_tool[0]].number, made.slot_line.tolist(), made.routs) == (2, [14], 0)
    assert [each.code for each in read.warnings] == ["routs-not-drilled"] and not made.warnings


def test_a_cut_of_several_lines_is_a_slot_for_each() -> None:
    made = milled(of(OVAL + "X1.0Y1.0G85X3.0Y1.0\n" + FRAME))
    assert made.slot_mm.tolist() == [
        [10, 10, 10, 12], [1, 1, 3, 1], [0, 0, 30, 0], [30, 0, 30, 20], [30, 20, 0, 20], [0, 20, 0, 0],
    ]  # fmt: skip
    assert made.routs == 0 and made.slot_at.tolist() == [2] * 6


@pytest.mark.parametrize(
    "cut",
    [
        pytest.param("G00X0.0Y0.0\nM15\nG01X9.0\nG02X9.0Y9.0A4.5\nG01X0.0\nM16\nG05\n", id="an arc in it"),
        pytest.param("G00X0.0Y0.0\nM15\nG03X9.0Y9.0I4.5J4.5\nX0.0\nM16\nG05\n", id="arcs go on until another word"),
        pytest.param("G00X0.0Y0.0\nG41\nM15\nG01X9.0\nM16\nG40\nG05\n", id="beside the way, by the bit's radius"),
    ],
)
def test_what_is_not_straight_is_counted_alone(cut: str) -> None:
    read = of(cut + OVAL)
    assert (read.routs, milled(read).routs) == (2, 1)
    assert milled(read).slot_mm.tolist() == [[10.0, 10.0, 10.0, 12.0]]
    assert "routs-not-drilled" in [each.code for each in milled(read).warnings]


def test_no_cut_of_a_copied_pattern_is_milled() -> None:
    read = of("M25\nX1.0Y1.0\n" + OVAL + "M01\nM02X40.0Y0.0\nM02\n")
    assert (read.routs, milled(read).routs, len(milled(read).slot_mm)) == (1, 1, 0)


def test_cuts_before_any_tool_and_without_way_are_left() -> None:
    read = decode(b"M48\nMETRIC\nT1C1.0\n%\nG00X0.0Y0.0\nM15\nG01X5.0\nM16\nG05\nT1\nX1.0Y1.0\nM30\n", name="b.drl")
    assert (milled(read).routs, len(milled(read).slot_mm)) == (1, 0)


def test_incremental_cuts_and_inches_are_measured_alike() -> None:
    inches = decode(
        b"M48\nINCH\nT1C.04\n%\nG91\nT1\nG05X1.Y1.\nG00X1.0Y0.\nM15\nG01X0.Y.5\nM16\nG05\nM30\n", name="b.drl"
    )
    assert milled(inches).slot_mm.tolist() == [pytest.approx([50.8, 25.4, 50.8, 38.1])]


def test_written_anew_they_are_slots_that_any_reader_knows(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, out = tmp_path / "oval.drl", tmp_path / "slots.drl"
    file.write_text(HEAD + OVAL + "M30\n")
    assert main(["convert", str(file), "--to", str(out), "--mill", "-q"]) == 0
    assert "X10.0Y10.0G85X10.0Y12.0" in out.read_text()
    again = drillctl.inspect(out)
    assert again.routs == 0 and again.slot_mm.tolist() == [[10.0, 10.0, 10.0, 12.0]]
    for words, told in (["--mill"], "2 holes, 1 slots, 0 milled cuts"), ([], "2 holes, 0 slots, 1 milled cuts"):
        capsys.readouterr()
        assert main(["inspect", str(file), *words]) == 0 and told in capsys.readouterr().out


def test_a_file_of_cuts_alone_is_a_board_for_whoever_mills() -> None:
    read = decode(b"M48\nMETRIC\nT1C1.0\n%\nT1\nG00X1.0Y1.0\nM15\nG01X5.0\nM16\nG05\nM30\n", name="b.drl")
    assert [each.code for each in read.warnings] == ["routs-not-drilled", "no-holes"]
    assert not milled(read).warnings and len(milled(read).slot_mm) == 1


def test_a_board_with_them_is_milled_to_its_end(tmp_path: Path) -> None:
    file = tmp_path / "oval.drl"
    file.write_text(HEAD + OVAL + FRAME + "M30\n")
    plain, mills = drillctl.job(file, "cnc-shield"), drillctl.job(file, "cnc-shield", mill=True)
    assert (plain.holes_total, mills.holes_total) == (2, 7)
    assert any("milled cuts are not drilled" in warning for warning in plain.warnings) and not mills.warnings
    run = drillctl.run(mills)
    assert run.fault is None and run.outcome.holes_done == 7

"""Registration pins: both sides of a board that is turned over have them in the same places."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import drillctl
from drillctl.cli import main
from drillctl.generation.drillfile import decode
from drillctl.generation.pins import with_pins
from drillctl.generation.placing import Affine, Placing, PlacingError, transform
from drillctl.viewmodel.choices import PIN_PLACES
from drillctl.viewmodel.job_options import PinsOf

BOARD = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"  # 26 holes, T1 to T3, up to 3.2 mm
hundredths = st.integers(-20_000, 20_000)
boards = st.lists(st.tuples(hundredths, hundredths), min_size=1, max_size=12)
pins = st.builds(PinsOf, st.sampled_from([1.0, 3.0, 3.2]), st.sampled_from(PIN_PLACES), st.sampled_from([5.0, 7.5]))
sides = st.sampled_from(["x", "y"])
placed = st.fixed_dictionaries(
    {"origin": st.sampled_from([None, "base", "file"]), "rotate_deg": st.sampled_from([0.0, 90.0, 180.0, 270.0, 33.0])}
)


def drill_file(holes: list[tuple[int, int]]) -> Any:
    places = "\n".join(f"X{x / 100:.2f}Y{y / 100:.2f}" for x, y in holes)
    return decode(f"M48\nMETRIC\nT1C0.8\n%\nT1\n{places}\nM30\n".encode(), name="b.drl")


def both_sides(
    holes: list[tuple[int, int]], wanted: PinsOf, mirror: str, options: Any
) -> tuple[Any, Any, Affine, Affine]:
    """Places in the file of all holes and of the pins; the maps of the front and of the back."""
    file = with_pins(drill_file(holes), wanted).drill_file
    all_mm, pins_mm = file.hole_xy_mm, file.hole_xy_mm[file.hole_tool == len(file.tools) - 1]
    front, back = (transform(Placing(pinned=True, mirror=side, **options), all_mm) for side in (None, mirror))
    return all_mm, pins_mm, front, back


def as_set(places: Any) -> Any:
    return sorted(map(tuple, np.round(places, 6) + 0.0))


@given(boards, pins, sides, placed)
def test_turned_over_the_board_lands_on_the_same_pins(
    holes: list[tuple[int, int]], wanted: PinsOf, mirror: str, options: Any
) -> None:
    """The pins' places, as a set, are the same; and every hole is where turning the board over puts it."""
    all_mm, pins_mm, front, back = both_sides(holes, wanted, mirror, options)
    np.testing.assert_allclose(as_set(front.apply(pins_mm)), as_set(back.apply(pins_mm)), atol=2e-6)
    turned = front.inverse().then(back)  # of the bed, from the front's places to the back's
    assert np.linalg.det(turned.linear) == pytest.approx(-1)
    np.testing.assert_allclose(turned.then(turned).matrix, np.eye(2, 3), atol=1e-6)  # twice: as it lay
    np.testing.assert_allclose(turned.apply(front.apply(all_mm)), back.apply(all_mm), atol=1e-6)


@given(boards, pins, sides)
def test_nothing_lies_below_the_base_on_either_side(
    holes: list[tuple[int, int]], wanted: PinsOf, mirror: str
) -> None:
    all_mm, _, front, back = both_sides(holes, wanted, mirror, {"origin": "base"})
    for side in (front, back):
        np.testing.assert_allclose(side.apply(all_mm).min(axis=0), [0.0, 0.0], atol=1e-9)


@pytest.mark.parametrize(
    ("where", "count"), [("corners", 4), ("left-right", 2), ("top-bottom", 2)],
)  # fmt: skip
def test_pins_have_a_tool_of_their_own_outside_all_holes(where: Any, count: int) -> None:
    file = drillctl.inspect(BOARD)
    pinned, tool = with_pins(file, PinsOf(3.0, where, 8.0))
    assert (tool, pinned.tools[-1].diameter_mm) == (4, 3.0) and pinned.tools[:3] == file.tools
    added = pinned.hole_xy_mm[len(file.hole_xy_mm) :]
    assert len(added) == count
    apart = np.hypot(*(added[:, None] - file.hole_xy_mm[None]).transpose(2, 0, 1))
    assert apart.min() >= 8.0


@pytest.mark.parametrize("where", PIN_PLACES)
@pytest.mark.parametrize("mirror", ["x", "y"])
def test_the_front_drills_the_pins_and_the_back_finds_them(mirror: str, where: Any) -> None:
    """In steps of the machine: each hole of the back is the front's, turned over about the pins' middle."""
    front = drillctl.job(BOARD, pins=(3.0, where, 6.0))
    back = drillctl.job(BOARD, pins=(3.0, where, 6.0), mirror=mirror)
    assert front.work is not None and back.work is not None
    assert [group.number for group in front.work.groups] == [1, 2, 3, 4]
    assert [group.number for group in back.work.groups] == [1, 2, 3]
    pins_at = front.work.steps[front.work.groups[-1].start :]
    axis = "xy".index(mirror)
    middle = (pins_at[:, axis].min() + pins_at[:, axis].max()) / 2
    turned = front.work.steps[: front.work.groups[-1].start].astype(float)
    turned[:, axis] = 2 * middle - turned[:, axis]
    assert np.abs(turned - back.work.steps).max() <= 1  # rounded to steps on each side


@pytest.mark.parametrize(
    ("given_pins", "told"),
    [(PinsOf(3.0, "corners", 3.0), "a margin of 3.1 mm or more"), (PinsOf(0.01), "from 0.1 to 50 mm"),
     (PinsOf(3.0, "corners", float("nan")), "a margin of")],
)  # fmt: skip
def test_pins_that_can_not_be_are_refused(given_pins: PinsOf, told: str) -> None:
    with pytest.raises(PlacingError, match=told):
        with_pins(drillctl.inspect(BOARD), given_pins)


@pytest.mark.parametrize("text", ["3", "3:corners", "3:corners:5", "3:5"])
def test_what_is_left_out_of_an_option_has_a_default(text: str) -> None:
    assert str(PinsOf.typed(text)) == "3:corners:5"


@pytest.mark.parametrize("text", ["", "x", "3:middle", "3:corners:5:1", "-3", "3:corners:-1", "nan"])
def test_what_is_no_option_is_no_pins(text: str) -> None:
    with pytest.raises(ValueError, match="is not MM:WHERE:MM"):
        PinsOf.typed(text)


def test_verbs_take_them_alike(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: Any) -> None:
    """The Excellon file has the pins as holes, so another program sees the same board; a journal keeps them."""
    monkeypatch.chdir(tmp_path)
    out = tmp_path / "b.drl"
    assert main(["convert", str(BOARD), "--to", str(out), "--pins", "3:top-bottom:8"]) == 0
    for call in (["inspect", str(BOARD), "--pins", "3:top-bottom:8"], ["inspect", str(out)]):
        assert main(call) == 0
        assert "T4      3.000 mm       2 holes" in capsys.readouterr().out
    assert main(["estimate", str(BOARD), "--pins", "3:top-bottom:8"]) == 0
    assert "28 holes" in capsys.readouterr().out
    assert main(["run", str(BOARD), "--pins", "3:top-bottom:8", "--journal", "j", "--holes", "h.csv"]) == 0
    assert '"pins": [3.0, "top-bottom", 8.0]' in (tmp_path / "j").read_text()
    assert (tmp_path / "h.csv").read_text().count("\n4,3.0000,") == 2

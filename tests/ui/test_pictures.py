"""The pictures in docs show what the program shows; one that has gone stale is made anew by docs/pictures.py."""

import inspect
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

pyte = pytest.importorskip("pyte", reason="pyte (the dev extra) reads what the program draws")

from docs import picture_scripts, pictures, plots, screen_svg  # noqa: E402 - they need pyte
from docs.moving_picture import animated  # noqa: E402 - it stands beside them
from docs.pictures import SESSIONS, Session  # noqa: E402 - they too
from drillctl.ui.widgets.themes import THEMES  # noqa: E402
from tests.ui.whole import SCREENS  # noqa: E402

# Dots of a board are left out: the trail has the places where the head was seen, which are others on a busy computer.
DOTS = re.compile("[\u2800-\u28ff]")
NAMED = re.compile(r'^    yield "([\w-]+)"$', re.MULTILINE)
QUICK = ("work", "editors")  # these in every run; the others show the same screens in another size or language


def session_marked(session: Session) -> object:
    marks = () if session.script.__name__ in QUICK else (pytest.mark.long,)
    return pytest.param(session, id=session.script.__name__, marks=marks)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the folder that is masked is Linux's")
@pytest.mark.parametrize("session", [session_marked(session) for session in SESSIONS if not session.moves])
def test_a_picture_shows_what_the_program_shows_now(session: Session) -> None:
    for name, svg in pictures.taken(session):
        kept = (pictures.PICTURES / f"{name}.svg").read_text("utf-8")
        shown, drawn = (DOTS.sub(" ", "\n".join(screen_svg.read(each))) for each in (svg, kept))
        assert shown == drawn, f"docs/pictures/{name}.svg is stale: .venv/bin/python docs/pictures.py"


def test_a_screen_is_read_back_as_it_was_drawn() -> None:
    screen = pyte.Screen(12, 3)
    pyte.Stream(screen).feed("\x1b[1;31mred\x1b[0m  <&>\r\n   \x1b[7mturned\x1b[0m x\r\n")
    svg = screen_svg.drawn(screen, screen.display)
    assert screen_svg.read(svg) == ["red  <&>", "   turned x", ""]
    fills = {element.attrib.get("fill") for element in ElementTree.fromstring(svg).iter()}
    assert screen_svg.COLOURS["red"] in fills


def test_every_picture_belongs_to_a_session_and_names_no_folder_of_ours() -> None:
    for file in pictures.PICTURES.glob("*.svg"):
        text = file.read_text("utf-8")
        assert "/tmp/" not in text and str(picture_scripts.ROOT) not in text
        if file.name.startswith("wiring-") or any(file.name in command for command in plots.COMMANDS):
            continue  # drawn by docs/wiring.py, from tables, and by docs/plots.py
        assert f'"{file.stem}"' in Path(picture_scripts.__file__).read_text("utf-8")


def test_a_screen_is_taken_at_the_size_and_in_the_theme_that_are_asked_for(tmp_path: Path) -> None:
    folder = tmp_path / "all"
    pictures.main(["--all", str(folder), "--size", "100x32", "--theme", "light", "--script", "panel"])
    page = (folder / "index.html").read_text("utf-8")
    assert sorted(file.name for file in folder.glob("*.svg")) == sorted(re.findall(r'src="([^"]+)"', page))
    svg = (folder / "panel-100x32-light.svg").read_text("utf-8")
    assert len(screen_svg.read(svg)) == 32
    assert THEMES["light"]["ground"][1] in svg and THEMES["blue"]["ground"][1] not in svg


def test_each_screen_that_every_machine_has_is_among_those_of_all() -> None:
    shown = {name for session in pictures.EVERY_SCREEN for name in NAMED.findall(inspect.getsource(session.script))}
    assert {name.replace("_", "-") for name in SCREENS} <= shown


@pytest.mark.parametrize("wrong", [["--theme", "mono"], ["--all", "x", "--size", "80"]])
def test_options_that_take_no_picture_are_refused(wrong: list[str]) -> None:
    with pytest.raises(SystemExit):
        pictures.main(wrong)


def test_pictures_in_turn_are_one_that_is_animated() -> None:
    screen = pyte.Screen(12, 2)
    taken = []
    for shown in ("still\r\n1", "\r\x1b[K2", "\r\x1b[K1"):
        pyte.Stream(screen).feed(shown)
        taken.append(screen_svg.drawn(screen, screen.display))
    one = animated(taken)
    assert animated(taken[:1]) == taken[0] and one.count("still") == 1
    groups = {element.findtext(f"{screen_svg.SVG}text"): element for element in ElementTree.fromstring(one)}
    assert [groups[text].attrib.get("visibility") for text in ("still", "1", "2")] == [None, "visible", "hidden"]
    motion = [groups[text].find(f"{screen_svg.SVG}animate").attrib for text in "12"]  # type: ignore[union-attr]
    assert [each["values"] for each in motion] == ["visible;hidden;visible", "hidden;visible;hidden"]
    assert {(each["keyTimes"], each["dur"]) for each in motion} == {("0;0.3333;0.6667", "0.75s")}

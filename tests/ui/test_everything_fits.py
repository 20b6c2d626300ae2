"""At 80x24, in both languages: every message is read whole, every key of the help works, nothing is told by colour."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
import urwid
from msgspec.structs import replace

from drillctl import console
from drillctl.kmd import Fault
from drillctl.language import Message, words
from drillctl.ui import app
from drillctl.ui.frame import CONDITIONS, screen_keys
from drillctl.ui.pcb_drill.menus import MENUS
from drillctl.ui.widgets.keys import EMERGENCY, FRAME_KEYS, STOP, Key
from drillctl.ui.widgets.menus import plain_label
from drillctl.ui.widgets.texts import Text, boxed
from drillctl.ui.widgets.windows import Window
from drillctl.viewmodel.console import MachineView
from drillctl.viewmodel.fault_texts import FAULT_WORDS, fault_report
from tests.support.labels import POLISH, menu
from tests.ui.cuts import is_word_cut, noted
from tests.ui.fake_console import BOARD, VIEW, FakeConsole, Program
from tests.ui.whole import MACHINES, SCREENS, Whole, at_home, show

COLUMNS = 80
FIELD = re.compile(r"\{(\w+)(?:![rs])?(:[^}]*)?\}")  # of a message: its name, and its format if it is a figure
FRAMES = re.compile(r"[│┌┐└┘─\s]+")  # of boxes, and where lines were broken


@pytest.fixture(params=words.LANGUAGES)
def language(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    words.use(request.param)
    monkeypatch.setattr(app, "TURNING_S", 0.0)
    yield request.param
    words.use("en")


def told(text: str) -> str:
    """What can be read, wherever lines were broken."""
    return FRAMES.sub(" ", text)


@pytest.mark.parametrize("kept", [True, False])
@pytest.mark.parametrize("fault", [fault for fault in Fault if fault])
def test_every_fault_is_read_whole(language: str, fault: Fault, kept: bool) -> None:
    below = Program(FakeConsole(now=replace(VIEW, condition="latched")))
    program = Program(FakeConsole(now=replace(VIEW, condition="latched", fault=fault_report(fault, kept))))
    text = told("\n".join(_box(program, below)))
    for message in (*FAULT_WORDS[fault], "position kept" if kept else "position lost: initialise again", "OK"):
        assert words._(message) in text
    assert fault.name in text


def _box(program: Program, below: Program) -> list[str]:
    """The rows of the dialog in the middle, without what is beside it."""
    rows, bare = program.text().splitlines(), below.text().splitlines()
    changed = [row for row, before in zip(rows, bare, strict=True) if row != before]
    return [row[row.index("│") : row.rindex("│")] if "│" in row else row for row in changed]


def refusals() -> list[str]:
    """What a console says to a request that it does not take: its constants that have a Polish form."""
    files = Path(console.__file__).parent.glob("*.py")
    nodes = [node for file in files for node in ast.walk(ast.parse(file.read_text("utf-8")))]
    found = {node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    return sorted(found & set(POLISH))


@pytest.mark.parametrize("refusal", refusals())
def test_a_refusal_is_read_whole(language: str, refusal: str) -> None:
    fields = {name: 1 if form else name for name, form in FIELD.findall(refusal)}
    program = Program(FakeConsole(loaded=BOARD, answer=(Message(refusal, **fields),)))
    program.press("i")
    assert words._(refusal).format(**fields) in told(program.text())


def test_a_notice_is_read_whole(language: str) -> None:
    """In the second line there is little room; the help has more."""
    notice = "not real-time: locked memory: Operation not permitted (grant CAP_IPC_LOCK, or raise the memlock limit)"
    program, below = (Program(FakeConsole(now=replace(VIEW, notices=(notice,)))) for _ in range(2))
    program.press(*way("", "notices"))
    assert notice in told("\n".join(_box(program, below)))


@pytest.mark.parametrize("top", range(len(MENUS)))
def test_every_menu_is_read_whole(language: str, top: int) -> None:
    program = Program(FakeConsole())
    program.press("f9", *["right"] * top)
    for number, item in enumerate(MENUS[top].items):
        assert plain_label(item) in program.text()
        if item.items:
            program.press(*["down"] * number, "enter")
            assert all(plain_label(further) in program.text() for further in item.items)
            program.press("esc", *["up"] * number)


@pytest.mark.parametrize("name", SCREENS)
def test_every_word_of_the_key_line_is_read(
    language: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    at_home(tmp_path, monkeypatch)
    words.use(language)
    for program in opened(name):
        line = told("\n".join(program.text().splitlines()[-6:]))
        for key in (EMERGENCY, *screen_keys(program.app.screens[-1]), *FRAME_KEYS):
            shown = bool(key.short) and (key.method != "back" or len(program.app.screens) > 1) and key is not STOP
            assert not shown or f"{words._(key.printed)} {words._(key.short)}" in line


def opened(name: str) -> Iterator[Whole]:
    """A screen by its menu; then the one that Enter opens from it, where that is another."""
    program = Whole()
    try:
        if name in MACHINES:
            program.app.take_machine(MACHINES[name])
        else:
            program.press(*way(name, "show_machine" if name == "scope" else ""))
        program.app.turn()
        yield program
        before = program.app.screens[-1]
        program.press("enter")
        if program.app.screens[-1] is not before:
            yield program
    finally:
        program.console.close()


@pytest.mark.parametrize("size", [(50, 15), (COLUMNS, 24)])
def test_no_word_is_cut_on_any_screen(
    language: str, size: tuple[int, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    at_home(tmp_path, monkeypatch)
    words.use(language)
    with noted() as cuts:
        program = Whole(size)
        try:
            for name in SCREENS:
                show(program.app, name)
                program.text()
                program.press("enter")
                program.text()
                assert not [cut for cut in cuts.take() if is_word_cut(cut)], name
                program.press("esc")
        finally:
            program.console.close()


def test_a_cut_word_is_seen() -> None:
    with noted() as cuts:
        Text("a word that is cut", wrap="clip").render((9,))
        boxed([["a line that is cut"]], 9, 1)
        Window(urwid.SolidFill(), "a title that is cut")._border((9, 3))
        Text("/home/a-file", wrap="ellipsis").render((9,))
        assert [is_word_cut(cut) for cut in cuts.take()] == [True, True, True, False]


def way(screen: str, method: str = "") -> tuple[str, ...]:
    """The keys, as urwid calls them, of an entry of the menus; Drilling is there from the start."""
    keys = () if screen == "drilling" else menu(screen, method)
    return tuple(f"meta {key[1]}" if key[0] == "\x1b" else key for key in keys)


@pytest.mark.parametrize("name", SCREENS)
def test_every_key_of_the_help_works(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It calls the method of its row, or what has the focus does something with it first."""
    at_home(tmp_path, monkeypatch)
    for program in opened(name):
        screen = program.app.screens[-1]
        tables = ((screen, screen_keys(screen)), (program.app, FRAME_KEYS))
        for target, key, pressed in ((t, k, name) for t, keys in tables for k in keys for name in k.names):
            assert _works(program, target, key, pressed, monkeypatch), (type(screen).__name__, pressed)


def _works(program: Whole, target: object, key: Key, pressed: str, monkeypatch: pytest.MonkeyPatch) -> bool:
    called: list[tuple[object, ...]] = []
    while program.app.layers.top:  # what the key before has opened
        program.app.layers.pop()
    before = program.text()
    with monkeypatch.context() as patched:
        assert callable(getattr(target, key.method))
        patched.setattr(target, key.method, lambda *arguments: called.append(arguments))
        program.press(pressed)
    if called:
        return called == [() if key.argument is None else (key.argument,)]
    return program.text() != before


SENSORS_TURNED = tuple((name, not reached) for name, reached in VIEW.sensors)
FIRST = VIEW.axes[0]
STATES = {
    **{f"condition {name}": {"condition": name} for name in CONDITIONS if name != VIEW.condition},
    "moving": {"moving": True},
    "position not known": {"position_known": False},
    "sensors": {"sensors": SENSORS_TURNED},
    "outputs": {"outputs": (("spindle", True),)},
    "wires": {"axes": (replace(FIRST, wires=tuple((n, row, not lit) for n, row, lit in FIRST.wires)), *VIEW.axes[1:])},
    "late": {"late": 3},
    "lost steps": {"lost_steps": (1, 0, 0)},
    "a notice": {"notices": ("not real-time: it is not granted",)},
    "a fault": {"condition": "latched", "fault": fault_report(Fault.LIMIT, True)},
}  # fmt: skip


@pytest.mark.parametrize("change", STATES.values(), ids=STATES)
def test_what_is_the_case_is_told_by_signs_and_not_by_colour(language: str, change: dict[str, object]) -> None:
    """A canvas as text has no colours: two states that read alike would differ by colour alone."""

    def read(view: MachineView) -> str:
        return Program(FakeConsole(now=view, loaded=BOARD), (COLUMNS, 30)).text()

    assert read(VIEW) != read(replace(VIEW, **change))

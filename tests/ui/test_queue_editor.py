"""The queue editor: completion apart from the screen, then typing, running in part and whole, and files."""

import pytest

from drillctl.kmd import commands as kmd
from drillctl.language import words
from drillctl.ui.models.editing import completed, usage
from drillctl.ui.screens.queue_editor import QueueEditor
from drillctl.viewmodel.tables import CommandHelp
from tests.ui.editor_fakes import Console, Hands, Queues, Shell, attributes_of, press, text_of

COMMANDS = Queues().commands()
WORDS = Queues().words()


@pytest.mark.parametrize(
    ("before", "after", "fits"),
    [
        pytest.param("KMD_C", "KMD_CZEKAJ ", (), id="the only one"),
        pytest.param("kmd_c", "KMD_CZEKAJ ", (), id="case is put right"),
        pytest.param("KMD_R", "KMD_RUCH", ("KMD_RUCH", "KMD_RUCHd"), id="as far as two agree"),
        pytest.param("", "KMD_", ("KMD_CZEKAJ", "KMD_RUCH", "KMD_RUCHd"), id="nothing typed"),
        pytest.param("KMD_Q", "KMD_Q", (), id="none"),
        pytest.param("KMD_RUCH sp", "KMD_RUCH spindle ", (), id="a name of the machine"),
        pytest.param("KMD_RUCH x=3 y", "KMD_RUCH x=3 y ", (), id="a later name"),
        pytest.param("  kmd_c", "  KMD_CZEKAJ ", (), id="after spaces"),
    ],
)
def test_completion(before: str, after: str, fits: tuple[str, ...]) -> None:
    assert completed(before, COMMANDS, WORDS) == (after, fits)


def test_usage_of_a_line() -> None:
    assert usage(" KMD_CZEKAJ 5", COMMANDS) == "KMD_CZEKAJ ticks: wait"
    assert usage("", COMMANDS) == usage("KMD_NONE", COMMANDS) == ""


def test_arguments_and_meaning_are_in_the_operator_s_language(console: Console, shell: Shell) -> None:
    words.use("pl")
    editor = QueueEditor(console, shell, WholeTable(), Hands(console))
    press(editor, *"KMD_LINIA x=3")
    shown = text_of(editor, (160, 50))
    for there in ("KMD_LINIA oś=kroki ...: jak KMD_RUCH, po jednej linii", "KMD_CZEKAJ takty", "koniec kolejki"):
        assert there in shown
    assert "axis" not in shown and "ticks" not in shown


class WholeTable(Queues):
    """The queues of the fake with every command that there is."""

    def commands(self) -> list[CommandHelp]:
        """All of them."""
        return [CommandHelp(spec.name, spec.usage, spec.meaning) for spec in kmd.COMMANDS.values()]


@pytest.fixture
def shell() -> Shell:
    return Shell(types="q.kmd")


@pytest.fixture
def console() -> Console:
    return Console()


@pytest.fixture
def queues() -> Queues:
    return Queues()


@pytest.fixture
def hands(console: Console) -> Hands:
    return Hands(console)


@pytest.fixture
def editor(console: Console, shell: Shell, queues: Queues, hands: Hands) -> QueueEditor:
    return QueueEditor(console, shell, queues, hands)


def test_a_move_too_long_is_warned_of_and_can_be_tried(editor: QueueEditor, console: Console) -> None:
    press(editor, *"KMD_RUCH x=9999")
    assert "1: too far" in text_of(editor) and attributes_of(editor, "too far") == {"warning"}
    assert "sound" not in text_of(editor)
    press(editor, "f5")
    assert console.ran == ["KMD_RUCH x=9999"]


def test_tab_completes_in_the_middle_of_a_text(editor: QueueEditor) -> None:
    press(editor, *"KMD_RUCH x=1", "enter", *"kmd_c", "tab", "9")
    assert editor.text == "KMD_RUCH x=1\nKMD_CZEKAJ 9"
    assert "line 2, column 13" in text_of(editor) and "KMD_CZEKAJ ticks: wait" in text_of(editor)
    press(editor, "up", "home", "tab")
    assert editor.text == "KMD_KMD_RUCH x=1\nKMD_CZEKAJ 9"


def test_words_that_begin_alike_are_listed(editor: QueueEditor) -> None:
    press(editor, *"KMD_R", "tab")
    assert "KMD_RUCH  KMD_RUCHd" in text_of(editor)


def test_wrong_lines_are_told_as_they_are_typed(editor: QueueEditor) -> None:
    press(editor, *"KMD_CZEKAJ 1")
    assert "sound" in text_of(editor)
    press(editor, "enter", "X")
    assert "2:1: unknown command" in text_of(editor)
    assert attributes_of(editor, "2:1: unknown") == {"danger"}


def test_many_wrong_lines_are_counted(editor: QueueEditor) -> None:
    press(editor, *["X", "enter"] * 8)
    assert "and 3 more" in text_of(editor)


@pytest.fixture
def three_lines(editor: QueueEditor) -> QueueEditor:
    press(editor, *"KMD_CZEKAJ 1", "enter", *"KMD_CZEKAJ 2", "enter", *"KMD_CZEKAJ 3", "up")
    return editor


def test_a_queue_runs_whole_and_to_the_cursor(three_lines: QueueEditor, console: Console) -> None:
    press(three_lines, "f5", "ctrl d")
    assert console.ran == ["KMD_CZEKAJ 1\nKMD_CZEKAJ 2\nKMD_CZEKAJ 3", "KMD_CZEKAJ 1\nKMD_CZEKAJ 2"]


def test_lines_run_one_after_the_other(three_lines: QueueEditor, console: Console) -> None:
    press(three_lines, "ctrl n", "ctrl n")
    assert [text.strip() for text in console.ran] == ["KMD_CZEKAJ 2", "KMD_CZEKAJ 3"]
    assert [text.count("\n") for text in console.ran] == [1, 2], "so that line numbers are those of the screen"


def test_the_first_tick_begins_the_queue_and_the_next_ones_go_on(
    three_lines: QueueEditor, console: Console, hands: Hands
) -> None:
    press(three_lines, "ctrl t", "ctrl t")
    assert hands.done == [("run_paused", three_lines.text), ("tick", 1), ("tick", 1)]
    three_lines.refresh(console.view())
    assert "stopped after tick 41: KMD_CZEKAJ 5" in text_of(three_lines)
    assert "X column 3 (+1) at 7" in text_of(three_lines)
    press(three_lines, "f5")
    three_lines.refresh(console.view())
    assert hands.done[-1] == ("go",) and console.ran == [] and "stopped" not in text_of(three_lines)


def test_a_queue_that_is_refused_gets_no_tick(three_lines: QueueEditor, hands: Hands, shell: Shell) -> None:
    hands.refusal = ("the machine is at work",)
    press(three_lines, "ctrl t")
    assert [asked[0] for asked in hands.done] == ["run_paused"] and shell.told == [("Not run", [hands.refusal[0]])]


@pytest.mark.parametrize("key", ["f5", "ctrl d", "ctrl n", "ctrl t"])
@pytest.mark.parametrize("yes", [False, True])
def test_a_real_machine_is_asked_about_first(
    key: str, yes: bool, three_lines: QueueEditor, console: Console, hands: Hands, shell: Shell
) -> None:
    hands.port, shell.says_yes = "firmata", yes
    press(three_lines, key)
    assert shell.asked == ["A real machine is connected to firmata. Run the queue on it?"]
    assert bool(console.ran or hands.done) == yes


def test_a_wrong_queue_is_not_handed_on(editor: QueueEditor, console: Console, shell: Shell) -> None:
    press(editor, *"nonsense", "f5", "ctrl d", "ctrl n")
    assert console.ran == [] and shell.told == [("Not run", ["1:1: unknown command"])] * 3


def test_a_right_line_runs_beside_a_wrong_one(three_lines: QueueEditor, console: Console) -> None:
    press(three_lines, "down", "end", "enter", "X", "up", "ctrl n")
    assert [text.strip() for text in console.ran] == ["KMD_CZEKAJ 3"]


def test_a_refusal_is_told_and_the_cursor_stays(three_lines: QueueEditor, console: Console, shell: Shell) -> None:
    console.refusal = ("the machine is at work",)
    press(three_lines, "ctrl n")
    assert shell.told == [("Not run", ["the machine is at work"])] and "line 2" in text_of(three_lines)


def test_a_queue_is_saved_and_opened(editor: QueueEditor, shell: Shell, queues: Queues) -> None:
    press(editor, *"KMD_RUCH x=1", "f2")
    assert queues.files == {"q.kmd": "KMD_RUCH x=1"} and not editor.changed
    assert "Queue of commands: q.kmd" in text_of(editor)
    queues.files["q.kmd"] = "KMD_CZEKAJ 5"
    press(editor, "ctrl o")
    assert editor.text == "KMD_CZEKAJ 5" and not editor.changed


def test_a_file_that_cannot_be_read_leaves_the_queue(editor: QueueEditor, shell: Shell) -> None:
    shell.says_yes = True
    press(editor, *"KMD_RUCH x=1", "ctrl o")
    assert editor.text == "KMD_RUCH x=1" and shell.told == [("Not opened", ["q.kmd: can't be read"])]


def test_what_is_not_saved_is_asked_for(editor: QueueEditor, shell: Shell) -> None:
    assert press(editor, "esc") == ["esc"]
    press(editor, "x", "ctrl o", "esc")
    assert len(shell.asked) == 2 and editor.text == "x" and shell.closed == 0


def test_typing_and_completing_are_undone_and_made_again(editor: QueueEditor) -> None:
    press(editor, *"kmd_c", "tab", "5", "enter")
    assert editor.text == "KMD_CZEKAJ 5\n"
    press(editor, "left", "left", "ctrl u", "ctrl u")
    assert editor.text == "KMD_CZEKAJ ", "going about with the cursor is no change"
    press(editor, "ctrl u", "ctrl r", "ctrl r", "7")
    assert editor.text == "KMD_CZEKAJ 57"
    press(editor, "ctrl r", *["ctrl u"] * 30)
    assert editor.text == "" and not editor.changed


def test_what_was_given_up_is_gone_when_the_editor_comes_back(editor: QueueEditor, shell: Shell) -> None:
    shell.says_yes = True
    press(editor, *"KMD_X", "esc")
    assert shell.closed == 1 and editor.text == "" and not editor.changed

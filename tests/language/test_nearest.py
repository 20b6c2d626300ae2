"""The word that was meant."""

import pytest

from drillctl.language import known_words, nearest

VERBS = ("run", "resume", "estimate", "inspect", "convert", "replay")


@pytest.mark.parametrize(
    ("word", "known", "meant"),
    [
        ("runn", VERBS, "run"),
        ("RUN", VERBS, "run"),
        ("inpsect", VERBS, "inspect"),
        ("pcb-dril", ("boiler-drum", "pcb-drill", "pcb-drill-ramp-lab"), "pcb-drill"),
        ("optimized", ("file", "nearest", "optimised"), "optimised"),
        ("kmd_baza", ("KMD_BAZA", "KMD_GOTO_X_Y"), "KMD_BAZA"),
        ("", VERBS, None),
        ("lathe", ("boiler-drum", "pcb-drill"), None),
        ("run", (), None),
        ("n" * 10_000, VERBS, None),
    ],
)
def test_the_nearest(word: str, known: tuple[str, ...], meant: str | None) -> None:
    assert nearest(word, known) == meant


def test_what_follows_a_refusal() -> None:
    assert known_words("runn", ("run", "plot")) == "there are run, plot; did you mean run?"
    assert known_words("dig", ("run", "plot")) == "there are run, plot"
    assert known_words("x", ()) == "there are none"

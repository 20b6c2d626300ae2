"""Part programs in plain words, for ``inspect`` and ``store``: lines in English or Polish, and JSON."""

import argparse
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from drillctl.cli import streams
from drillctl.language import Counted
from drillctl.language.words import LANGUAGES, translated

if TYPE_CHECKING:
    from drillctl.generation.boiler_drum.sentence import Sentence
    from drillctl.generation.boiler_drum.text import Part

TENTHS_PER_MM = 10


def add_language(verb: argparse.ArgumentParser) -> None:
    """Adds ``--lang`` to a verb."""
    verb.add_argument("--lang", choices=LANGUAGES, help="language of the words; default: that of LANG")


def speak(arguments: argparse.Namespace) -> None:
    """Sets the language of ``translated`` to that of ``--lang``."""
    streams.speak(arguments.lang)


def lines(part: "Part") -> list[str]:
    """Returns a part program in words, a sentence a line: its place, its text, what it does, where it ends (mm)."""
    head = Counted(
        "{name}: {count} sentence; from X {x:.1f} Y {y:.1f} mm on, where the tool was set",
        "{name}: {count} sentences; from X {x:.1f} Y {y:.1f} mm on, where the tool was set",
        len(part.sentences), name=part.source, x=0.0, y=0.0,
    )  # fmt: skip
    rows = zip(part.lines, part.sentences, _places(part.sentences), strict=True)
    return [translated(head), *(_line(at, one, place, part.in_store) for at, one, place in rows)]


def as_dict(part: "Part") -> dict[str, Any]:
    """Returns the same for ``--json``, in English."""
    place = "cell" if part.in_store else "line"
    rows = [
        {place: at, "sentence": str(one), "axis": one.axis, "mm": one.signed_tenths / TENTHS_PER_MM, "gear": one.gear,
         "x_mm": x / TENTHS_PER_MM, "y_mm": y / TENTHS_PER_MM, "words": str(one.words())}
        for at, one, (x, y) in zip(part.lines, part.sentences, _places(part.sentences), strict=True)
    ]  # fmt: skip
    return {"program": part.source, "sentences": rows}


def _line(at: int, sentence: "Sentence", place: tuple[int, int], in_store: bool) -> str:
    where = f"{at:04X}" if in_store else f"{at:4}"
    x, y = (tenths / TENTHS_PER_MM for tenths in place)
    return f"  {where}  {sentence}  X {x:7.1f}  Y {y:6.1f}  {translated(sentence.words())}"


def _places(sentences: "tuple[Sentence, ...]") -> Iterator[tuple[int, int]]:
    """Yields where X and Y are after each sentence, in tenths of a millimetre."""
    here = {"x": 0, "y": 0}
    for sentence in sentences:
        here[sentence.axis] += sentence.signed_tenths
        yield here["x"], here["y"]

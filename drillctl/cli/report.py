"""``drillctl report RUN -o RUN.html``: a recorded run as one page for a browser, without a network: the board with its
holes, speed and lag, lost steps, waves with zoom, commands and faults in words. With a second run: where the two part.
"""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import options, streams
from drillctl.cli.part_programs import add_language
from drillctl.cli.plot import add_holes
from drillctl.language import Message

if TYPE_CHECKING:
    from drillctl.viewmodel.run_report import RunReport

ENDINGS = (".html", ".htm")


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("report", help="write a run as a page for a browser", description=__doc__)
    verb.add_argument("run", type=Path, metavar="RUN", help="what run --trace wrote")
    verb.add_argument("other", type=Path, nargs="?", metavar="OTHER", help="another run: where do the two part?")
    verb.add_argument("-o", "--out", type=Path, required=True, metavar="F.html", help="the page")
    add_holes(verb)
    add_language(verb)
    options.add_tables(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Reserves the page before the run is played again; 1 where two runs differ."""
    from drillctl.files.outputs import OutputError, reserved
    from drillctl.lab.hole_table import diameters, read_holes
    from drillctl.lab.run_report import compared, run_report
    from drillctl.language.words import language_of
    from drillctl.ui.report.page import report_page

    if arguments.out.suffix.lower() not in ENDINGS:
        raise OutputError(Message("a report is an .html file").at(arguments.out))
    language = arguments.lang or language_of()
    streams.speak(language)
    library, given = options.library(arguments), [arguments.run, *filter(None, [arguments.other])]
    with reserved([arguments.out], [*given, *filter(None, [arguments.holes])]) as (page,):
        sizes = diameters(read_holes(arguments.holes)) if arguments.holes else {}
        assert page is not None
        reports = [_sized(run_report(file, library), sizes) for file in given]
        found = compared(arguments.run, arguments.other, library) if arguments.other else None
        text = report_page(reports, language, found)
        page.write(lambda stream: stream.write(text))
    streams.note(f"{arguments.out} is written")
    return 1 if found and found.tick is not None else 0


def _sized(report: "RunReport", sizes: dict[int, float]) -> "RunReport":
    """The report with the diameters of its tools, where they are known."""
    from msgspec.structs import replace

    from drillctl.lab.hole_table import with_diameters

    return replace(report, holes=with_diameters(report.holes, sizes)) if sizes else report

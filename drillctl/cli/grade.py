"""``drillctl grade SHEET DIR...``: judges submissions of a lab sheet, each by its own tables and apart from the others;
a line each, with why it failed.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import options, streams

if TYPE_CHECKING:
    from collections.abc import Sequence

    from drillctl.viewmodel.grades import SubmissionGrade

MOST_WORKERS = 64
LONGEST_S = 3600


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("grade", help="judge submissions of a lab sheet", description=__doc__)
    sheet = "a lab sheet: a shipped one (01), or the folder of one's own, with a sheet.toml"
    verb.add_argument("sheet", metavar="SHEET", help=sheet)
    submission = "a submission: a copy of the sheet's folder"
    verb.add_argument("submissions", nargs="+", type=Path, metavar="DIR", help=submission)
    verb.add_argument("--csv", type=Path, metavar="F.csv", help="write the grades as a table, for a gradebook")
    verb.add_argument("--junit", type=Path, metavar="F.xml", help="write the grades as JUnit XML, for a CI server")
    longest = "longest time for one submission; default: %(default)s"
    verb.add_argument("--seconds", type=options.up_to(LONGEST_S), default=60, metavar="S", help=longest)
    several = "submissions judged at a time; default: all cores"
    verb.add_argument("--workers", type=options.up_to(MOST_WORKERS), metavar="N", help=several)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Prints each grade as it is known; 1 where a submission did not pass every check."""
    from tqdm import tqdm

    from drillctl.files.outputs import reserved
    from drillctl.lab.grading import graded, names, sheet_of
    from drillctl.lab.workers import cores
    from drillctl.ui.terminal.grades import csv_lines, grade_line, junit_text

    sheet = sheet_of(arguments.sheet)
    with reserved((arguments.csv, arguments.junit), ()) as (table, junit):
        width = max(map(len, names(arguments.submissions)))
        every = graded(sheet, arguments.submissions, arguments.workers or cores(), arguments.seconds)
        grades = []
        with tqdm(total=len(arguments.submissions), disable=None, leave=False, file=streams.bar(sys.stderr)) as bar:
            for grade in every:
                grades.append(grade)
                bar.update()
                bar.write(grade_line(grade, width), file=sys.stdout)
        if table is not None:
            table.write(lambda file: file.writelines(csv_lines(grades)))
        if junit is not None:
            junit.write(lambda file: file.write(junit_text(sheet.title, grades)))
    return _summed(sheet.title, grades)


def _summed(title: str, grades: "Sequence[SubmissionGrade]") -> int:
    passed = sum(grade.passed for grade in grades)
    print(f"{title}: {passed} of {len(grades)} passed")
    return 0 if passed == len(grades) else 1

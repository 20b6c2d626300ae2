"""Grades of submissions as a line for the terminal, rows of a table, and JUnit XML.

Rule: functions of records; what a submission says of itself (its name, its tables' names) is made visible.
"""

import csv
import io
from collections.abc import Iterator, Sequence
from xml.etree import ElementTree

from drillctl.language import one_line
from drillctl.viewmodel.grades import SubmissionGrade

HEAD = ("submission", "points", "of", "passed", "why")
NOT_IN_XML = str.maketrans(dict.fromkeys((*range(9), 11, 12, *range(14, 32), 0xFFFE, 0xFFFF), "?"))
FORMULAS = ("=", "+", "-", "@", "＝", "＋", "－", "＠")  # with which a spreadsheet begins to compute, wide ones too


def grade_line(grade: SubmissionGrade, width: int) -> str:
    """Returns a grade as a line: name in ``width`` columns, points, and why it did not pass."""
    points = f"{grade.points}/{len(grade.checks)}"
    return one_line(f"{grade.name:{width}}  {'passed' if grade.passed else 'failed'}  {points}  {grade.why}".rstrip())


def csv_lines(grades: Sequence[SubmissionGrade]) -> Iterator[str]:
    """Yields the grades as CSV, a line each below HEAD; no cell begins as a formula does."""
    for row in (HEAD, *(_row(grade) for grade in grades)):
        line = io.StringIO()
        csv.writer(line, lineterminator="\n").writerow([_cell(cell) for cell in row])
        yield line.getvalue()


def junit_text(title: str, grades: Sequence[SubmissionGrade]) -> str:
    """Returns the grades as JUnit XML: a suite a submission, a test case a check."""
    suites = ElementTree.Element("testsuites", name=_xml(title))
    for grade in grades:
        count, failed = len(grade.checks), len(grade.checks) - grade.points
        suite = ElementTree.SubElement(
            suites, "testsuite", name=_xml(grade.name), tests=str(count), failures=str(failed)
        )
        for check in grade.checks:
            case = ElementTree.SubElement(suite, "testcase", classname=_xml(grade.name), name=_xml(check.name))
            if not check.passed:
                ElementTree.SubElement(case, "failure", message=_xml(check.why))
    ElementTree.indent(suites)
    return f'<?xml version="1.0" encoding="utf-8"?>\n{ElementTree.tostring(suites, encoding="unicode")}\n'


def _row(grade: SubmissionGrade) -> tuple[str, ...]:
    return grade.name, str(grade.points), str(len(grade.checks)), "yes" if grade.passed else "no", grade.why


def _cell(text: str) -> str:
    shown = one_line(text)
    return f"'{shown}" if shown.startswith(FORMULAS) else shown


def _xml(text: str) -> str:
    return one_line(text).translate(NOT_IN_XML)

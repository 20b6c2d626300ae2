"""A sweep: a question answered into a results file, from where the file leaves off.

Rule: rows come in the order of the machines and depend on nothing but the question. Called by the sweep verb.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from drillctl.lab.answers import chunks
from drillctl.lab.crowd import on_cluster, on_cores
from drillctl.lab.question import Question
from drillctl.lab.results import Results


@dataclass(frozen=True, slots=True)
class Crew:
    """Who answers: so many processes here, or the workers of a dask scheduler at an address."""

    workers: int = 1
    cluster: str | None = None


def sweep(question: Question, results: Results, crew: Crew) -> Iterator[int]:
    """Answers what is missing; gives how many rows the file has, after each chunk. Raises LabError."""
    todo = chunks(question, results.rows)
    answers = on_cluster(question, todo, crew.cluster) if crew.cluster else on_cores(question, todo, crew.workers)
    for chunk, rows in zip(todo, answers, strict=True):
        results.append(rows[max(results.rows - chunk.start, 0) :])
        yield results.rows

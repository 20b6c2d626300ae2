"""What a journal says: its first line, and the lines after it, each checked for its place.

Rule: holes are begun and done one after the other, in drilling order; a run ends once, and what follows its end is a
resumption. A line that comes where it can't is refused, whether it was read or is about to be written.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Annotated, Any, Literal

import msgspec

from drillctl.generation.job_setup import BAD_VALUES
from drillctl.jobs.journal.chain import NO_SEAL
from drillctl.language import Counted, Message, Refusal, joined, message_of
from drillctl.plant.choice import GREATEST_SEED
from drillctl.viewmodel.job_options import FilePath
from drillctl.viewmodel.jobs import Site

DONE = "done"


class OutOfPlace(Refusal):
    """Raised for a line that can't come at this place. ``str()`` is the reason."""


@dataclass(frozen=True)
class Head:
    """The first line: enough to build the same job again, and to see that it is the same.

    file_digest     of the drill file; program_digest: of what was made from it, placing and order included
    options         of the command line that made the job, by name
    """

    job: FilePath
    file_digest: str
    program_digest: str
    machine: str
    machine_digest: str
    holes: Annotated[int, msgspec.Meta(ge=1)]
    options: Mapping[str, Any]


class SiteLine(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A site (viewmodel/jobs.py) as it stands in a journal."""

    port: FilePath
    pace: Literal["free", "real"]
    plant: str
    seed: Annotated[int, msgspec.Meta(ge=0, le=GREATEST_SEED)]
    converter: str = ""


@dataclass(frozen=True)
class Account:
    """What a journal says: how many holes, counted in drilling order, and where the job ran last.

    holes_begun  in any of its runs; those that are not done are drilled again, and named
    ended        how the last run ended; None while it goes on, or where it was cut off
    torn         a last line without its end was left out
    under_way    the last hole was begun in the last run, and is not done
    suspect      numbers of holes that are done and may be bad: each the last of a bit that was found broken after it
    seal         of the last whole line
    """

    head: Head
    site: Site
    holes_done: int = 0
    holes_begun: int = 0
    ended: str | None = None
    torn: bool = False
    under_way: bool = False
    suspect: tuple[int, ...] = ()
    seal: str = NO_SEAL

    @property
    def done(self) -> set[int]:
        """The numbers, from 1, of the holes that are done."""
        return set(range(1, self.holes_done + 1))

    @property
    def begun(self) -> set[int]:
        """The numbers of the holes that were begun, done or not."""
        return set(range(1, self.holes_begun + 1))

    @property
    def open(self) -> list[int]:
        """The numbers of the holes that were begun and not done: one at most."""
        return list(range(self.holes_done + 1, self.holes_begun + 1))

    @property
    def doubtful(self) -> int | None:
        """The hole that may have been begun although no line says so: the torn one may have said it."""
        return self.next if self.torn and not self.open and not self.complete else None

    @property
    def again(self) -> int | None:
        """The hole that a run that goes on must name: the bit may have met its place before."""
        return self.open[0] if self.open else self.doubtful

    @property
    def next(self) -> int:
        """The hole to be drilled next."""
        return self.holes_done + 1

    @property
    def share_done(self) -> Message:
        """How many of the job's holes are done, in words."""
        return Counted(
            "{done} of {count} hole is done", "{done} of {count} holes are done", self.head.holes, done=self.holes_done
        )

    @property
    def complete(self) -> bool:
        """Whether all holes are done."""
        return self.holes_done == self.head.holes

    @property
    def unfinished(self) -> bool:
        """Whether a hole was begun, or may have been, and not all are done."""
        return bool(self.holes_begun or self.doubtful) and not self.complete

    def with_line(self, line: Mapping[str, Any]) -> "Account":
        """The account after a further line. Raises OutOfPlace."""
        names = tuple(line)
        if names not in PLACES:
            raise OutOfPlace(Message("{names!r} does not belong in a journal", names=", ".join(names)[:60]))
        return PLACES[names](self, *line.values())

    def _with_begun(self, hole: object) -> "Account":
        if self.ended is not None or self.under_way or not self._is_next(hole):
            raise OutOfPlace(Message("begun {hole!r} is out of its place: {state}", hole=hole, state=self._state()))
        return replace(self, holes_begun=self.next, under_way=True)

    def _with_done(self, hole: object) -> "Account":
        if self.ended is not None or not self.under_way or not self._is_next(hole):
            raise OutOfPlace(Message("done {hole!r} is out of its place: {state}", hole=hole, state=self._state()))
        return replace(self, holes_done=self.next, under_way=False)

    def _with_suspect(self, hole: object) -> "Account":
        if self.ended is not None or type(hole) is not int or hole not in self.done:
            raise OutOfPlace(Message("suspect {hole!r} is out of its place: {state}", hole=hole, state=self._state()))
        return replace(self, suspect=(*self.suspect, hole))

    def _with_end(self, how: object) -> "Account":
        early = how == DONE and not self.complete
        if self.ended is not None or not isinstance(how, str) or early:
            raise OutOfPlace(Message("ended {how!r} is out of its place: {state}", how=how, state=self._state()))
        return replace(self, ended=how, under_way=False)

    def _with_resumption(self, site: object, again: object) -> "Account":
        named = self._is_next(again) or (again is None and not self.open)
        if self.complete or not named:
            raise OutOfPlace(
                Message(
                    "a resumption that drills hole {again!r} again is out of its place: {state}",
                    again=again,
                    state=self._state(),
                )
            )
        begun = self.holes_begun if again is None else self.next
        return replace(self, site=site_of_line(site), holes_begun=begun, ended=None, under_way=False)

    def _is_next(self, hole: object) -> bool:
        return type(hole) is int and hole == self.next and not self.complete

    def _state(self) -> Message:
        run = Message("the run goes on") if self.ended is None else Message("the run has ended")
        if self.under_way:
            return Message("{done}, hole {next} is begun, {run}", done=self.share_done, next=self.next, run=run)
        return joined(", ", [self.share_done, run])


PLACES: dict[tuple[str, ...], Callable[..., Account]] = {
    ("begun",): Account._with_begun,
    ("done",): Account._with_done,
    ("suspect",): Account._with_suspect,
    ("ended",): Account._with_end,
    ("resumed", "again"): Account._with_resumption,
}


def site_of_line(line: object) -> Site:
    """The site in a line of a journal. Raises OutOfPlace."""
    try:
        return Site(**msgspec.structs.asdict(msgspec.convert(line, SiteLine)))
    except BAD_VALUES as error:
        raise OutOfPlace(Message("no port, pace and plant: {why}", why=message_of(error))) from error


def head_of_line(line: Mapping[str, Any]) -> Head:
    """The head in the first line of a journal, whose version and site were taken out. Raises OutOfPlace."""
    if set(line) != {field.name for field in fields(Head)}:
        raise OutOfPlace(Message("its first line is not whole"))
    try:
        return msgspec.convert(line, Head)
    except BAD_VALUES as error:
        raise OutOfPlace(Message("its first line is not whole: {why}", why=message_of(error))) from error

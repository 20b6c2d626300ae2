"""The options of a job as a caller gives them: by the names of the command line, checked as a journal's are."""

from collections.abc import Mapping
from typing import Any

from drillctl.api.arguments import plain
from drillctl.generation.job_setup import BAD_VALUES, JobSetup
from drillctl.language import Message, Refusal, known_words
from drillctl.machine import Machine
from drillctl.machine.source import plainly
from drillctl.viewmodel.choices import AFTER_END, MIRRORED, ORDERS, ORIGINS
from drillctl.viewmodel.job_options import JobOptions

NAMES = JobOptions.__struct_encode_fields__
CHOICES = {"origin": ORIGINS, "mirror": MIRRORED, "order": ORDERS, "after_end": AFTER_END}


def setup_of(machine: Machine, options: Mapping[str, Any]) -> JobSetup:
    """Returns a job's setup. Raises Refused for a name or a value that is none."""
    for name, value in options.items():
        if name not in NAMES:
            raise Refusal(Message("no option {name!r}; {words}", name=name, words=known_words(name, NAMES)))
        check_choice(name, value)
    values = {name: plain(value) for name, value in options.items()}
    try:
        return JobSetup.checked({"machine": machine.file, **values})
    except BAD_VALUES as error:
        raise Refusal(plainly(str(error).replace("`$.options.", "`$."))) from error


def check_choice(name: str, value: object) -> None:
    """Raises Refused for a word that an option can't be; a value of another type is none of its words."""
    known = CHOICES.get(name, ())
    if isinstance(value, str) and known and value not in known:
        raise Refusal(Message("{what} {value!r}: {words}", what=name, value=value, words=known_words(value, known)))

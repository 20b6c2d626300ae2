"""Parameters by name, and changed by name in a machine's text; comments and layout stay.

Names are those that refusals use: ``axis.x.s_share``, ``system.parking_x_mm``, ``tool.3.life_hits``,
``magazine.2.x_mm``. Rule: text in, text out; each value is checked by its row before the text is made, all of them
together by the readers of files when it is saved (Library.check_source).
"""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import tomlkit
from tomlkit.items import AoT

from drillctl.language import Message, Refusal, known_words, message_of
from drillctl.machine.edit import opened
from drillctl.machine.errors import TableError
from drillctl.machine.parameter_entry import UNSET, parsed
from drillctl.machine.parameter_file import PARAMETERS, read_parameters
from drillctl.machine.parameter_table import AXIS, GROUPS, LISTS, Parameter, Value, of_group, parameter
from drillctl.machine.parameters import Parameters
from drillctl.machine.positions import Place
from drillctl.machine.shape import MachineFile
from drillctl.machine.source import Source

NONE_THERE = Message("this machine has no parameters: its file has no [parameters]")


class ParameterError(Refusal):
    """Parameters that can't be set as asked, a message each; nothing was changed."""

    kind = "parameters"


class Entry(NamedTuple):
    """A parameter of a machine: its name, its place in the file, its row of the table, its value (None: unset)."""

    name: str
    place: Place
    parameter: Parameter
    value: Value | None


def parameters_of(source: Source) -> Parameters:
    """Returns the parameters of a machine's text. Raises TableError, also for a text without any."""
    found = read_parameters(source, source.records(MachineFile))
    if found is None:
        raise TableError(source.file, NONE_THERE)
    return found


def entries(parameters: Parameters) -> list[Entry]:
    """Returns all parameters, set or not, by groups in the order of the table."""
    found = []
    for group in GROUPS:
        for index, (called, row) in enumerate(parameters.rows(group)):
            inner: Place = (index,) if group in LISTS else (called.removeprefix(f"{AXIS}."),) if group == AXIS else ()
            found += [
                Entry(f"{called}.{one.name}", (PARAMETERS, group, *inner, one.name), one, row.value(one.name))
                for one in of_group(group)
            ]
    return found


def entry(parameters: Parameters, name: str) -> Entry:
    """Returns a parameter by its name. Raises ParameterError, with those that are near, for one that there is not."""
    known = {one.name: one for one in entries(parameters)}
    if name not in known:
        words = known_words(name, _near(name, known))
        raise ParameterError(Message("no parameter is named {name!r}; {words}", name=name, words=words))
    return known[name]


def with_parameters(source: Source, typed: Mapping[str, str]) -> str:
    """Returns the text with parameters, by name, set as typed; ``unset`` or nothing typed unsets one. Raises
    ParameterError with a message for each name or value that can't be, TableError for a text that has no parameters.
    """
    parameters = parameters_of(source)
    problems: list[Message] = []
    document = opened(source.text)
    for name, text in typed.items():
        try:
            one = entry(parameters, name)
            value = parsed(one.parameter, text)
        except ParameterError as error:
            problems += error.messages
        except ValueError as error:
            problems.append(message_of(error).at(name.rpartition(".")[0]))
        else:
            _inside(document, one.place[:-1])[one.place[-1]] = UNSET if value is None else value
    if problems:
        raise ParameterError(*problems)
    return tomlkit.dumps(document)


def with_row(source: Source, group: str, number: int) -> str:
    """Returns the text with one more tool, or place of the magazine, of which only the number is set. Raises
    ParameterError for a number that is there already or can't be.
    """
    parameters, key = parameters_of(source), LISTS[group]
    try:
        parsed(parameter(group, key), str(number))
    except ValueError as error:
        raise ParameterError(message_of(error)) from error
    if any(row.value(key) == number for _called, row in parameters.rows(group)):
        raise ParameterError(Message("{key} {number}: a second row of this number", key=key, number=number))
    document = opened(source.text)
    table = document[PARAMETERS]
    row = tomlkit.table()
    row.update({key: number, **{one.name: UNSET for one in of_group(group) if one.name != key}})
    if group not in table:
        table[group] = tomlkit.aot()
    elif table[group][-1].as_string().endswith("\n\n"):  # rows have an empty line between them
        row.add(tomlkit.nl())
    else:
        row.trivia.indent = "\n"
    table[group].append(row)
    return tomlkit.dumps(document)


def without_row(source: Source, group: str, number: int) -> str:
    """Returns the text without a tool or a place of the magazine. Raises ParameterError where there is none of
    this number.
    """
    key = LISTS[group]
    numbers = [row.value(key) for _called, row in parameters_of(source).rows(group)]
    if number not in numbers:
        raise ParameterError(Message("there is no {group} {number}", group=group, number=number))
    document = opened(source.text)
    rows = document[PARAMETERS][group]
    assert isinstance(rows, AoT)
    del rows[numbers.index(number)]
    if not rows:
        del document[PARAMETERS][group]
    return tomlkit.dumps(document).rstrip() + "\n"  # without the empty line that stood above the last row


def _inside(document: Any, place: Place) -> Any:
    """Returns the table at a place; one that is not written yet is made (an axis, the coordinates)."""
    for part in place:
        if isinstance(part, str) and part not in document:
            document[part] = tomlkit.table()
        document = document[part]
    return document


def _near(name: str, known: Iterable[str]) -> list[str]:
    """Returns the names that a wrong one may mean: those of its row where it names one, else what rows there are."""
    row = name.rpartition(".")[0]
    within = [one for one in known if one.rpartition(".")[0] == row]
    return within or list(dict.fromkeys(one.rpartition(".")[0] for one in known))

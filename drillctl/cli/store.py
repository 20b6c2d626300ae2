"""``drillctl store ACTION``: the stores of a machine, EPROM and RAM, and their workpieces by number (01 to 99).

``list`` what there is; ``show`` a workpiece, or the cells at their addresses; ``put`` a part program into the RAM;
``get`` one out of it; ``compare`` two part programs, or the two stores; ``remove`` a workpiece from the RAM.
"""

import argparse
from collections.abc import Callable, Mapping
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import jobs, options, part_programs, streams
from drillctl.language import Counted, Message

if TYPE_CHECKING:
    from drillctl.generation.boiler_drum.stores import Store
    from drillctl.generation.boiler_drum.text import Part
    from drillctl.machine import Machine

MACHINE = "boiler-drum"
DIFFERENT = 1
JOB = "a part program (.sentences), or the number of a workpiece"


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("store", help="list, show and change stores of workpieces", description=__doc__)
    actions = verb.add_subparsers(metavar="ACTION", required=True)
    _action(actions, "list", _list, "list the workpieces of both stores")
    show = _action(actions, "show", _show, "show a workpiece in words, or all cells at their addresses")
    show.add_argument("number", nargs="?", type=_number, metavar="NN", help="workpiece; default: the cells of a store")
    show.add_argument(
        "--eprom", action="store_true", help="of the EPROM, even where the RAM has it; default: RAM first"
    )
    part_programs.add_language(show)
    put = _action(actions, "put", _put, "put a part program into the RAM; one of the same number is replaced")
    put.add_argument("number", type=_number, metavar="NN", help="number that it gets")
    put.add_argument("job", type=Path, metavar="JOB", help=f"{JOB}, which is copied")
    get = _action(actions, "get", _get, "write a workpiece as a part program")
    get.add_argument("number", type=_number, metavar="NN", help="workpiece, in RAM or EPROM")
    get.add_argument("--to", type=Path, required=True, metavar="OUT", help="the file to be written")
    compare = _action(actions, "compare", _compare, "compare two part programs, or RAM and EPROM (exit 1: differ)")
    compare.add_argument("jobs", nargs="*", type=Path, metavar="JOB", help=JOB)
    remove = _action(actions, "remove", _remove, "take a workpiece out of the RAM")
    remove.add_argument("number", type=_number, metavar="NN", help="workpiece")


def _action(
    actions: "argparse._SubParsersAction[argparse.ArgumentParser]",
    name: str,
    call: Callable[[argparse.Namespace], int],
    what: str,
) -> argparse.ArgumentParser:
    action = options.add_action(actions, name, call, what)
    options.add_machine(action, MACHINE)
    jobs.add_store(action)
    return action


def _number(text: str) -> int:
    from drillctl.generation.boiler_drum.names import number_of

    found = number_of(text)
    if found is None:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is no workpiece's number from 01 to 99")
    return found


def _stores(arguments: argparse.Namespace) -> "tuple[Store, Store]":
    """Returns the machine's two stores: RAM, then EPROM."""
    from drillctl.generation.boiler_drum.stores import read_eprom, read_ram

    machine = options.machine(arguments)
    eprom = read_eprom(machine)
    return read_ram(machine, arguments.store), eprom


def _list(arguments: argparse.Namespace) -> int:
    from drillctl.generation.boiler_drum.cells import free_cells, offset_of

    stores = _stores(arguments)
    damaged = [reason for store in stores for reason in store.damages()]
    for store in stores:
        count = Counted("{count} workpiece", "{count} workpieces", len(store.numbers()))
        cells = 0 if damaged else free_cells(store.cells, str(store.file))
        free = "" if damaged else f", {Counted('{count} cell free', '{count} cells free', cells)}"
        print(f"{store.kind}: {count}{free}")
        print("".join(f"  {number:02}  {offset_of(store.cells, number):04X}\n" for number in store.numbers()), end="")
    for reason in damaged:
        streams.tell(reason)
    return DIFFERENT if damaged else 0


def _show(arguments: argparse.Namespace) -> int:
    from drillctl.generation.boiler_drum.cells import FIRST_CELL, STORE_CELLS, cell_lines
    from drillctl.generation.errors import JobError

    part_programs.speak(arguments)
    ram, eprom = _stores(arguments)
    if arguments.number is None:
        store = eprom if arguments.eprom else ram
        print(f"{store.kind}: directory 0000-{FIRST_CELL - 1:04X}, programs {FIRST_CELL:04X}-{STORE_CELLS - 1:04X}")
        print("\n".join(cell_lines(store.cells, 0, STORE_CELLS - 1)))
        return 0
    stores = [eprom] if arguments.eprom else [ram, eprom]
    part = next((found for store in stores if (found := store.part(arguments.number))), None)
    if part is None:
        raise JobError(Message("no workpiece of this number").at(f"{arguments.number:02}"))
    print("\n".join(part_programs.lines(part)))
    return 0


def _put(arguments: argparse.Namespace) -> int:
    from drillctl.generation.boiler_drum.cells import with_program
    from drillctl.generation.boiler_drum.program import part_program
    from drillctl.generation.boiler_drum.stores import change_ram

    machine = options.machine(arguments)
    part = _part(arguments, machine, arguments.job)
    part_program(part, machine)  # raises where it leaves the travel
    number, sentences = arguments.number, part.sentences
    change_ram(machine, arguments.store, lambda cells, name: with_program(cells, number, sentences, name))
    print(f"RAM {number:02}: {Counted('{count} sentence', '{count} sentences', len(sentences))}")
    return 0


def _remove(arguments: argparse.Namespace) -> int:
    from drillctl.generation.boiler_drum.cells import numbers_in, without_program
    from drillctl.generation.boiler_drum.stores import change_ram
    from drillctl.generation.errors import JobError

    def removed(cells: bytes, name: str) -> bytes:
        if arguments.number not in numbers_in(cells):
            raise JobError(Message("no workpiece of this number").at(f"{arguments.number:02}").at(name))
        return without_program(cells, arguments.number)

    change_ram(options.machine(arguments), arguments.store, removed)
    return 0


def _get(arguments: argparse.Namespace) -> int:
    from drillctl.files.outputs import reserved
    from drillctl.generation.boiler_drum.stores import find_part
    from drillctl.generation.boiler_drum.text import part_text

    part = find_part(arguments.number, options.machine(arguments), arguments.store)
    with reserved([arguments.to], inputs=[arguments.store]) as (output,):
        assert output is not None
        output.write(lambda file: file.write(part_text(part.sentences, part.source)))
    return 0


def _compare(arguments: argparse.Namespace) -> int:
    from drillctl.generation.errors import JobError

    machine = options.machine(arguments)
    if len(arguments.jobs) not in (0, 2):
        raise JobError(Message("compare takes two part programs, or none for RAM and EPROM"))
    if arguments.jobs:
        one, other = (_part(arguments, machine, job) for job in arguments.jobs)
        differences = _part_differences(one, other)
    else:
        differences = _store_differences(*_stores(arguments))
    print("\n".join(differences or ["the same"]))
    return DIFFERENT if differences else 0


def _part(arguments: argparse.Namespace, machine: "Machine", job: Path) -> "Part":
    from drillctl.generation.boiler_drum.part import part_of

    return part_of(job, machine, arguments.store if arguments.store and arguments.store.exists() else None)


def _part_differences(one: "Part", other: "Part") -> list[str]:
    """Returns a line for each sentence that differs: its number, and both."""
    pairs = enumerate(zip_longest(one.sentences, other.sentences), start=1)
    return [f"{number:4}  {left or '------'}  {right or '------'}" for number, (left, right) in pairs if left != right]


def _store_differences(ram: "Store", eprom: "Store") -> list[str]:
    """Returns a line for each number that one store alone has, or that has different programs."""
    lines = []
    for number in sorted({*ram.numbers(), *eprom.numbers()}):
        parts: Mapping[str, Part | None] = {store.kind: store.part(number) for store in (ram, eprom)}
        programs = [part.sentences if part else None for part in parts.values()]
        if None in programs:
            lines.append(f"{number:02}  only in {next(kind for kind, part in parts.items() if part)}")
        elif programs[0] != programs[1]:
            lines.append(f"{number:02}  different")
    return lines

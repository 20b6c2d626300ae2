"""``drillctl tables list|show|where|copy``: tables by kind and name: which there are, their text, their file, and a
copy of one's own to edit.
"""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import options, streams
from drillctl.language import Message, known_words

if TYPE_CHECKING:
    from drillctl.machine import Library

KINDS = ("machines", "phase", "ramp", "motor", "dynamics", "converter")
NAMED = "KIND/NAME, as in phase/two-phase-forced"


def add(actions: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the actions to ``drillctl tables``."""
    every = actions.add_parser("list", help="list the tables", description="Lists the tables that can be found.")
    every.add_argument("kind", nargs="?", choices=KINDS, metavar="KIND", help=", ".join(KINDS))
    _action(every, list_names)
    show = actions.add_parser("show", help="print a table", description="Prints the text of a table.")
    show.add_argument("table", metavar="TABLE", help=NAMED)
    _action(show, show_text)
    where = actions.add_parser("where", help="say which file a table is", description="Prints the file of a table.")
    where.add_argument("table", metavar="TABLE", help=NAMED)
    _action(where, show_file)
    own = "Copies a table into the user's own tables, or another folder of tables, where it wins over the shipped one."
    copy = actions.add_parser("copy", help="copy a table to edit it", description=own)
    copy.add_argument("table", metavar="TABLE", help=NAMED)
    copy.add_argument("--to", type=options.folder, metavar="DIR", help="folder of tables; default: the user's own")
    _action(copy, copy_table)


def list_names(arguments: argparse.Namespace) -> int:
    """Prints KIND/NAME of each table, and its file where it is not the shipped one."""
    from drillctl.machine import shipped_tables

    library = options.library(arguments)
    for kind in [arguments.kind] if arguments.kind else KINDS:
        for name in library.names(kind):
            file = library.find(kind, name)
            own = "" if file is None or shipped_tables() in file.resolve().parents else f"  {file}"
            print(f"{kind}/{name}{own}")
    return 0


def show_text(arguments: argparse.Namespace) -> int:
    """Prints the table's text as it is."""
    from drillctl.machine.source import Source

    print(Source.read(_found(options.library(arguments), arguments.table)).text, end="")
    return 0


def show_file(arguments: argparse.Namespace) -> int:
    """Prints the table's file."""
    print(_found(options.library(arguments), arguments.table))
    return 0


def copy_table(arguments: argparse.Namespace) -> int:
    """Copies the table; one that is there already is left as it is."""
    from drillctl.files.outputs import OutputError, write_text
    from drillctl.machine import Library
    from drillctl.machine.library import user_tables
    from drillctl.machine.source import Source

    file = _found(options.library(arguments), arguments.table)
    target = (arguments.to or user_tables()) / file.parent.name / file.name
    if target.exists() or target.is_symlink():
        raise OutputError(Message("is there already; edit it, or remove it first").at(target))
    text = Source.read(file).text
    if problems := write_text(target, text):
        raise OutputError(*problems)
    searched = [folder.resolve() for folder in Library.standard(None).folders]
    found = "" if target.parents[1].resolve() in searched else f" with --tables {target.parents[1]}"
    streams.note(f"{target} is written; it wins over {file}{found}")
    return 0


def _action(action: argparse.ArgumentParser, call: object) -> None:
    options.add_tables(action)
    action.set_defaults(call=call)


def _found(library: "Library", table: str) -> Path:
    """The file of KIND/NAME. Raises TableError, which names what there is."""
    from drillctl.machine import TableError

    kind, _, name = table.partition("/")
    if kind not in KINDS:
        raise TableError(table, Message("a table is named KIND/NAME; kinds are {kinds}", kinds=", ".join(KINDS)))
    file = library.find(kind, name)
    if file is None:
        known = known_words(name, library.names(kind))
        raise TableError(table, Message("no {kind} table is named {name!r}; {words}", kind=kind, name=name,
        words=known))
    return file

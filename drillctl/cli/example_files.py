"""``drillctl examples [DIR]``: the example boards, queues and lab sheets that come with the program, listed, or copied
into a folder, with the pages of the documentation.
"""

import argparse
import shutil
from pathlib import Path

from drillctl.cli import options, streams
from drillctl.files.inputs import read_bytes
from drillctl.files.shipped import shipped
from drillctl.language import Message

LISTED = (".drl", ".kmd", ".sentences")
LARGEST_BYTES = 1 << 20
NOT_COPIED = ("__pycache__", "INSTRUCTOR.md")
PAGES = ("README.md", "CITATION.cff", "docs/*.md", "docs/howto/*.md", "docs/tutorials/*.md", "docs/pictures/*.svg")


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("examples", help="list the examples, or copy them", description=__doc__)
    into = "copy them and the documentation into this folder, which is made"
    verb.add_argument("folder", nargs="?", type=options.folder, metavar="DIR", help=into)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Lists each example with what it is; or copies all, where nothing in the folder would be replaced."""
    if arguments.folder is not None:
        _copy(arguments.folder)
        streams.note(f"{arguments.folder}: boards and queues are copied there; docs has lab sheets and all pages")
        return 0
    for file in sorted(shipped("examples", "examples").iterdir()):
        if file.suffix in LISTED:
            print(f"{file.name:24} {_first_words(file)}")
    for page in sorted(shipped("sheets", "docs/lab").glob("[0-9]*.md")):
        print(f"{page.stem:24} lab sheet {_lines(page)[0].removeprefix('# ')}")
    return 0


def _copy(folder: Path) -> None:
    """Raises OutputError, before anything is copied, where a name is taken; or for a folder that can't be made."""
    from drillctl.files.outputs import OutputError
    from drillctl.language import message_of

    examples, sheets = shipped("examples", "examples"), shipped("sheets", "docs/lab")
    wanted = {**_files(examples, folder), **_files(sheets, folder / "docs" / "lab"), **_pages(folder)}
    taken = next((target for target in wanted if target.exists() or target.is_symlink()), None)
    if taken is not None:
        raise OutputError(Message("is there already; give another folder").at(taken))
    try:
        for target, source in wanted.items():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
    except OSError as error:
        raise OutputError(message_of(error).at(folder)) from error


def _files(source: Path, folder: Path) -> dict[Path, Path]:
    """Where each file of a tree is to be copied to."""
    files = (file for file in sorted(source.rglob("*")) if file.is_file() and not set(file.parts) & set(NOT_COPIED))
    return {folder / file.relative_to(source): file for file in files}


def _pages(folder: Path) -> dict[Path, Path]:
    """As ``_files``, of the documentation, laid out as in the checkout: so every link leads somewhere."""
    source = shipped("pages", ".")
    return {folder / page.relative_to(source): page for pattern in PAGES for page in sorted(source.glob(pattern))}


def _first_words(file: Path) -> str:
    """The first comment of an example."""
    comments = (line[1:].strip() for line in _lines(file) if line[:1] in (";", "#"))
    return next(filter(None, comments), "")


def _lines(file: Path) -> list[str]:
    return read_bytes(file, LARGEST_BYTES, Message("an example")).decode().splitlines()

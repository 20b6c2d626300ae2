"""``drillctl completion SHELL``: prints what makes a shell complete drillctl's verbs, options and files.

``eval "$(drillctl completion bash)"`` in one's ``.bashrc``; ``drillctl completion zsh > ~/.zfunc/_drillctl`` for zsh;
``drillctl completion fish | source`` for fish.
"""

import argparse

SHELLS = ("bash", "zsh", "fish")


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("completion", help="make a shell complete verbs and options", description=__doc__)
    verb.add_argument("shell", choices=SHELLS, metavar="SHELL", help=", ".join(SHELLS))
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Prints the shell's script, made from the parser."""
    import shtab

    from drillctl.cli import parser

    print(shtab.complete(with_files(parser()), arguments.shell))
    return 0


def with_files(top: argparse.ArgumentParser) -> argparse.ArgumentParser:
    """Returns the parser with arguments that are paths marked as such, for the shell."""
    from pathlib import Path

    import shtab

    for verb in (top, *_inner(top)):
        for action in verb._actions:
            if action.type is Path:
                action.complete = shtab.FILE  # type: ignore[attr-defined]  # an attribute that shtab looks for
    return top


def _inner(parser: argparse.ArgumentParser) -> list[argparse.ArgumentParser]:
    """The parsers of verbs and of their actions."""
    found = []
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for inner in action.choices.values():
                found += [inner, *_inner(inner)]
    return found

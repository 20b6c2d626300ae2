"""The command line's parser: argparse, whose errors name the word that was probably meant.

Rule: what can't be understood is raised as UsageRefused; ``main`` prints it like any other refusal.
"""

import argparse
from collections.abc import Sequence
from typing import Any, NoReturn

from drillctl.cli.refusals import UsageRefused
from drillctl.language import Message, known_words, nearest, one_line


class Parser(argparse.ArgumentParser):
    """An ArgumentParser with examples below its help.

    examples  command lines that are shown below the help, a line each
    """

    examples: Sequence[str] = ()

    def __init__(self, *arguments: Any, **named: Any):
        super().__init__(*arguments, **named)
        self.color = False  # Python 3.14 would put escape sequences into the help

    def format_help(self) -> str:
        """Returns the help text, without the marks of docstrings, and the examples."""
        text = super().format_help().replace("``", "")
        return text + "".join(["\nexamples:\n", *(f"  {line}\n" for line in self.examples)] if self.examples else [])

    def error(self, message: str) -> NoReturn:
        """Raises UsageRefused with the message in one line."""
        raise UsageRefused(Message("{message} (see {prog} --help)", message=one_line(message), prog=self.prog))

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parses as argparse does; for an unknown option it suggests the one most like it."""
        found, unknown = self.parse_known_args(args, namespace)
        if unknown:
            verb = self.verbs().get(getattr(found, "verb", ""), self)
            meant = [nearest(word.partition("=")[0], verb.options()) for word in unknown if word.startswith("-")]
            hint = f"; did you mean {', '.join(filter(None, meant))}?" if any(meant) else ""
            verb.error(Message("unrecognized arguments: {names}{hint}", names=" ".join(unknown), hint=hint))
        return found

    def options(self) -> list[str]:
        """Returns the long options of this parser."""
        return [name for action in self._actions for name in action.option_strings if name.startswith("--")]

    def verbs(self) -> "dict[str, Parser]":
        """Returns the parsers of its verbs, by name."""
        return {
            name: verb
            for action in self._actions if isinstance(action, argparse._SubParsersAction)
            for name, verb in action.choices.items()
        }  # fmt: skip

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Replaces argparse's own check: names the choices, and the one most like the word."""
        if action.choices is not None and value not in action.choices:
            words = known_words(str(value), action.choices)
            reason = Message("invalid choice: {value!r}; {words}", value=value, words=words)
            raise argparse.ArgumentError(action, reason)

"""What the lab refuses: a question, a table or a trace that it can't work on, with what to do about it."""

from drillctl.language import Refusal


class LabError(Refusal):
    """A refusal for the operator; ``str()`` says what is wrong and what to do."""

    kind = "lab"

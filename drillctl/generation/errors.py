"""Whose fault: the operator's input. Raised before anything moves; one line a problem."""

from drillctl.language import Refusal


class JobError(Refusal):
    """A job that can't be done; its messages are lines such as ``FILE:LINE: reason``."""

    kind = "job"

"""What the lab refuses, for the operator: a question that it can't answer, with what to ask instead."""


class LabError(Exception):
    """``str()`` says what is wrong, and what to do."""

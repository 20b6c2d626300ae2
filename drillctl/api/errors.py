"""The one error that the public functions raise for what a caller got wrong."""

from drillctl.language import Refusal as Refused

__all__ = ["Refused"]

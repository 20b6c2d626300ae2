"""The names of a machine with three axes, two outputs and two inputs."""

import pytest

from drillctl.kmd import Names


@pytest.fixture
def names() -> Names:
    return Names(("x", "y", "z"), {"spindle": 18, "clamp": 40}, {"x_min": 0, "z_top": 4})

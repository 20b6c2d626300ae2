"""The eight-axis drill with everything near, as a machine's file, and a board of three holes and two tools for it."""

from tests.machine.test_parameters import text_with

BOARD = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nG90\nT1\nX4.0Y4.0\nT2\nX5.0Y4.0\nX5.0Y5.0\nM30\n"


def near_text() -> str:
    """The shipped machine with everything near: parking, four places of the magazine, boards."""
    text = text_with(
        ("[parameters.system]", "parking_x_mm", "7.0"), ("[parameters.system]", "parking_y_mm", "3.0"),
        ("[parameters.system]", "change_height_mm", "2.0"), ("[parameters.system]", "depth_detection_depth_mm", "0.2"),
        ("[parameters.machining]", "tool_change", '"AUTOMATIC"'),
        ("[drill]", "down", "300"), ("[drill]", "clear", "250"),
    )  # fmt: skip
    for old, new in (
        ("place = 4\nx_mm = 136.0\ny_mm = 490.0", "place = 4\nx_mm = 9.0\ny_mm = 4.0"),
        ("place = 5\nx_mm = 148.0\ny_mm = 490.0", "place = 5\nx_mm = 11.0\ny_mm = 4.0"),
        ("place = 3\nx_mm = 124.0\ny_mm = 490.0", "place = 3\nx_mm = 13.0\ny_mm = 4.0"),
        ("place = 6\nx_mm = 160.0\ny_mm = 490.0", "place = 6\nx_mm = 15.0\ny_mm = 4.0"),
        ("= 3700", "= 280"), ("delay_s = 0.5", "delay_s = 0.05"),
        ("start = 5000", "start = 300"), ("start = 3000", "start = 300"),
    ):  # fmt: skip
        assert old in text
        text = text.replace(old, new)
    return text

"""The colours of pictures: told apart by people who see red and green alike, and seen on their paper.

Simulated by the matrices of Machado, Oliveira and Fernandes (2009) at full severity, on linear RGB; the distance is
that of CIE 1976 in L*a*b*, of which 2.3 is just noticed.
"""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest

from drillctl.ui.widgets.series_colours import LOOKS, Look

PAGE = Path(__file__).resolve().parents[2] / "drillctl" / "ui" / "report" / "page.css"
SEEN = {
    "everybody": np.eye(3),
    "protanopia": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deuteranopia": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
}
XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])  # sRGB, D65
LEAST_DISTANCE, LEAST_CONTRAST = 25.0, 3.0  # the latter: WCAG 2.1 for what is drawn


def linear(colour: str) -> np.ndarray:
    rgb = np.array([int(colour[at : at + 2], 16) for at in (1, 3, 5)]) / 255
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


def lab(rgb: np.ndarray) -> np.ndarray:
    ratio = XYZ @ np.clip(rgb, 0, 1) / (XYZ @ np.ones(3))
    f = np.where(ratio > (6 / 29) ** 3, np.cbrt(ratio), ratio / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def distance(first: str, second: str, eyes: np.ndarray) -> float:
    return float(np.linalg.norm(lab(eyes @ linear(first)) - lab(eyes @ linear(second))))


def contrast(first: str, second: str) -> float:
    dark, light = sorted(float((XYZ @ linear(colour))[1]) for colour in (first, second))
    return (light + 0.05) / (dark + 0.05)


def test_what_is_known_of_the_measure() -> None:
    """Red and green of one lightness are far apart for most people, and near each other for the others."""
    red, green = "#c03030", "#4d7d1f"
    assert distance(red, green, SEEN["everybody"]) > 80
    assert distance(red, green, SEEN["deuteranopia"]) < LEAST_DISTANCE
    assert contrast("#000000", "#ffffff") == pytest.approx(21)


@pytest.mark.parametrize("eyes", SEEN)
@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_any_two_series_are_told_apart(look: Look, eyes: str) -> None:
    for first, second in itertools.combinations(look.series, 2):
        assert distance(first, second, SEEN[eyes]) >= LEAST_DISTANCE, (first, second)


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_everything_is_seen_on_its_paper(look: Look) -> None:
    assert min(contrast(colour, look.paper) for colour in look.series) >= LEAST_CONTRAST
    assert contrast(look.ink, look.paper) >= 7


def test_the_page_of_a_run_has_the_same_colours() -> None:
    """page.css has the light ones first, then those for a browser that asks for dark."""
    told = [re.findall(r"--t\d: (#[0-9a-f]{6})", part) for part in PAGE.read_text().split("prefers-color-scheme")]
    assert [tuple(colours) for colours in told] == [look.series for look in LOOKS.values()]

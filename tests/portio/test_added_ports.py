"""Ports of other distributions, found by the entry points of dist-info folders on sys.path."""

import json
import sys
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.portio import registry
from drillctl.portio.registry import PORTS, open_port, port_of_card, select
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import PortRefused
from tests.portio.conformance import WIRING, StandInPlant

MODULE = """
from drillctl.language import Message
from drillctl.portio.registry import Port

ADDED = Port("lpt", Message("a printer port"), Message("nothing"), "", True, lambda: None,
             lambda address, layout, card: card)
"""


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "added_lpt", raising=False)
    (tmp_path / "added_lpt.py").write_text(MODULE, "utf-8")
    return tmp_path


def install(site: Path, owner: str, name: str, value: str) -> None:
    folder = site / f"{owner}-1.0.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {owner}\nVersion: 1.0\n", "utf-8")
    (folder / "entry_points.txt").write_text(f"[drillctl.drivers]\n{name} = {value}\n", "utf-8")


def listed(capsys: pytest.CaptureFixture[str]) -> list[dict[str, str]]:
    assert main(["ports", "--json"]) == 0
    rows: list[dict[str, str]] = json.loads(capsys.readouterr().out)
    return rows[len(PORTS) :]


def test_an_added_port_is_opened_and_listed(site: Path, capsys: pytest.CaptureFixture[str]) -> None:
    install(site, "printercards", "lpt", "added_lpt:ADDED")
    card = SimulatedCard(StandInPlant())
    assert open_port("lpt:378", WIRING, card) is card and select("lpt:378")[1] == "378"
    assert port_of_card("lpt") == "lpt"
    assert [(row["name"], row["usable"]) for row in listed(capsys)] == [("lpt", True)]
    with pytest.raises(PortRefused, match="did you mean lpt"):
        select("lpd")


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("added_nowhere:ADDED", "printercards, can't be loaded: ModuleNotFoundError"),
        ("added_lpt:NONE", "printercards, can't be loaded: AttributeError"),
        ("added_lpt:Port", "printercards gives added_lpt:Port, which is no Port of this name"),
    ],
)
def test_one_that_cannot_be_loaded_is_refused_with_its_distribution(
    site: Path, capsys: pytest.CaptureFixture[str], value: str, reason: str
) -> None:
    install(site, "printercards", "lpt", value)
    with pytest.raises(PortRefused, match=reason):
        select("lpt")
    (row,) = listed(capsys)
    assert not row["usable"] and reason in row["reason"]


def test_a_shipped_port_keeps_its_name(site: Path, capsys: pytest.CaptureFixture[str]) -> None:
    install(site, "printercards", "firmata", "added_lpt:ADDED")
    assert select("firmata")[0] is PORTS["firmata"]
    (row,) = listed(capsys)
    assert not row["usable"] and "printercards adds a port of this name, which drillctl has too" in row["reason"]


def test_two_distributions_with_one_name_are_both_refused(site: Path) -> None:
    install(site, "printercards", "lpt", "added_lpt:ADDED")
    install(site, "othercards", "lpt", "added_lpt:ADDED")
    with pytest.raises(PortRefused, match=r"(?=.*printercards)(?=.*othercards)"):
        select("lpt")


def test_distributions_are_looked_through_only_for_a_name_that_is_not_shipped(monkeypatch: pytest.MonkeyPatch) -> None:
    looks: list[str] = []
    monkeypatch.setattr(registry, "_entries", lambda: looks.append("look") or [])
    for name in PORTS:
        select(name)
        port_of_card(name)
    assert looks == []
    with pytest.raises(PortRefused):
        select("lpt")
    assert looks == ["look"]


def test_a_port_must_have_the_name_of_its_entry_point(site: Path) -> None:
    install(site, "printercards", "parallel", "added_lpt:ADDED")
    with pytest.raises(PortRefused, match="printercards gives added_lpt:ADDED, which is no Port of this name"):
        select("parallel")

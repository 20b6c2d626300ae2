"""What forges read (issue forms, workflows, the citation) names what is there, and no host of a registry."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from drillctl import __version__
from drillctl.cli import parser

yaml = pytest.importorskip("yaml")

ROOT = Path(__file__).resolve().parents[2]
FORMS = sorted(path for path in (ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml") if path.name != "config.yml")
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
ACTION = re.compile(r"actions/(checkout|setup-python|upload-artifact)@v\d+")
KINDS = {"markdown", "input", "textarea", "dropdown", "checkboxes"}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def read(file: Path) -> Any:
    return yaml.load(file.read_text("utf-8"), Loader=yaml.BaseLoader)  # every value a string, and the key "on" as well


@pytest.mark.parametrize("file", FORMS, ids=lambda file: file.stem)
def test_an_issue_form_is_one_and_asks_for_the_version(file: Path) -> None:
    form = read(file)
    assert form["name"] and form["description"] and set(form) == {"name", "description", "labels", "body"}
    asked = [each for each in form["body"] if each["type"] != "markdown"]
    names = [each["id"] for each in asked]
    assert len(names) == len(set(names)) > 3
    for each in form["body"]:
        assert each["type"] in KINDS and set(each) <= {"type", "id", "attributes", "validations"}
        assert each["attributes"].get("label") or each["attributes"].get("value")
    assert any("drillctl -V and drillctl where" in each["attributes"]["label"] for each in asked)


@pytest.mark.parametrize("file", [*FORMS, *WORKFLOWS], ids=lambda file: file.stem)
def test_verbs_options_and_pages_that_are_named_exist(file: Path) -> None:
    text = file.read_text("utf-8")
    verbs = parser().verbs()
    assert set(re.findall(r"drillctl ([a-z]+)", text)) <= {*verbs, "and"}
    for verb, rest in re.findall(r"`drillctl ([a-z]+) ([^`]*)`", text):
        assert set(re.findall(r"--[a-z-]+", rest)) <= set(verbs[verb].options())
    assert all((ROOT / page).is_file() for page in re.findall(r"docs/[\w/-]+\.md", text))
    assert "://" not in text


def steps(file: Path) -> list[dict[str, Any]]:
    return [step for job in read(file)["jobs"].values() for step in job["steps"]]


@pytest.mark.parametrize("file", WORKFLOWS, ids=lambda file: file.stem)
def test_a_workflow_runs_what_is_there(file: Path) -> None:
    for step in steps(file):
        assert len({"uses", "run"} & set(step)) == 1
        assert ACTION.fullmatch(step.get("uses", "actions/checkout@v4"))
        for script in re.findall(r"(?:^|\s)(\.ci/\w+|docs/[\w/]+\.py)", step.get("run", "")):
            assert (ROOT / script).stat().st_mode & 0o100, script
        for extra in re.findall(r"\.\[(\w+)\]", step.get("run", "")):
            assert extra in PROJECT["optional-dependencies"]


def test_the_workflow_tries_each_python_that_is_declared() -> None:
    (jobs,) = [read(file)["jobs"] for file in WORKFLOWS]
    tried = jobs["test"]["strategy"]["matrix"]["python"]
    declared = [line.rpartition(" ")[2] for line in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", line)]
    assert tried == declared and f">={tried[0]}" == PROJECT["requires-python"]
    (ours,) = [step for step in jobs["test"]["steps"] if step.get("run") == ".ci/run"]
    assert "PYTHON" in ours["env"] and "${PYTHON:-python3}" in (ROOT / ".ci/run").read_text("utf-8")
    assert any("--drillctl-report pages" in step.get("run", "") for step in jobs["test"]["steps"])


def test_the_citation_names_the_three_papers_and_this_version() -> None:
    citation = read(ROOT / "CITATION.cff")
    assert citation["cff-version"] == "1.2.0" and citation["version"] == __version__
    assert citation["license"] == PROJECT["license"] and citation["message"] and citation["authors"]
    papers = citation["references"]
    assert len(papers) == 3
    for paper in papers:
        assert paper["type"] == "article" and paper["title"] and paper["authors"]
        assert "year" in paper or re.fullmatch(r"\d{4}-\d\d-\d\d", paper["date-published"])
    assert papers[0]["authors"][0]["family-names"] == "Arendt" and papers[0]["year"] == "1996"

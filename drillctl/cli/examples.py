"""Two command lines for each verb's help. ``tests/cli/test_cli_examples.py`` runs them.

Rule: a line may name files of ``examples/`` in a checkout, and files that an earlier line of this table has written.
"""

from collections.abc import Mapping, Sequence

EXAMPLES: Mapping[str, Sequence[str]] = {
    "drillctl": (
        "drillctl inspect examples/blinker.drl",
        "drillctl run examples/blinker.drl --holes holes.csv",
    ),
    "run": (
        "drillctl run examples/blinker.drl --order optimised --trace board.trace",
        "drillctl run examples/short-moves.kmd --plant dynamic --vcd moves.vcd",
    ),
    "resume": (
        "drillctl resume",
        "drillctl resume board.journal --holes rest.csv",
    ),
    "estimate": (
        "drillctl estimate examples/blinker.drl",
        "drillctl estimate examples/blinker.drl --order nearest --json",
    ),
    "inspect": (
        "drillctl inspect examples/blinker.drl",
        "drillctl inspect examples/blinker.drl --format inch,decimal --json",
    ),
    "convert": (
        "drillctl convert examples/blinker.drl --to clean.drl --style mm,decimal",
        "drillctl convert examples/blinker.drl --to board.kmd --order optimised",
    ),
    "replay": (
        "drillctl replay board.trace",
        "drillctl replay board.trace --same-tables --engine tick",
    ),
    "parameters": (
        "drillctl parameters list system machining",
        "drillctl parameters help axis.x.s_share",
    ),
    "magazine": (
        "drillctl magazine list",
        "drillctl magazine list --machine eight-axis",
    ),
    "machines": (
        "drillctl machines",
        "drillctl machines --json",
    ),
    "tables": (
        "drillctl tables check tables/ramp/seven-state.toml",
        "drillctl tables check tables/machines/pcb-drill.toml",
    ),
    "ports": (
        "drillctl ports",
        "drillctl ports --json",
    ),
    "latency": (
        "drillctl latency --seconds 2",
        "drillctl latency --machine eight-axis --moving --seconds 2",
    ),
    "screen": (
        "drillctl screen",
        "drillctl screen --machine boiler-drum --lang pl",
    ),
    "scope": (
        "drillctl scope board.trace",
        "drillctl scope board.trace --from-tick 500",
    ),
    "plot": (
        "drillctl plot holes.csv",
        "drillctl plot board.trace --what motion --axis x --seconds 1:3",
    ),
    "report": (
        "drillctl report board.trace -o board.html",
        "drillctl report board.trace --lang pl -o przebieg.html",
    ),
    "grade": (
        "drillctl grade 01 submissions/* --csv grades.csv",
        "drillctl grade my-sheet/ submissions/* --junit grades.xml",
    ),
    "examples": (
        "drillctl examples",
        "drillctl examples my-examples",
    ),
    "where": (
        "drillctl where",
        "drillctl where --json",
    ),
    "completion": (
        "drillctl completion bash",
        "drillctl completion zsh",
    ),
    "sweep": (
        "drillctl sweep --hz 500:600:50 --steps 10 --out rates.csv",
        "drillctl sweep --board examples/relay.drl --hz 440 --out board.csv",
    ),
    "tune": (
        "drillctl tune pcb-drill --axis x --out tuned-pcb-drill-x.toml",
        "drillctl tune pcb-drill --margin 1.5 --out careful.toml --name careful",
    ),
    "store": (
        "drillctl store put 03 examples/drum-row.sentences --store ram.hex",
        "drillctl store compare 03 examples/drum-row.sentences --store ram.hex",
    ),
}

"""What drillctl costs who only has it installed: ``python -m benchmarks.imports``.

``import drillctl``; pytest on one empty test, with the plugin and without it, and no other plugins. Processor time,
user and system, median and least of seven, in turn, each in a process of its own. On a busy computer the median swings
by a tenth, the least says more. Goals: the import under 5 ms, the plugin too.
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROUNDS = 7
BARE = "pass"
IMPORT = "import drillctl"
RUN = "import drillctl; drillctl.run('KMD_GOTOdXdY 1 0')"
TEST = "def test_empty():\n    pass\n"


def cpu_ms(command: list[str], folder: str) -> float:
    """Of a process and what it has started."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    alone = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    subprocess.run([sys.executable, *command], cwd=folder, env=alone, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1000 * (after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)


def figures(commands: dict[str, list[str]], folder: str) -> dict[str, tuple[float, float]]:
    """Median and least, in turn, so that another load meets all; the first round fills caches and is left out."""
    rounds = [{name: cpu_ms(command, folder) for name, command in commands.items()} for _ in range(ROUNDS + 1)][1:]
    values = {name: [each[name] for each in rounds] for name in commands}
    return {name: (statistics.median(every), min(every)) for name, every in values.items()}


def main() -> None:
    """Prints the figures, and what one has over the other."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "test_empty.py").write_text(TEST)
        pytest = ["-m", "pytest", "-q", "-p", "no:cacheprovider"]
        found = figures(
            {
                "python": ["-c", BARE],
                "import drillctl": ["-c", IMPORT],
                "drillctl.run": ["-c", RUN],
                "pytest without the plugin": pytest,
                "pytest with it": [*pytest, "-p", "drillctl.api.pytest_plugin"],
            },
            folder,
        )
    for name, (median, least) in found.items():
        print(f"{name:28} {median:7.1f} ms, least {least:6.1f}")
    for name, more, less in (
        ("the import itself", "import drillctl", "python"),
        ("the plugin itself", "pytest with it", "pytest without the plugin"),
    ):
        print(f"{name:28} {found[more][0] - found[less][0]:7.1f} ms, least {found[more][1] - found[less][1]:6.1f}")
    print(f"load {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores")


if __name__ == "__main__":
    main()

"""Builds the compiled form of the dynamic plant's law where Cython and a C compiler are there.

Rule: it can't fail. What is missing is said in one line (pip shows it with -v), and the package is complete without
the compiled form: the law then runs as Python.
"""

import os
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

try:
    from hatchling.builders.hooks.plugin.interface import BuildHookInterface
except ModuleNotFoundError:  # run by hand
    BuildHookInterface = object

FOLDER = "drillctl/plant/dynamic"
SOURCES = ("law.py", "law.pxd")
# No contraction of a product and a sum into one rounding, and no fast-math: the plain form rounds each.
FLAGS = ["-O2", "-ffp-contract=off"]
DIRECTIVES = {
    "language_level": "3", "boundscheck": False, "wraparound": False, "cdivision": True, "initializedcheck": False,
    "annotation_typing": False,
}  # fmt: skip


class KernelHook(BuildHookInterface):  # type: ignore[misc]
    """Called by hatchling for a wheel and for an editable install."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compiles the law beside its source and adds it to what is installed; not with DRILLCTL_KERNEL=plain."""
        if self.target_name != "wheel" or os.environ.get("DRILLCTL_KERNEL") == "plain":
            return
        folder = Path(self.root, FOLDER)
        for old in folder.glob("_law.*"):
            old.unlink()
        try:
            built = build(folder)
        except (Exception, SystemExit) as error:  # whatever a compiler's tools may raise: the package works without
            print(f"drillctl: the dynamic plant runs uncompiled: {error}", file=sys.stderr)
            return
        build_data["pure_python"], build_data["infer_tag"] = False, True
        build_data["force_include"][str(built)] = f"{FOLDER}/{built.name}"


def build(folder: Path) -> Path:
    """Compiles the law in ``folder`` into a module _law there; returns its file."""
    from Cython.Build import cythonize
    from setuptools import Distribution, Extension
    from setuptools.command.build_ext import build_ext

    with tempfile.TemporaryDirectory() as scratch:
        module = Path(scratch, "_law.py")
        module.write_text(f'{(folder / "law.py").read_text()}\nDIGEST = "{_digest(folder)}"\n')
        shutil.copy(folder / "law.pxd", Path(scratch, "_law.pxd"))
        extension = Extension("_law", [str(module)], extra_compile_args=FLAGS)
        modules = cythonize([extension], compiler_directives=DIRECTIVES, build_dir=scratch, quiet=True)
        command = build_ext(Distribution({"ext_modules": modules}))
        command.build_lib = command.build_temp = scratch
        command.ensure_finalized()
        command.run()
        made = Path(command.get_ext_fullpath("_law"))
        return Path(shutil.copy(made, folder / made.name))


def _digest(folder: Path) -> str:
    """As drillctl.plant.dynamic.kernel has it, which compares the two."""
    from hashlib import sha256

    return sha256(b"".join((folder / name).read_bytes() for name in SOURCES)).hexdigest()


if __name__ == "__main__":  # in a clone, after the law was changed: python hatch_build.py
    print(build(Path(__file__).parent / FOLDER))

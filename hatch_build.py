"""Builds what is compiled: the catalogues of the other languages, the dynamic plant's law, the loop that writes VCD.

catalogues  ``.po`` to ``.mo``, by polib; each has the digest of its source, which drillctl/language/words.py compares
loops       where Cython and a C compiler are there. This can't fail: what is missing is said in one line (pip shows it
            with -v), and the package is complete without, only slower
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

LOCALE = "drillctl/locale"
# What `drillctl examples DIR` copies to be read, as drillctl/cli/example_files.py has it. Lab sheets: pyproject.toml.
PAGES = ("README.md", "CITATION.cff", "docs/*.md", "docs/howto/*.md", "docs/tutorials/*.md", "docs/pictures/*.svg")
# Each .py, and the .pxd with its C types; one that calls another stands behind it.
LOOPS = ("drillctl/plant/dynamic/motors", "drillctl/plant/dynamic/law", "drillctl/trace/vcd_lines")
# No contraction of a product and a sum into one rounding, and no fast-math: the plain form rounds each.
FLAGS = ["-O2", "-ffp-contract=off"]
DIRECTIVES = {
    "language_level": "3", "boundscheck": False, "wraparound": False, "cdivision": True, "initializedcheck": False,
    "annotation_typing": False,
}  # fmt: skip


class CompilingHook(BuildHookInterface):  # type: ignore[misc]
    """Called by hatchling for a wheel and for an editable install."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compiles catalogues and loops beside their sources and adds them to what is installed; with
        DRILLCTL_KERNEL=plain the catalogues alone.
        """
        if self.target_name != "wheel":
            return
        for catalogue in compiled_catalogues(Path(self.root)):
            build_data["force_include"][str(catalogue)] = str(catalogue.relative_to(self.root))
        for pattern in PAGES:
            for page in Path(self.root).glob(pattern):
                build_data["force_include"][str(page)] = f"drillctl/pages/{page.relative_to(self.root).as_posix()}"
        if os.environ.get("DRILLCTL_KERNEL") == "plain":
            return
        for loop in LOOPS:
            name = Path(loop).name
            for old in Path(self.root, loop).parent.glob(f"_{name}.*"):
                old.unlink()
            try:
                built = build(Path(self.root), loop)
            except (Exception, SystemExit) as error:  # whatever a compiler's tools may raise: the package works without
                print(f"drillctl: {name} runs uncompiled: {error}", file=sys.stderr)
                continue
            build_data["pure_python"], build_data["infer_tag"] = False, True
            build_data["force_include"][str(built)] = str(built.relative_to(self.root))


def compiled_catalogues(root: Path) -> list[Path]:
    """Compiles each catalogue below ``root`` that isn't compiled from its present text; returns the files of all.

    A file is complete or absent at any time, so several processes may call this at once.
    """
    from hashlib import sha256

    import polib

    made = []
    for source in sorted(Path(root, LOCALE).rglob("*.po")):
        text, target = source.read_bytes(), source.with_suffix(".mo")
        digest = sha256(text).hexdigest()
        if not target.exists() or digest.encode() not in target.read_bytes():
            catalogue = polib.pofile(text.decode())
            catalogue.metadata["X-Source-SHA256"] = digest
            with tempfile.NamedTemporaryFile(dir=source.parent, suffix=".new", delete=False) as new:
                new.write(catalogue.to_binary())
            Path(new.name).chmod(0o644)
            Path(new.name).replace(target)
        made.append(target)
    return made


def build(root: Path, loop: str) -> Path:
    """Compiles one of LOOPS of the tree ``root`` into _NAME beside it; returns its file."""
    from Cython.Build import cythonize
    from setuptools import Distribution, Extension
    from setuptools.command.build_ext import build_ext

    with tempfile.TemporaryDirectory() as scratch:
        sources = {each: _copied(root, each, Path(scratch)) for each in LOOPS}
        name = ".".join(sources[loop].relative_to(scratch).with_suffix("").parts)
        extension = Extension(name, [str(sources[loop])], extra_compile_args=FLAGS)
        modules = cythonize(
            [extension], compiler_directives=DIRECTIVES, include_path=[scratch], build_dir=scratch, quiet=True
        )
        command = build_ext(Distribution({"ext_modules": modules}))
        command.build_lib = command.build_temp = scratch
        command.ensure_finalized()
        command.run()
        made = Path(command.get_ext_fullpath(name))
        return Path(shutil.copy(made, Path(root, loop).parent / made.name))


def _copied(root: Path, loop: str, scratch: Path) -> Path:
    """Copies a module as _NAME, with its digest, into its package below ``scratch``, where others find its C types."""
    source = root / loop
    target = (scratch / loop).with_name(f"_{source.name}.py")
    target.parent.mkdir(parents=True, exist_ok=True)
    for package in target.relative_to(scratch).parents:
        (scratch / package / "__init__.py").touch()
    target.write_text(f'{source.with_suffix(".py").read_text()}\nDIGEST = "{_digest(source)}"\n')
    shutil.copy(source.with_suffix(".pxd"), target.with_suffix(".pxd"))
    return target


def _digest(loop: Path) -> str:
    """As drillctl.files.compiled has it, which compares the two."""
    from hashlib import sha256

    return sha256(b"".join(loop.with_suffix(suffix).read_bytes() for suffix in (".py", ".pxd"))).hexdigest()


if __name__ == "__main__":  # in a clone, after a catalogue or a loop was changed: python hatch_build.py
    print(*compiled_catalogues(Path(__file__).parent), sep="\n")
    print(*(build(Path(__file__).parent, loop) for loop in LOOPS), sep="\n")

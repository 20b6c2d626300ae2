"""The compiled form of a module, where it was built from the present text of that module.

Rule: both forms give the same results, so nothing but time depends on it. hatch_build.py compiles ``NAME.py``, whose C
types are in ``NAME.pxd``, into ``_NAME`` beside it. DRILLCTL_KERNEL=plain in the environment leaves all of them unused.
A module whose text was changed since it was compiled says so: a run takes many times longer, and shows no other sign.
"""

import logging
import os
from collections.abc import Callable
from hashlib import sha256
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType

SUFFIXES = (".py", ".pxd")
LOG = logging.getLogger(__name__)


def digest(name: str, read: Callable[[str], bytes]) -> str:
    """Returns what tells one text of module ``name`` from another; ``read`` returns the bytes of a file beside it."""
    return sha256(b"".join(read(name + suffix) for suffix in SUFFIXES)).hexdigest()


def compiled_form(plain: ModuleType) -> ModuleType | None:
    """Returns the compiled form of a module; None where there is none, or it was built from another text, or is not to
    be used.
    """
    package, _, name = plain.__name__.rpartition(".")
    compiled = f"{package}._{name}"
    if os.environ.get("DRILLCTL_KERNEL") == "plain" or find_spec(compiled) is None or plain.__spec__ is None:
        LOG.info("%s runs as Python: its compiled form is not there, or not to be used", plain.__name__)
        return None
    loader, folder = plain.__spec__.loader, os.path.dirname(plain.__file__ or "")
    # Every loader of source files has get_data, pytest's too; its declared type, the least of a loader, has not.
    here = digest(name, lambda file: loader.get_data(os.path.join(folder, file)))  # type: ignore[union-attr]
    if (found := _loaded(compiled)) is not None and here == found.DIGEST:
        return found
    LOG.warning("%s was changed since it was compiled, and runs many times more slowly as Python: hatch_build.py"
                " compiles it", plain.__name__)  # fmt: skip
    return None


def _loaded(compiled: str) -> ModuleType | None:
    """Returns a compiled module; None for one that was built beside another text of a compiled module that it calls."""
    try:
        return import_module(compiled)
    except (ImportError, TypeError):
        return None

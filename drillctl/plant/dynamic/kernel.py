"""Which form of the law runs: the compiled one where its two modules were built from their present text, else the
plain one.

Rule: both give the same bits, so nothing but time depends on the choice. DRILLCTL_KERNEL=plain in the environment
chooses the plain one.
"""

from array import array
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.files.compiled import compiled_form
from drillctl.plant.dynamic import law, motors
from drillctl.plant.dynamic.coefficients import SINE, SLOPE

Floats = Sequence[float]
Images = NDArray[np.uint64]


@dataclass(frozen=True, slots=True)
class Kernel:
    """The functions of the law in one form, and the sines as that form reads them quickest."""

    compiled: bool
    step: Callable[[Any, int, Floats, Floats], bool]
    load: Callable[[Any, int, float, float], None]
    supply: Callable[[Any, int, Any, int, int], None]
    run: Callable[..., int]
    sine: Floats
    slope: Floats

    @classmethod
    def of(cls, motors: ModuleType, law: ModuleType, compiled: bool) -> "Kernel":
        """From motors.py and law.py, or the modules that were compiled from them."""
        kind = floats if compiled else tuple
        return cls(compiled, motors.step, motors.load, motors.supply, law.run, kind(SINE), kind(SLOPE))

    def numbers(self, values: Sequence[float]) -> Any:
        """Returns these floats as this form reads and changes them quickest."""
        return floats(values) if self.compiled else list(values)

    def images(self, images: Images) -> Sequence[int] | Images:
        """Returns output images (ticks,) as ``run`` reads them."""
        return images if self.compiled else images.tolist()


def floats(values: Sequence[float]) -> "array[float]":
    """Returns these floats as the compiled form reads and changes them; the plain one can too."""
    return array("d", values)


PLAIN = Kernel.of(motors, law, compiled=False)


def _chosen() -> Kernel:
    """The compiled law calls the compiled motors by itself: both are used, or neither."""
    found, caller = compiled_form(motors), compiled_form(law)
    return PLAIN if found is None or caller is None else Kernel.of(found, caller, compiled=True)


KERNEL = _chosen()

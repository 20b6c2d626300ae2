"""A board's journey with the drill up, and how far it is. Called by station."""

from dataclasses import replace

import numpy as np

from drillctl.generation.job import Job
from drillctl.generation.strokes import record
from drillctl.kmd import Op


def dry_run(job: Job) -> Job:
    """The same journey with the drill up: every stroke down is left out, and no tool is changed."""
    kept = job.program[~np.isin(job.program["opcode"], (Op.WIERTLO_DOL, Op.RUCH, Op.NARZEDZIE))].copy()
    up = np.concatenate([kept[:1], record(Op.WIERTLO_GORA), kept[1:]])
    up["sequence"] = np.arange(1, len(up) + 1)
    return replace(job, program=up)


def visited(job: Job, done: int) -> int:
    """Numbered holes that the head has been over, once so many commands are done; in a dry run none is drilled."""
    tags = job.program["tag"][:done]
    return len(np.unique(tags[tags > 0])) if job.work else 0

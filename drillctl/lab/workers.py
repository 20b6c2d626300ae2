"""Many processes on one question: rows come back in the order of its machines, whichever process is quicker.

Rule: nothing here changes a byte of the rows. On this computer by its cores; on a cluster through joblib's dask
backend, an extra (``pip install '.[cluster]'`` in a clone).
"""

import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait
from typing import Any

from drillctl.files import system
from drillctl.lab.answers import answer
from drillctl.lab.errors import LabError
from drillctl.lab.question import Question
from drillctl.language import Message, message_of

CHUNKS_A_THREAD = 4  # sent to a cluster at once: what is done is kept after each such load
CONNECT_S = 20
Rows = Iterator[list[str]]


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def on_cores(question: Question, chunks: list[range], workers: int) -> Rows:
    """Yields the rows of each chunk, from so many processes; one worker is this process."""
    if min(workers, len(chunks)) <= 1:
        yield from (answer(question, chunk) for chunk in chunks)
        return
    pool = ProcessPoolExecutor(workers, get_context("spawn"), initializer=_serve)
    try:
        yield from pool.map(partial(answer, question), chunks)
    finally:
        pool.shutdown(cancel_futures=True)


def on_cluster(question: Question, chunks: list[range], address: str) -> Rows:
    """Yields the rows of each chunk, from workers of a dask scheduler (``tcp://HOST:PORT``); they need drillctl too.

    Raises LabError where the extra is missing or nobody answers at the address.
    """
    try:
        from distributed import Client
        from joblib import Parallel, delayed, parallel_config
    except ImportError as error:
        raise LabError(Message("--cluster needs dask and joblib: pip install 'dask[distributed]' joblib")) from error
    try:
        make: Any = Client  # distributed has no type hints, and need not be installed
        client = make(address, timeout=CONNECT_S)
    except (OSError, ValueError) as error:
        raise LabError(
            Message(
                "--cluster {address}: no dask scheduler answers there ({error})",
                address=address,
                error=message_of(error),
            )
        ) from error
    with client, parallel_config(backend="dask"):
        load = CHUNKS_A_THREAD * max(1, sum(client.nthreads().values()))
        for first in range(0, len(chunks), load):
            yield from Parallel()(delayed(answer)(question, chunk) for chunk in chunks[first : first + load])


def _serve() -> None:
    """What a worker runs first: it ignores Ctrl-C, which its parent handles, and ends when the parent has."""
    for number in system.signals("SIGINT", "SIGHUP"):
        signal.signal(number, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    assert parent is not None
    wait([parent.sentinel])
    os._exit(1)

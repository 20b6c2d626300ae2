"""Real-time measures: all are taken where that is allowed; a refusal becomes a sentence that says what to grant."""

import ctypes
import gc
import mmap
import multiprocessing
import os
import resource
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from drillctl.ticker import realtime
from drillctl.ticker.realtime import PRIORITY, become_punctual

NOBODY = 65534
PR_GET_TIMERSLACK = 30
LATER_BYTES = 8 << 20
Facts = dict[str, Any]

pytestmark = [pytest.mark.paced, pytest.mark.skipif(sys.platform != "linux", reason="real-time scheduling is Linux's")]
as_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root can drop its rights")


def in_child(prepare: Callable[[], object]) -> Facts:
    """What holds in a process of its own after ``prepare`` and then become_punctual."""
    context = multiprocessing.get_context("fork")
    answers = context.SimpleQueue()
    child = context.Process(target=lambda: answers.put(facts_after(prepare)))
    child.start()
    child.join(30)
    assert child.exitcode == 0, "the child has died"
    found: Facts = answers.get()
    return found


def facts_after(prepare: Callable[[], object]) -> Facts:
    prepare()
    refused = become_punctual()
    return {
        "refused": refused,
        "scheduling": (os.sched_getscheduler(0), os.sched_getparam(0).sched_priority),
        "timer_slack_ns": ctypes.CDLL(None).prctl(PR_GET_TIMERSLACK, 0, 0, 0, 0),
        "locked_kb": locked_kb(),
        "collecting": gc.isenabled(),
        "locked_later_kb": locked_later_kb(),
    }


def locked_kb() -> int:
    lines = Path("/proc/self/status").read_text().splitlines()
    return int(next(line.split()[1] for line in lines if line.startswith("VmLck:")))


def locked_later_kb() -> int:
    """How much of memory taken from now on is locked."""
    before_kb = locked_kb()
    with mmap.mmap(-1, LATER_BYTES):
        return locked_kb() - before_kb


def be_nobody() -> None:
    """Without any right of root's; CAP_SYS_NICE and CAP_IPC_LOCK go with the user id."""
    resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
    resource.setrlimit(resource.RLIMIT_MEMLOCK, (4096, 4096))
    os.setgroups([])
    os.setgid(NOBODY)
    os.setuid(NOBODY)


def may_be_real_time() -> bool:
    """Asked in a child, since it changes the process."""
    return not in_child(lambda: None)["refused"]


def test_where_all_is_allowed() -> None:
    if not may_be_real_time():
        pytest.skip("this user may not schedule in real time or lock memory")
    found = in_child(lambda: None)
    assert found["scheduling"] == (os.SCHED_FIFO, PRIORITY)
    assert found["locked_kb"] > 1000
    assert not found["collecting"]


def test_later_memory_is_not_locked() -> None:
    """Else a memlock limit would make an allocation fail in the middle of a run."""
    if not may_be_real_time():
        pytest.skip("this user may not lock memory")
    assert in_child(lambda: None)["locked_later_kb"] == 0


@as_root
def test_without_rights_each_refusal_says_what_to_grant() -> None:
    found = in_child(be_nobody)
    assert len(found["refused"]) == 2
    scheduling, memory = found["refused"]
    assert scheduling.startswith("real-time scheduling: ") and "CAP_SYS_NICE" in scheduling and "rtprio" in scheduling
    assert memory.startswith("locked memory: ") and "CAP_IPC_LOCK" in memory and "memlock" in memory


@as_root
def test_without_rights_the_rest_is_taken() -> None:
    found = in_child(be_nobody)
    assert found["scheduling"] == (os.SCHED_OTHER, 0) and found["locked_kb"] == 0
    assert found["timer_slack_ns"] == 1
    assert not found["collecting"]


def scheduler(least_refused: int, asked: list[int]) -> Callable[[int, int, os.sched_param], None]:
    def set_scheduler(pid: int, policy: int, param: os.sched_param) -> None:
        asked.append(param.sched_priority)
        if param.sched_priority >= least_refused:
            raise PermissionError(1, "Operation not permitted")

    return set_scheduler


@pytest.mark.parametrize(
    ("limit", "asked"),
    [
        pytest.param(0, [PRIORITY], id="none"),
        pytest.param(1, [PRIORITY, 1], id="the least"),
        pytest.param(50, [PRIORITY, 50], id="some"),
        pytest.param(99, [PRIORITY], id="enough, so it was refused for another reason"),
        pytest.param(resource.RLIM_INFINITY, [PRIORITY], id="no limit"),
    ],
)
def test_a_lower_priority_is_taken_where_a_limit_allows_it(
    limit: int, asked: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[int] = []
    monkeypatch.setattr(os, "sched_setscheduler", scheduler(PRIORITY, seen))
    monkeypatch.setattr(resource, "getrlimit", lambda which: (limit, limit))
    refused = realtime._refusal(realtime._schedule)
    assert seen == asked
    assert bool(refused) == (len(asked) == 1)


def test_another_system_is_a_sentence_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.delattr(os, "sched_setscheduler")
    reasons = [realtime._refusal(take) for _, _, take in realtime.MEASURES]
    assert reasons == ["not on this system"] * len(realtime.MEASURES)

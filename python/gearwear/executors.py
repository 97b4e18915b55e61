"""The tasks of a sweep on somebody else's executor: handed out, taken back, and done again where a worker died with them.

Of an executor no more is used than :meth:`concurrent.futures.Executor.submit`. What goes out is a task as a text beside the sweep as bytes, what
comes back the line of the journal, so that rows are the same whoever runs them.
"""

from __future__ import annotations

import os
import pickle
from collections import deque
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from functools import lru_cache
from queue import SimpleQueue

from gearwear import _native
from gearwear.errors import RunError
from gearwear.version import refuse_other

#: Tasks that are out at a time, by how often they were lost before: one that kills its worker takes those beside it along, and is found when
#: it is alone. A task that was lost as often as this is long is not done again.
AT_A_TIME = (4096, 64, 1)
#: Bytes of the sweep that are out at a time, at most, as each task has them beside it.
MOST_BYTES = 1 << 27
#: Tasks that may be lost for good before any has come back; more, and the executor is at fault.
MOST_DOUBTFUL = 2

#: What is varied, the figure that is to be lowest, its limits, whether errors are estimated, and further columns.
Question = tuple[list[str], "str | None", list[str], bool, list[str]]


def is_one_or_makes_one(executor: object) -> bool:
    """Whether it is an executor, or can be asked for one."""
    return isinstance(executor, Executor) or callable(executor)


def packed(scene: _native.Scene | _native.Stage, question: Question) -> bytes:
    """The sweep for those who do its tasks."""
    is_stage = isinstance(scene, _native.Stage)
    return pickle.dumps((_native.VERSION, is_stage, (scene.name, scene.text, scene.folder, scene.files), question))


@lru_cache(maxsize=2)
def _unpacked(sweep: bytes) -> _native.Sweep:
    """The sweep, once in a process, as its runs share what they condense."""
    version, is_stage, scene, question = pickle.loads(sweep)
    refuse_other(version)
    kind = _native.Stage if is_stage else _native.Scene
    return kind.from_parts(*scene).sweep(*question)


def carry_out(sweep: bytes, task: str, losses: int) -> str:
    """Does a task on one thread, wherever this is. ``losses`` tells it from the same task before: Dask knows calls by their arguments."""
    return _unpacked(sweep).carry_out(task)


class Engine:
    """An executor, or a function that makes one, that does tasks of a sweep."""

    def __init__(
        self, executor: Executor | Callable[[], Executor], sweep: bytes, lost: Callable[[str, str], str]
    ) -> None:
        #: makes one in place of a broken one
        self._make = None if isinstance(executor, Executor) else executor
        self._executor = executor if isinstance(executor, Executor) else executor()
        self._sweep = sweep
        self._lost = lost
        self._most = max(64, min(AT_A_TIME[0], MOST_BYTES // len(sweep)))
        #: whether the executor is one of ours
        self._own = self._make is not None
        self._out: dict[Future[str], tuple[str, int]] = {}
        self._back: SimpleQueue[Future[str]] = SimpleQueue()
        #: tasks lost for good before any has come back
        self._doubtful: list[tuple[str, BaseException]] = []
        self._trusted = False

    def do(self, tasks: list[str], keep: Callable[[str], None]) -> None:
        """Does all tasks and hands what each comes to to ``keep``, in the order in which they come back."""
        waiting = [deque(tasks), *(deque[str]() for _ in AT_A_TIME[1:])]
        while True:
            self._hand_out(waiting)
            if not self._out:
                break
            future = self._back.get()
            task, losses = self._out.pop(future)
            try:
                line = future.result()
            except KeyboardInterrupt:
                raise
            except BaseException as error:
                if losses + 1 < len(AT_A_TIME):
                    waiting[losses + 1].append(task)
                elif self._trusted:
                    keep(self._lost(task, _reason(error)))
                else:
                    self._doubt(task, error)
            else:
                self._trusted = True
                self._settle(keep)
                keep(line)
        if self._doubtful and not isinstance(self._doubtful[-1][1], BrokenExecutor):
            raise self._at_fault(self._doubtful[-1][1])
        self._settle(keep)

    def _hand_out(self, waiting: list[deque[str]]) -> None:
        for losses, queue in enumerate(waiting):
            most = min(self._most, AT_A_TIME[losses])
            while queue and len(self._out) < most:
                future = self._submit(queue[0], losses)
                self._out[future] = (queue.popleft(), losses)
                future.add_done_callback(self._back.put)
            if queue:
                break

    def _submit(self, task: str, losses: int) -> Future[str]:
        try:
            return self._executor.submit(carry_out, self._sweep, task, losses)
        except BrokenExecutor:
            # A pool is broken for good when one of its processes died: another one like it takes its place.
            broken = self._executor
            if self._make is not None:
                self._executor = self._make()
            elif type(broken) is ProcessPoolExecutor:
                pool = vars(broken)
                of_pool = (pool[f"_{name}"] for name in ("max_workers", "mp_context", "initializer", "initargs"))
                self._executor = ProcessPoolExecutor(*of_pool)
            else:
                raise
            if self._own:
                broken.shutdown(wait=False)
            self._own = True
            return self._executor.submit(carry_out, self._sweep, task, losses)

    def _doubt(self, task: str, error: BaseException) -> None:
        self._doubtful.append((task, error))
        if len(self._doubtful) > MOST_DOUBTFUL:
            raise self._at_fault(error)

    def _at_fault(self, error: BaseException) -> RunError:
        fault = RunError(f"the executor has done none of its tasks, each lost {len(AT_A_TIME)} times: {_said(error)}")
        fault.__cause__ = error
        return fault

    def _settle(self, keep: Callable[[str], None]) -> None:
        for task, error in self._doubtful:
            keep(self._lost(task, _reason(error)))
        self._doubtful.clear()

    def close(self) -> None:
        """Takes back what is out."""
        for future in self._out:
            future.cancel()
        if self._own:
            self._executor.shutdown(wait=False)


def _said(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


def _reason(error: BaseException) -> str:
    return f"lost {len(AT_A_TIME)} times by the executor that ran it, the last time alone: {_said(error)}"


#: Sweeps whose journals this process holds.
_HELD: list[_native.UnfinishedSweep] = []


class Held:
    """A sweep under way, whose journal this process alone holds: one that is forked from it lets go, or it would hold it longer than this one."""

    def __init__(self, unfinished: _native.UnfinishedSweep) -> None:
        self._unfinished = unfinished

    def __enter__(self) -> _native.UnfinishedSweep:
        _HELD.append(self._unfinished)
        return self._unfinished

    def __exit__(self, *_: object) -> None:
        _HELD.remove(self._unfinished)
        self._unfinished.close()


def _let_go() -> None:
    for unfinished in _HELD:
        unfinished.close()
    _HELD.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_let_go)

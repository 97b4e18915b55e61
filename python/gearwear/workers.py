"""Threads and progress of a computation."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from operator import index
from typing import Union

#: Called with the name of the stage and the part of it that is done.
Progress = Callable[[str, float], object]
#: Whether progress is shown on standard error, or who is told of it.
ProgressArgument = Union[bool, Progress, None]

#: All cores.
ALL = 0
#: Characters of the line.
WIDTH = 78


def in_worker() -> bool:
    """Whether this process is one of several that share the machine: of a process pool, or a worker of Dask."""
    multiprocessing = sys.modules.get("multiprocessing.process")
    if multiprocessing is not None and multiprocessing.parent_process() is not None:
        return True
    distributed = sys.modules.get("distributed")
    if distributed is None:
        return False
    try:
        distributed.get_worker()
    except ValueError:
        return False
    return True


def thread_count(threads: int | None) -> int:
    """So many threads as asked for; all cores by default, one in a worker process."""
    if threads is None:
        return 1 if in_worker() else ALL
    try:
        count = index(threads)
    except TypeError:
        raise TypeError(f"threads: found {threads!r}; allowed: a whole number at least 1, or None") from None
    if isinstance(threads, bool) or count < 1:
        raise ValueError(f"threads: found {threads!r}; allowed: a whole number at least 1, or None")
    return count


class Line:
    """A line on standard error that says how far the work is."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._shown = False

    def __call__(self, stage: str, part: float) -> None:
        seconds = time.monotonic() - self._start
        text = f"{stage}: {100 * part:.0f} %, {seconds:.0f} s"
        sys.stderr.write("\r" + text[:WIDTH].ljust(WIDTH))
        sys.stderr.flush()
        self._shown = True

    def close(self) -> None:
        """Takes the line away."""
        if self._shown:
            sys.stderr.write("\r" + " " * WIDTH + "\r")
            sys.stderr.flush()


class Watched:
    """Who is told of progress, for as long as the work takes."""

    def __init__(self, progress: ProgressArgument) -> None:
        if not (progress is None or isinstance(progress, bool) or callable(progress)):
            raise TypeError(f"progress: found {progress!r}; allowed: True, False, or a function of stage and part")
        self._line = Line() if progress is True else None
        self._told = progress if callable(progress) else self._line

    def __enter__(self) -> Progress | None:
        return self._told

    def __exit__(self, *_: object) -> None:
        if self._line is not None:
            self._line.close()

"""Sweeps: a scene's run for all combinations of some keys, in this process or on any executor."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gearwear.kept import Kept
from gearwear.scene import Scene
from gearwear.stage import PlanetaryStage
from gearwear.table import Table
from gearwear.workers import ProgressArgument, Watched, thread_count

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from gearwear._native import Columns


class Sweep(Table):
    """The combinations of a sweep, a row each: the columns of ``sweep.csv`` as arrays, ``sweep["pinion.peak_wear_um"]``."""

    def __init__(self, columns: Columns, summary: dict[str, Any]) -> None:
        super().__init__("sweep", columns)
        #: what ``sweep.json`` holds: what was varied, the best combinations, the verification
        self.summary = summary

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> Sweep:
        """The sweep in a folder that ``gearwear sweep``, or :func:`sweep` with ``out``, has finished."""
        kept = Kept.read(folder, "Sweep")
        columns = kept.table("sweep")
        assert columns is not None
        return cls(columns, json.loads(kept.summary_json))

    @property
    def rows(self) -> list[dict[str, Any]]:
        """The same row by row."""
        columns = [values.tolist() for values in self.values()]
        return [dict(zip(self, row, strict=True)) for row in zip(*columns, strict=True)]

    @property
    def failed(self) -> dict[int, str]:
        """Why a combination has no figures, by its number."""
        return {int(index): str(error) for index, error in zip(self["index"], self["error"], strict=True) if error}

    def __repr__(self) -> str:
        axes = " × ".join(f"{axis['count']} of {axis['key']}" for axis in self.summary["axes"])
        return f"<gearwear.Sweep {self.summary['title']!r}: {axes}, {len(self.failed)} failed>"


def sweep(
    scene: Scene | PlanetaryStage,
    vary: Mapping[str, object],
    *,
    executor: Executor | Callable[[], Executor] | None = None,
    out: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    outputs: Iterable[str] = (),
    best: str | None = None,
    subject_to: Iterable[str] = (),
    error_estimate: bool = False,
    progress: ProgressArgument = False,
) -> Sweep:
    """Runs ``scene`` for all combinations of the keys of ``vary``: what ``gearwear sweep`` does, with the same rows.

    The values of a key are a list of rising numbers or of words, or a text as after ``--vary KEY=``, such as ``"10:30:21"`` or ``"1e-19:1e-17:5:log"``;
    ``"pair.{pinion,wheel}.tip_rounding_mm"`` links keys. The first key changes slowest.

    Combinations are run by ``threads`` threads of this process (None: all cores, one in a worker process), one each, or by the workers of ``executor``, any
    :class:`concurrent.futures.Executor`: a process pool, ``dask.distributed.Client.get_executor()``, ``mpi4py.futures``. No engine changes a bit of
    the rows but their times. A combination whose worker dies is run again; one that is lost three times is a failed row. A pool that is broken
    when a process of it died is made anew: one of ``concurrent.futures`` as it is, others where ``executor`` is a function that makes one.

    ``out`` is a folder with the journal and the files of ``gearwear sweep``: each row is kept there as it arrives, so that after Ctrl-C or a
    killed process the same call, and the same command, goes on with what is missing. Rows have all main figures; ``outputs`` are columns beside
    them, paths of numbers in the summary as in :func:`gearwear.evaluate`. ``best``, ``subject_to`` and ``error_estimate`` are those of
    the command. A combination that cannot be run is a row that says why; what is wrong with the question raises :class:`ValueError`.
    """
    if not isinstance(scene, (Scene, PlanetaryStage)):
        raise TypeError(f"scene: found {type(scene).__name__}; allowed: a gearwear.Scene or gearwear.PlanetaryStage")
    if not isinstance(vary, Mapping):
        raise TypeError(f"vary: found {type(vary).__name__}; allowed: a dict of keys and their values")
    if not vary:
        raise ValueError("vary: found no key; allowed: at least one")
    if isinstance(subject_to, str):
        raise TypeError(f"subject_to: found {subject_to!r}; allowed: a list of texts")
    if isinstance(outputs, str):
        raise TypeError(f"outputs: found {outputs!r}; allowed: a list of texts")
    count = thread_count(threads)
    if executor is not None and threads is not None:
        raise ValueError(f"threads: found {threads!r} beside an executor, which has workers of its own; allowed: None")
    varied = [f"{key}={_values(key, values)}" for key, values in vary.items()]
    question = (varied, best, list(subject_to), error_estimate, list(outputs))

    # With `concurrent.futures`, which the package does not load before it is needed.
    from gearwear.executors import Engine, Held, is_one_or_makes_one, packed

    if executor is not None and not is_one_or_makes_one(executor):
        raise TypeError(
            f"executor: found {type(executor).__name__}; allowed: a concurrent.futures.Executor, or a function that makes one"
        )

    native = scene._native.sweep(*question)
    for warning in native.warnings:
        warnings.warn(warning, stacklevel=2)
    begun = native.begin(None if out is None else os.fspath(out))
    with Held(begun) as unfinished, Watched(progress) as told:
        if executor is None:
            unfinished.run(count, told)
        else:
            engine = Engine(executor, packed(scene._native, question), native.lost)
            try:
                while tasks := unfinished.tasks():
                    kept = 0

                    def keep(line: str, total: int = len(tasks)) -> None:
                        nonlocal kept
                        unfinished.keep(line)
                        kept += 1
                        if told is not None:
                            told("combinations", kept / total)

                    engine.do(tasks, keep)
            finally:
                engine.close()
        columns, summary = unfinished.finish()
    return Sweep(columns, json.loads(summary))


def _values(key: str, values: object) -> str:
    """The values of a key as the command line has them."""
    if isinstance(values, str):
        return values
    if not isinstance(values, Iterable):
        raise TypeError(f"{key}: found {values!r}; allowed: a list of numbers or words, or a text such as '10:30:21'")
    return ",".join(_value(key, value) for value in values)


def _value(key: str, value: object) -> str:
    # NumPy's scalars.
    value = getattr(value, "item", lambda: value)()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"{key}: found {value!r}; allowed: a number or a word")

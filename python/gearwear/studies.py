"""Studies that are read as the record of their command: accuracy, improvement, comparison with measured profiles and of runs, validation."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from gearwear import _native
from gearwear.kept import Kept, as_kept
from gearwear.measured import Profile, profiles
from gearwear.measured import table as named_table
from gearwear.run import Run
from gearwear.table import Table
from gearwear.workers import ProgressArgument, Watched, thread_count

if TYPE_CHECKING:
    import pandas as pd

    from gearwear.scene import Scene

    #: A run, or the folder that one was written into.
    Finished = Run | str | os.PathLike[str]


class Study:
    """What a study found: its record, and the files of the command."""

    def __init__(self, native: _native.Study | Kept) -> None:
        self._native = native

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> Study:
        """The study in a folder that its command or :meth:`write` wrote."""
        return cls(Kept.read(folder, "Study"))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The record, as the command writes it: ``accuracy.json``, ``summary.json`` of improvement, ``compare.json``, ``remaining_life.json``, ``variants.json`` or
        ``validation.json``."""
        summary: dict[str, Any] = json.loads(self._native.summary_json)
        return summary

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes what the command writes: tables, page, record."""
        self._native.write(os.fspath(folder))

    @cached_property
    def tables(self) -> dict[str, Table]:
        """Its tables, by the names of their CSV files."""
        kept = as_kept(self._native)
        return {name: Table(name, kept.table(name) or []) for name in kept.names()}

    def to_pandas(self) -> dict[str, pd.DataFrame]:
        """Its tables as data frames."""
        return {name: table.to_pandas() for name, table in self.tables.items()}

    def __reduce__(self) -> tuple[Any, ...]:
        return Study, (as_kept(self._native),)

    def __repr__(self) -> str:
        return f"<gearwear.Study: {', '.join(self.summary)}>"


def compare(
    run: Finished,
    measured: Profile | Sequence[Profile] | Mapping[str, Profile],
    *,
    gear: str | None = None,
    form: str | None = None,
    fit: str | None = None,
    shift_within_mm: float = 0.1,
    tooth: int | None = None,
    flank: str | None = None,
    width_mm: float | None = None,
    threads: int | None = None,
    progress: ProgressArgument = False,
) -> Study:
    """A measured profile against a run, or those of pinion and wheel: ``gearwear compare RUN MEASURED …``, whose options these are.

    A profile is a CSV file, or a dict or data frame of the columns that such a file has: ``{"radius_mm": …, "height_um": …}``, two arrays of one
    dimension and the same length, and numbers or words as after ``#`` there, such as ``"hours": 31.75``. Those of both gears are a list of two, or
    ``{"pinion": …, "wheel": …}``.

    ``summary["fit"]`` is what was fitted, with the correlation coefficients of the values, ``summary["profiles"]`` how far apart each profile
    and the simulated one are. A profile that does not fit the run raises :class:`ValueError`.
    """
    count = thread_count(threads)
    with ExitStack() as kept, Watched(progress) as told:
        folder = _folder(run, kept)
        of_file = (tooth, flank, None if width_mm is None else float(width_mm))
        return Study(
            _native.compare(folder, profiles(measured), gear, form, fit, float(shift_within_mm), *of_file, count, told)
        )


def remaining_life(
    run: Finished,
    table: Profile,
    *,
    limit: Mapping[str, float] | None = None,
    prior: str | tuple[float, float] | None = None,
    gear: str | None = None,
    form: str | None = None,
    shift_within_mm: float = 0.1,
    other_k: float | str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: ProgressArgument = False,
) -> Study:
    """Wear coefficient and remaining life by wear measured at several times: ``gearwear compare RUN --history TABLE``, whose options these are.

    The table is a file, or a dict or data frame of its columns: ``{"hours": …, "mass_loss_g": …}``. ``limit`` is the wear that ends the life,
    ``{"pinion.peak_wear_um": 50.0}``; ``prior`` a regime such as ``"mild"``, or the ends of a 95 % interval in m²/N; ``other_k`` the coefficient of the gear
    that the table does not have, in m²/N, or the folder of a comparison that fitted it.

    ``summary["gears"]`` has each measured gear: ``["updates"]`` is what was known before any measurement, and after each, with what is left and the life in all.
    """
    count = thread_count(threads)
    limits = [f"{figure}={float(value)!r}" for figure, value in (limit or {}).items()]
    known = prior if prior is None or isinstance(prior, str) else ":".join(repr(float(end)) for end in prior)
    with ExitStack() as kept, Watched(progress) as told:
        folder = _folder(run, kept)
        other = None if other_k is None else os.fspath(other_k) if isinstance(other_k, (str, os.PathLike)) else repr(float(other_k))
        options = (limits, known, gear, form, float(shift_within_mm), other)
        return Study(_native.remaining_life(folder, named_table(table), *options, count, told))


def improve(
    scene: Scene,
    *,
    free: Sequence[str] | None = None,
    goals: Sequence[str] | None = None,
    limits: Sequence[str] | None = None,
    evaluations: int | None = None,
    seed: int | None = None,
    out: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: ProgressArgument = False,
) -> Study:
    """Better designs within the ranges of free keys: ``gearwear improve``. The options are keys of the table ``[improve]`` and replace the scene's own.

    ``summary["proposals"]`` has each proposal with its values and figures, ``tables["improve"]`` every design that was run. With ``out`` finished
    designs and results are written there, and a killed study goes on when it is called again.
    """
    lists = {name: list(texts) for name, texts in (("free", free), ("goals", goals), ("limits", limits)) if texts is not None}
    numbers = {name: value for name, value in (("evaluations", evaluations), ("seed", seed)) if value is not None}
    given: dict[str, Any] = {f"improve.{name}": value for name, value in (*lists.items(), *numbers.items())}
    asking = scene.with_(given) if given else scene
    folder = None if out is None else os.fspath(out)
    with Watched(progress) as told:
        study = Study(asking._native.improve(folder, thread_count(threads), told))
    if out is not None:
        study.write(out)
    return study


def compare_runs(runs: Mapping[str, Finished]) -> Study:
    """Runs side by side under the names they are given, each compared with the first: ``gearwear compare RUN RUN …``."""
    with ExitStack() as kept:
        return Study(_native.compare_runs([(_folder(run, kept), name) for name, run in runs.items()]))


def validate(
    cases: Iterable[str | os.PathLike[str]] = (),
    tier: str | None = None,
    *,
    threads: int | None = None,
    progress: ProgressArgument = False,
) -> Study:
    """The validation suite: ``gearwear validate``, all of it or the cases named, of the tier ``"smoke"``, ``"full"`` or ``"long"``.

    A case that misses its bound raises nothing: ``summary["cases"]`` says it. ``["invariants"]``: random scenes held against statements that are
    true of every scene, a hundred of the tier ``"smoke"``, a thousand otherwise; ``summary["violations"]`` says which are not.
    """
    if isinstance(cases, str):
        raise TypeError(f"cases: found {cases!r}; allowed: a list of names or folders")
    count = thread_count(threads)
    with Watched(progress) as told:
        return Study(_native.validate([os.fspath(case) for case in cases], tier, count, told))


def _folder(run: Finished, kept: ExitStack) -> str:
    """The folder of a run, which is written if need be."""
    if not isinstance(run, Run):
        return os.fspath(run)
    folder = Path(kept.enter_context(TemporaryDirectory()))
    run.write(folder)
    return str(folder)

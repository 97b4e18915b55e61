"""Folders of finished runs and studies, and what is read from them."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple

from gearwear import _native

if TYPE_CHECKING:
    from gearwear._native import Columns


class Kind(NamedTuple):
    """What a folder may hold."""

    name: str
    #: what reads it
    reader: str
    #: file that is written last
    record: str
    #: file that only a folder of this kind has beside it
    beside: str


KINDS = (
    Kind("a run", "Run", "summary.json", "record.bin"),
    Kind("a run of a planetary stage", "StageRun", "summary.json", "transmission_error.csv"),
    Kind("a sweep", "Sweep", "sweep.json", "sweep.csv"),
    Kind("a study of uncertainty", "Uncertainty", "uncertainty.json", "samples.csv"),
    Kind("a study of accuracy", "Study", "accuracy.json", "accuracy.csv"),
    Kind("a comparison with measured profiles", "Study", "compare.json", "compare.csv"),
    Kind("a remaining life", "Study", "remaining_life.json", "remaining_life.csv"),
    Kind("a comparison of runs", "Study", "variants.json", "variants.csv"),
    Kind("a study of improvement", "Study", "summary.json", "improve.csv"),
    Kind("a validation", "Study", "validation.json", "junit.xml"),
    Kind("a validation of invariants", "Study", "summary.json", "invariants.csv"),
    Kind("finite elements of a pair", "FemPair", "summary.json", "pressure.csv"),
    Kind("a problem of finite elements", "FemProblem", "summary.json", "problem.toml"),
)

#: Files beside the tables.
_OTHERS = (
    "columns.json", "report.html", "scene.toml", "problem.toml", "solution.vtu",
    "junit.xml", "summary.md", "work_precision.json", "recommended.toml",
)  # fmt: skip
#: Columns of words that may be empty in every row.
_WORDS = ("error", "verified", "error.total.how", "sun_planet.error.total.how", "planet_ring.error.total.how")


def kind_of(folder: str | os.PathLike[str], reader: str) -> Kind:
    """What of what ``reader`` reads is in ``folder``: :class:`OSError` where there is no folder, :class:`ValueError` where it holds something else."""
    place = Path(folder)
    names = {path.name for path in place.iterdir()}
    found = [kind for kind in KINDS if {kind.record, kind.beside} <= names]
    own = [kind for kind in found if kind.reader == reader]
    if len(own) == 1:
        return own[0]
    allowed = "the folder of " + ", ".join(kind.name for kind in KINDS if kind.reader == reader)
    if own:
        several = " and ".join(kind.record for kind in own)
        raise ValueError(f"{place}: found {several}; allowed: {allowed}, of one alone")
    if found:
        said = ", ".join(f"that of {kind.name}, which gearwear.{kind.reader}.read reads" for kind in found)
    elif "scene.toml" in names:
        said = "something that is not finished: its last file is not there"
    else:
        said = f"no file of a run or a study among its {len(names)}"
    raise ValueError(f"{place}: found {said}; allowed: {allowed}")


class Kept:
    """The files of a study, in memory; stands for what computed them."""

    def __init__(self, record: str, files: dict[str, bytes]) -> None:
        self._record = record
        self._files = files

    @classmethod
    def read(cls, folder: str | os.PathLike[str], reader: str) -> Kept:
        """The files of what ``reader`` reads in ``folder``; others there stay where they are."""
        place, kind = Path(folder), kind_of(folder, reader)
        columns = place / "columns.json"
        tables = json.loads(columns.read_bytes())["files"] if columns.exists() else {}
        names = dict.fromkeys([*tables, *_OTHERS, kind.record])
        return cls(kind.record, {name: (place / name).read_bytes() for name in names if (place / name).is_file()})

    @classmethod
    def of(cls, write: Callable[[str], None]) -> Kept:
        """The files that ``write`` leaves in a folder."""
        with TemporaryDirectory() as folder:
            write(folder)
            place = Path(folder)
            paths = sorted(path for path in place.rglob("*") if path.is_file())
            files = {path.relative_to(place).as_posix(): path.read_bytes() for path in paths}
        return cls(next(kind.record for kind in KINDS if {kind.record, kind.beside} <= files.keys()), files)

    @property
    def summary_json(self) -> str:
        """The record."""
        return self._files[self._record].decode()

    def names(self) -> Iterator[str]:
        """The names of the tables."""
        return (name.removesuffix(".csv") for name in self._files if name.endswith(".csv"))

    def table(self, name: str) -> Columns | None:
        """The columns of a table; None where there is none."""
        if f"{name}.csv" not in self._files:
            return None
        meanings = json.loads(self._files["columns.json"])["files"][f"{name}.csv"]
        rows = list(csv.reader(io.StringIO(self._files[f"{name}.csv"].decode(), newline="")))
        fields = {column: [row[place] for row in rows[1:]] for place, column in enumerate(rows[0])}
        return [(column, _native.unit_of(column), meanings[column], _values(column, texts)) for column, texts in fields.items()]

    def samples(self) -> Columns:
        """The columns of ``samples.csv``."""
        columns = self.table("samples")
        assert columns is not None
        return columns

    def mesh(self) -> _native.Mesh:
        """The mesh in ``solution.vtu``."""
        with TemporaryDirectory() as folder:
            file = Path(folder) / "solution.vtu"
            file.write_bytes(self._files[file.name])
            return _native.Mesh.read(str(file))

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes the files, the record last."""
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        for name in [*(name for name in self._files if name != self._record), self._record]:
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            (place / name).write_bytes(self._files[name])

    def __reduce__(self) -> tuple[Any, ...]:
        return Kept, (self._record, self._files)


def as_kept(native: Any) -> Kept:
    """The files of a study that was computed here, or of one that was read."""
    return native if isinstance(native, Kept) else Kept.of(native.write)


def _values(column: str, texts: list[str]) -> Any:
    """The fields of a column, of the kind that they were written from."""
    import numpy as np

    if column in _WORDS:
        return texts
    try:
        values = np.array([int(text) for text in texts], dtype=np.int64)
    except ValueError:
        try:
            values = np.array([float(text) if text else np.nan for text in texts])
        except ValueError:
            return texts
    values.flags.writeable = False
    return values if texts else np.array([])

"""Outputs of a scene for rows of values of its keys: what samplers, sensitivity analyses and optimisers call."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearwear.figures import warn_of_older_names
from gearwear.scene import Scene
from gearwear.stage import PlanetaryStage
from gearwear.workers import ProgressArgument, Watched, thread_count

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd

    Numbers = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True, eq=False, repr=False)
class Evaluation:
    """What came of rows of values."""

    #: the keys that were given values
    keys: tuple[str, ...]
    #: the values of the keys, row by row
    rows: tuple[tuple[object, ...], ...]
    #: paths in the summary
    outputs: tuple[str, ...]
    #: (rows, outputs); NaN where there is none
    values: Numbers
    #: why a row has a NaN, on one line; None where it has none
    status: tuple[str | None, ...]

    def __getitem__(self, output: str) -> Numbers:
        """One output of all rows (rows)."""
        try:
            values: Numbers = self.values[:, self.outputs.index(output)]
        except ValueError:
            raise KeyError(f"found the output {output!r}; allowed: {', '.join(self.outputs)}") from None
        return values

    def to_pandas(self) -> pd.DataFrame:
        """A row for each row: keys, outputs, and ``status``."""
        import pandas as pd

        columns: dict[str, Any] = {key: [row[place] for row in self.rows] for place, key in enumerate(self.keys)}
        columns |= {output: self.values[:, place] for place, output in enumerate(self.outputs)}
        return pd.DataFrame({**columns, "status": list(self.status)})

    def __repr__(self) -> str:
        failed = sum(reason is not None for reason in self.status)
        return f"<gearwear.Evaluation: {len(self.rows)} rows of {', '.join(self.keys)}; {', '.join(self.outputs)}; {failed} failed>"


def evaluate(
    scene: Scene | PlanetaryStage,
    keys: Sequence[str],
    X: Any,  # noqa: N803
    outputs: Sequence[str],
    threads: int | None = None,
    *,
    progress: ProgressArgument = False,
) -> Evaluation:
    """Runs ``scene`` once for each row of ``X``, an array, a data frame or a list of rows, which hold a value (a number or a word) for each of ``keys``.

    Keys are paths in the scene (``"operation.pinion_torque_Nm"``, ``"pair.{pinion,wheel}.tip_rounding_mm"``), outputs paths of numbers in the
    summary (``"pinion.peak_wear_um"``; :func:`gearwear.main_figures` lists the main ones), as in :func:`gearwear.sweep`. What the outputs do not
    need is left out of the runs: snapshots, and the verification and the error estimates unless an output begins with ``error``. A row that
    cannot be run is NaN and says why in ``status``; unknown keys or outputs, and rows that do not fit them, raise :class:`ValueError`.
    ``threads`` (None: all cores, one in a worker process) run a row each and never change a bit of the results.
    """
    # Which the package does not load before it is needed.
    import numpy as np

    if not isinstance(scene, (Scene, PlanetaryStage)):
        raise TypeError(f"scene: found {type(scene).__name__}; allowed: a gearwear.Scene or gearwear.PlanetaryStage")
    for name, texts in (("keys", keys), ("outputs", outputs)):
        if isinstance(texts, str) or not all(isinstance(text, str) for text in texts):
            raise TypeError(f"{name}: found {texts!r}; allowed: a list of texts")
    rows = X.to_numpy() if hasattr(X, "to_numpy") else X
    if isinstance(rows, np.ndarray) and rows.ndim != 2:
        raise ValueError(f"X: found an array of {rows.ndim} dimensions; allowed: two, rows and keys")
    table = rows.tolist() if isinstance(rows, np.ndarray) else [list(row) for row in rows]
    count = thread_count(threads)
    warn_of_older_names(outputs)
    with Watched(progress) as told:
        values, status = scene._native.evaluate(list(keys), table, list(outputs), count, told)
    found = np.array(values, dtype=float).reshape(len(table), len(outputs))
    return Evaluation(tuple(keys), tuple(map(tuple, table)), tuple(outputs), found, tuple(status))

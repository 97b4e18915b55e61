"""Outputs of a scene for rows of values of its keys: what samplers, sensitivity analyses and optimisers call."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from gearwear.figures import warn_of_older_names
from gearwear.scene import Scene
from gearwear.workers import ProgressArgument, Watched, thread_count

if TYPE_CHECKING:
    from gearwear.evaluation import Evaluation


def evaluate(
    scene: Scene,
    keys: Sequence[str],
    X: Iterable[Iterable[object]],  # noqa: N803
    outputs: Sequence[str],
    threads: int | None = 1,
    *,
    progress: ProgressArgument = False,
) -> Evaluation:
    """Runs ``scene`` once for each row of ``X``, which holds a value (a number or a word) for each of ``keys``.

    Keys are paths in the scene (``"operation.pinion_torque_Nm"``, ``"pair.{pinion,wheel}.tip_rounding_mm"``), outputs paths of numbers in the
    summary (``"pinion.peak_wear_um"``; :func:`gearwear.main_figures` lists the main ones). What the outputs do not need is left out of the runs: snapshots, and the verification and the error
    estimates unless an output begins with ``error``. A row that cannot be run is NaN and says why in ``status``; unknown keys or outputs, and
    rows that do not fit them, raise :class:`ValueError`. ``threads`` (None: all cores, one in a worker process) run a row each and never
    change a bit of the results.
    """
    # With NumPy, which the package does not load before it is needed.
    import numpy as np

    from gearwear.evaluation import Evaluation

    if not isinstance(scene, Scene):
        raise TypeError(f"scene: found {type(scene).__name__}; allowed: a gearwear.Scene")
    for name, texts in (("keys", keys), ("outputs", outputs)):
        if isinstance(texts, str) or not all(isinstance(text, str) for text in texts):
            raise TypeError(f"{name}: found {texts!r}; allowed: a list of texts")
    if isinstance(X, np.ndarray) and X.ndim != 2:
        raise ValueError(f"X: found an array of {X.ndim} dimensions; allowed: two, rows and keys")
    table = X.tolist() if isinstance(X, np.ndarray) else [list(row) for row in X]
    count = thread_count(threads)
    warn_of_older_names(outputs)
    with Watched(progress) as told:
        values, status = scene._native.evaluate(list(keys), table, list(outputs), count, told)
    found = np.array(values, dtype=float).reshape(len(table), len(outputs)).view(Evaluation)
    found.status = status
    return found

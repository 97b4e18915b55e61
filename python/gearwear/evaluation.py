"""What came of rows of values."""

from __future__ import annotations

from typing import Any

import numpy as np


class Evaluation(np.ndarray[Any, np.dtype[np.float64]]):
    """The outputs of each row, an array of shape (rows, outputs); NaN where there is none, and :attr:`status` says why."""

    #: why a row has a NaN, on one line; None where it has none
    status: list[str | None]

    def __array_finalize__(self, other: object) -> None:
        self.status = getattr(other, "status", [])

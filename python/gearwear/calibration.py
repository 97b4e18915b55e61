"""Calibrations of the fast model."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from gearwear import _native


class Calibration:
    """What finite elements taught the fast model of a pair: stiffness of the teeth, and K/H by position and load.

    :meth:`gearwear.Scene.calibrate` makes one, and :meth:`gearwear.Scene.with_calibration` uses it.
    """

    __slots__ = ("_native",)

    def __init__(self, native: _native.Calibration) -> None:
        self._native = native

    @classmethod
    def from_json(cls, text: str) -> Calibration:
        """The calibration in the text of its file."""
        return cls(_native.Calibration.from_json(text, "calibration", [], 0.0))

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Calibration:
        """The calibration in a file that ``gearwear calibrate`` or :meth:`write` wrote."""
        return cls.from_json(Path(path).read_text(encoding="utf-8"))

    def to_json(self) -> str:
        """The text of its file."""
        return self._native.to_json()

    @property
    def data(self) -> dict[str, Any]:
        """All it holds, under the names of its file."""
        data: dict[str, Any] = json.loads(self.to_json())
        return data

    def write(self, file: str | os.PathLike[str]) -> None:
        """Writes the file that scenes name, JSON, and a page beside it."""
        self._native.write(os.fspath(file))

    def __eq__(self, other: object) -> bool:
        return self._native == other._native if isinstance(other, Calibration) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __reduce__(self) -> tuple[Any, ...]:
        native = self._native
        return _restored, (self.to_json(), native.title, native.stages, native.wall_s)

    def __repr__(self) -> str:
        return f"<gearwear.Calibration of {self._native.title!r}>"


def _restored(text: str, title: str, stages: list[tuple[str, float]], wall_s: float) -> Calibration:
    return Calibration(_native.Calibration.from_json(text, title, stages, wall_s))

"""The main figures of a run: their names, units and words."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from dataclasses import dataclass

from gearwear import _native


@dataclass(frozen=True)
class Figure:
    """A main figure of a run."""

    #: path in the summary, which is its name everywhere
    name: str
    #: short heading
    heading: str
    #: the same for a row of both gears, or of new and worn flanks
    row: str
    #: unit; empty for a ratio
    unit: str
    #: what it holds
    meaning: str
    #: whether short tables show it
    in_short_tables: bool


def main_figures() -> tuple[Figure, ...]:
    """The main figures of a run, by their paths in the summary: what tables show, and what most studies ask for."""
    return tuple(Figure(*figure) for figure in _native.main_figures())


def warn_of_older_names(names: Iterable[str]) -> None:
    """Warns of figures that are called by the names that they had in the version before."""
    for note in _native.notes_on_figures(list(names)):
        warnings.warn(note, stacklevel=3)

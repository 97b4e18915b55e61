"""Finite elements: the contact of a gear pair, and problems on meshes of one's own."""

from __future__ import annotations

import json
import os
from functools import cached_property
from pathlib import Path
from typing import Any

from gearwear import _native
from gearwear.mesh import Mesh, as_mesh
from gearwear.table import Table
from gearwear.version import refuse_other
from gearwear.workers import ProgressArgument, Watched


class FemPair:
    """The contact of a gear pair by finite elements, over the mesh cycle or at one position."""

    def __init__(self, native: _native.FemPair) -> None:
        self._native = native

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` holds."""
        summary: dict[str, Any] = json.loads(self._native.summary_json)
        return summary

    @cached_property
    def mesh_cycle(self) -> Table:
        """A row for each position and tooth pair in contact."""
        return self._table("mesh_cycle")

    @cached_property
    def pressure(self) -> Table:
        """A row for each node under pressure along the flank: at the position asked for, or at A to E."""
        return self._table("pressure")

    def _table(self, name: str) -> Table:
        columns = self._native.table(name)
        assert columns is not None
        return Table(name, columns)

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes what ``gearwear fem`` writes."""
        self._native.write(os.fspath(folder))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (_native.VERSION, self._native.to_bytes())

    def __repr__(self) -> str:
        return f"<gearwear.FemPair {self.summary['title']!r}: {self.summary['positions']} positions>"


def _restored(version: str, data: bytes) -> FemPair:
    refuse_other(version)
    return FemPair(_native.FemPair.from_bytes(data))


class FemProblem:
    """The answer to a problem of finite elements on a mesh of one's own."""

    def __init__(self, native: _native.FemProblem) -> None:
        self._native = native

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` holds."""
        summary: dict[str, Any] = json.loads(self._native.summary_json)
        return summary

    @cached_property
    def mesh(self) -> Mesh:
        """The mesh with displacement, stress and, in the plane, contact pressure at its points: that of ``solution.vtu``."""
        return Mesh(self._native.mesh())

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes what ``gearwear fem`` writes: ``solution.vtu``, ``contact.csv`` and the others."""
        self._native.write(os.fspath(folder))

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("the answer to a problem of finite elements cannot be pickled; write(folder) keeps it")

    def __repr__(self) -> str:
        return f"<gearwear.FemProblem {self.summary['title']!r}: {self.summary['elements']} elements>"


def fem_problem(
    path: str | os.PathLike[str], *, mesh: Any = None, progress: ProgressArgument = False
) -> FemProblem:
    """Solves the problem in a file (``docs/fem-problems.md``), whose mesh lies beside it.

    With ``mesh``, a :class:`Mesh` or a ``meshio.Mesh``, it is solved on that, and the file that the problem names is not read.
    """
    file = Path(path)
    text = file.read_text(encoding="utf-8")
    native = None if mesh is None else as_mesh(mesh)._native
    with Watched(progress) as told:
        return FemProblem(_native.solve_fem_problem(str(file), text, str(file.parent), native, told))

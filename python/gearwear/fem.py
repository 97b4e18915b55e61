"""Finite elements: the contact of a gear pair, and problems on meshes of one's own."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

from gearwear import _native
from gearwear.kept import Kept, as_kept
from gearwear.mesh import Mesh, as_mesh
from gearwear.table import Table
from gearwear.version import refuse_other
from gearwear.workers import ProgressArgument, Watched


class FemPair:
    """The contact of a gear pair by finite elements, over the mesh cycle or at one position."""

    def __init__(self, native: _native.FemPair | Kept) -> None:
        self._native = native

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> FemPair:
        """The contact in a folder that ``gearwear fem`` or :meth:`write` wrote."""
        return cls(Kept.read(folder, "FemPair"))

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
        if isinstance(self._native, Kept):
            return FemPair, (self._native,)
        return _restored, (_native.VERSION, self._native.to_bytes())

    def __repr__(self) -> str:
        return f"<gearwear.FemPair {self.summary['title']!r}: {self.summary['positions']} positions>"


def _restored(version: str, data: bytes) -> FemPair:
    refuse_other(version)
    return FemPair(_native.FemPair.from_bytes(data))


class FemProblem:
    """The answer to a problem of finite elements on a mesh of one's own."""

    def __init__(self, native: _native.FemProblem | Kept) -> None:
        self._native = native

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> FemProblem:
        """The answer in a folder that ``gearwear fem`` or :meth:`write` wrote."""
        return cls(Kept.read(folder, "FemProblem"))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` holds."""
        summary: dict[str, Any] = json.loads(self._native.summary_json)
        return summary

    @cached_property
    def mesh(self) -> Mesh:
        """The mesh with displacement, stress and, in the plane, contact pressure at its points: that of ``solution.vtu``."""
        return Mesh(self._native.mesh())

    @cached_property
    def contact(self) -> Table:
        """A row for each place of each contact: gap and pressure, the columns of ``contact.csv``; empty in space, where nothing touches."""
        return Table("contact", as_kept(self._native).table("contact") or [])

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes what ``gearwear fem`` writes: ``solution.vtu``, ``contact.csv`` and the others."""
        self._native.write(os.fspath(folder))

    def __reduce__(self) -> tuple[Any, ...]:
        return FemProblem, (as_kept(self._native),)

    def __repr__(self) -> str:
        return f"<gearwear.FemProblem {self.summary['title']!r}: {self.summary['elements']} elements>"


def fem_problem(
    problem: str | os.PathLike[str] | Mapping[str, Any], *, mesh: Any = None, progress: ProgressArgument = False
) -> FemProblem:
    """Solves a problem (``docs/fem-problems.md``): that in a file, whose mesh lies beside it, or a dict of its tables.

    With ``mesh``, a :class:`Mesh` or a ``meshio.Mesh``, it is solved on that: a file that the problem names is not read, and none need be named.
    """
    native = None if mesh is None else as_mesh(mesh)._native
    if isinstance(problem, Mapping):
        tables = dict(problem)
        if native is not None:
            tables.setdefault("mesh", {"file": "mesh.json"})
        name, text, folder = "problem", _native.Scene.text_of(tables), ""
    else:
        file = Path(problem)
        name, text, folder = str(file), file.read_text(encoding="utf-8"), str(file.parent)
    with Watched(progress) as told:
        return FemProblem(_native.solve_fem_problem(name, text, folder, native, told))

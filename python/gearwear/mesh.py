"""Meshes, shaped like those of meshio."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gearwear import _native
from gearwear.version import refuse_other

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


class Mesh:
    """Points in mm, cells by kind, data at points and cells, and named sets, under meshio's names."""

    def __init__(self, native: _native.Mesh) -> None:
        self._native = native

    @classmethod
    def from_meshio(cls, mesh: Any) -> Mesh:
        """The same as a ``meshio.Mesh``, or as anything with its attributes. Plane points get z = 0.

        What meshio keeps of a Gmsh file under names that begin with ``gmsh:`` stays behind: numbers of groups, which are sets too. Of a mesh
        without sets the tags ``gmsh:physical`` come along.
        """
        import numpy as np

        points = np.asarray(mesh.points, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] not in (2, 3):
            raise ValueError(f"points: found an array of shape {points.shape}; allowed: rows of two or three coordinates")
        if points.shape[1] == 2:
            points = np.column_stack([points, np.zeros(len(points))])
        blocks = [(block.type, _integers(block.data)) for block in mesh.cells]
        tags = {name: (int(tag), int(dimension)) for name, (tag, dimension) in mesh.field_data.items()}
        cell_data = _own(mesh.cell_data)
        if not mesh.cell_sets and "gmsh:physical" in mesh.cell_data:
            cell_data.append(("gmsh:physical", mesh.cell_data["gmsh:physical"]))
        return cls(
            _native.Mesh(
                points,
                blocks,
                {name: _numbers(values) for name, values in mesh.point_data.items()},
                {name: [_numbers(values) for values in of_blocks] for name, of_blocks in cell_data},
                {name: _members(places) for name, places in mesh.point_sets.items()},
                {name: [_members(places) for places in of_blocks] for name, of_blocks in _own(mesh.cell_sets)},
                tags,
            )
        )

    def to_meshio(self, *, gmsh: bool = False) -> Any:
        """The same as a ``meshio.Mesh`` (``pip install gearwear[mesh]``), with the tags of physical groups as ``gmsh:physical`` too.

        With ``gmsh`` as meshio writes into files of Gmsh 4.1: a block for the cells of each group, and ``gmsh:dim_tags`` at the points. There a cell
        is in one group, of several the smallest, and sets of points have no place.
        """
        import meshio
        import numpy as np

        make: Any = meshio.Mesh
        from gearwear.gmsh import for_gmsh, physical_tags

        if gmsh:
            return for_gmsh(self)
        tags = self._native.field_data
        cell_data = dict(self.cell_data)
        if tags:
            # meshio writes groups into Gmsh's older files from these.
            physical = [numbers.astype(np.int32) for numbers in physical_tags(self, tags)]
            cell_data.setdefault("gmsh:physical", physical)
            cell_data.setdefault("gmsh:geometrical", [numbers.copy() for numbers in physical])
        # Points of its own, as meshio's users change them.
        return make(
            self.points.copy(),
            self.cells,
            point_data=self.point_data,
            cell_data=cell_data,
            field_data={name: np.array(tag) for name, tag in tags.items()},
            point_sets=self.point_sets,
            cell_sets=self.cell_sets,
        )

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Mesh:
        """The mesh in a file of Gmsh (``.msh``), VTK (``.vtu``), Abaqus (``.inp``), or in gearwear's own JSON."""
        return cls(_native.Mesh.read(os.fspath(path)))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes it; the ending of the name tells the format."""
        self._native.write(os.fspath(path))

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Coordinates in mm, rows of three; read-only."""
        return self._native.points

    @property
    def cells(self) -> list[tuple[str, npt.NDArray[np.int64]]]:
        """Blocks of cells: meshio's name of their kind, and a row of node numbers for each."""
        return self._native.cells

    @property
    def point_data(self) -> dict[str, npt.NDArray[Any]]:
        """Numbers at the points, such as ``"displacement_mm"``."""
        return self._native.point_data

    @property
    def cell_data(self) -> dict[str, list[npt.NDArray[Any]]]:
        """Numbers of the cells, an array for each block."""
        return self._native.cell_data

    @property
    def point_sets(self) -> dict[str, npt.NDArray[np.int64]]:
        """Numbers of the points of each set."""
        return self._native.point_sets

    @property
    def cell_sets(self) -> dict[str, list[npt.NDArray[np.int64]]]:
        """For each set and block of cells their numbers within the block."""
        return self._native.cell_sets

    def __eq__(self, other: object) -> bool:
        return self._native == other._native if isinstance(other, Mesh) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (_native.VERSION, self._native.to_bytes())

    def __repr__(self) -> str:
        cells = ", ".join(f"{len(nodes)} {kind}" for kind, nodes in self.cells)
        return f"<gearwear.Mesh: {len(self.points)} points; {cells}>"


def _restored(version: str, data: bytes) -> Mesh:
    refuse_other(version)
    return Mesh(_native.Mesh.from_bytes(data))


def _own(by_name: Mapping[str, Any]) -> list[tuple[str, Any]]:
    return [(name, values) for name, values in by_name.items() if not name.startswith("gmsh:")]


def _integers(values: Any) -> npt.NDArray[np.int64]:
    import numpy as np

    return np.ascontiguousarray(values, dtype=np.int64)


def _numbers(values: Any) -> npt.NDArray[Any]:
    import numpy as np

    array = np.asarray(values)
    kind = np.int64 if array.dtype.kind in "iub" else np.float64
    return np.ascontiguousarray(array, dtype=kind)


def _members(places: Iterable[int] | None) -> npt.NDArray[np.int64]:
    """Ascending, none twice; meshio has None where a block has no member."""
    import numpy as np

    return np.unique(_integers([] if places is None else places))


def as_mesh(mesh: Any) -> Mesh:
    """A mesh of ours or of meshio's as ours."""
    return mesh if isinstance(mesh, Mesh) else Mesh.from_meshio(mesh)

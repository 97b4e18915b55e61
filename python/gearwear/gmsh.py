"""Meshes as meshio writes them into files of Gmsh 4.1: an entity for each block of cells, which every point is on one of."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import meshio
import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from gearwear.mesh import Mesh

    Integers = npt.NDArray[np.int64]

#: Dimension of cells by the beginning of the names of their kinds.
_DIMENSIONS = {"vertex": 0, "line": 1, "triangle": 2, "quad": 2, "tetra": 3, "hexahedron": 3, "wedge": 3, "pyramid": 3}


def physical_tags(mesh: Mesh, tags: Mapping[str, tuple[int, int]]) -> list[Integers]:
    """The tag of the group that each cell of each block is in, 0 for none; of several groups the smallest."""
    physical = [np.zeros(len(nodes), dtype=np.int64) for _, nodes in mesh.cells]
    sets = mesh.cell_sets
    for name in sorted(tags, key=lambda name: -sum(map(len, sets.get(name, [])))):
        for numbers, members in zip(physical, sets.get(name, []), strict=False):
            numbers[members] = tags[name][0]
    return physical


def for_gmsh(mesh: Mesh) -> Any:
    """The mesh with blocks split by group, tags of groups and entities."""
    tags = dict(mesh._native.field_data)
    cells = mesh.cells
    dimensions = [_dimension(kind) for kind, _ in cells]
    for name, of_blocks in mesh.cell_sets.items():
        if name not in tags and any(len(members) for members in of_blocks):
            dimension = max(dimensions[block] for block, members in enumerate(of_blocks) if len(members))
            tags[name] = (max((tag for tag, _ in tags.values()), default=0) + 1, dimension)
    physical = physical_tags(mesh, tags)
    # Block and members of each part, and its group.
    parts = [
        (block, np.flatnonzero(numbers == tag), int(tag)) for block, numbers in enumerate(physical) for tag in np.unique(numbers)
    ]
    blocks = [(cells[block][0], cells[block][1][members]) for block, members, _ in parts]
    # Entities are numbered through, so that none is another of the same dimension.
    entities = [(dimensions[block], number + 1) for number, (block, _, _) in enumerate(parts)]
    cell_data = {
        name: [of_blocks[block][members] for block, members, _ in parts] for name, of_blocks in mesh.cell_data.items()
    }
    cell_data["gmsh:physical"] = [np.full(len(members), tag, dtype=np.int32) for _, members, tag in parts]
    cell_data["gmsh:geometrical"] = [
        np.full(len(members), entity, dtype=np.int32) for (_, members, _), (_, entity) in zip(parts, entities, strict=True)
    ]
    make: Any = meshio.Mesh
    return make(
        mesh.points.copy(),
        blocks,
        point_data={**mesh.point_data, "gmsh:dim_tags": _of_points(len(mesh.points), blocks, entities)},
        cell_data=cell_data,
        field_data={name: np.array(tag) for name, tag in tags.items()},
    )


def _dimension(kind: str) -> int:
    return next(dimension for name, dimension in _DIMENSIONS.items() if kind.startswith(name))


def _of_points(count: int, blocks: list[tuple[str, Integers]], entities: list[tuple[int, int]]) -> Integers:
    """Dimension and number of the entity that each point is on: the least dimension wins, but each entity has a point, or meshio leaves it out."""
    on = np.zeros((count, 2), dtype=np.int64)
    for place in sorted(range(len(blocks)), key=lambda place: -entities[place][0]):
        on[blocks[place][1].ravel()] = entities[place]
    owner: dict[int, int] = {}

    def give(place: int, tried: set[int]) -> bool:
        """Whether the block can have a point of its own, others changing theirs where they can."""
        for point in np.unique(blocks[place][1]).tolist():
            if point not in tried:
                tried.add(point)
                if point not in owner or give(owner[point], tried):
                    owner[point] = place
                    return True
        return False

    for place in sorted(range(len(blocks)), key=lambda place: len(blocks[place][1])):
        if not give(place, set()):
            raise ValueError(f"found more groups than points on {blocks[place][0]}; allowed: a point of its own for each group")
    for point, place in owner.items():
        on[point] = entities[place]
    return on

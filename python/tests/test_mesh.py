"""Meshes, ours and meshio's."""

from __future__ import annotations

import pickle
from pathlib import Path

import meshio
import numpy as np
import pytest

import gearwear

MESHES = Path(__file__).parents[2] / "meshes"
SCENE = gearwear.Scene.preset("fzg-c").with_({"fem.elements_per_half_width": 3})


def test_the_mesh_of_a_pair(tmp_path: Path) -> None:
    mesh = SCENE.mesh(14.0, threads=1)
    assert {kind for kind, _ in mesh.cells} == {"triangle6", "quad8", "line3"}
    assert (mesh.points[:, 2] == 0.0).all() and not mesh.points.flags.writeable
    # Tip circle of the pinion, whose axis is the origin.
    blocks = zip(mesh.cells, mesh.cell_sets["pinion"], strict=True)
    pinion = np.unique(np.concatenate([cells[places].ravel() for (_, cells), places in blocks]))
    assert np.isclose(np.linalg.norm(mesh.points[pinion], axis=1).max(), 41.23, atol=0.01)
    assert pickle.loads(pickle.dumps(mesh)) == mesh
    for ending in ("vtu", "msh", "json"):
        mesh.write(tmp_path / f"pair.{ending}")
        assert (gearwear.Mesh.read(tmp_path / f"pair.{ending}").points == mesh.points).all()
    assert gearwear.Mesh.read(tmp_path / "pair.json") == mesh
    with pytest.raises(gearwear.RunError, match="path of contact"):
        SCENE.mesh(1.0)
    with pytest.raises(ValueError, match="ends in"):
        mesh.write(tmp_path / "pair.stl")
    with pytest.raises(FileNotFoundError):
        gearwear.Mesh.read(tmp_path / "none.vtu")


def test_teeth_in_space() -> None:
    scene = gearwear.Scene.preset("helical").with_({"helical.slices": 5})
    teeth = scene.mesh(three_dimensional=True)
    assert [kind for kind, _ in teeth.cells] == ["hexahedron20"] * 2 and not teeth.point_data
    loaded = scene.mesh(three_dimensional=True, loaded=True)
    # At the next position at which the mesh is solved.
    assert np.allclose(loaded.points, teeth.points, atol=0.05)
    clamped = np.concatenate([loaded.point_sets[f"{gear}_clamp"] for gear in ("pinion", "wheel")])
    displacement = next(values for name, values in loaded.point_data.items() if name.startswith("displacement"))
    assert displacement.shape == (len(loaded.points), 3) and (displacement[clamped] == 0.0).all() and displacement.any()
    with pytest.raises(ValueError, match="three_dimensional=True"):
        scene.mesh(loaded=True)


def test_meshio_there_and_back(tmp_path: Path) -> None:
    mesh = SCENE.mesh()
    of_meshio = mesh.to_meshio()
    assert isinstance(of_meshio, meshio.Mesh)
    assert gearwear.Mesh.from_meshio(of_meshio) == mesh
    # What meshio writes is the same mesh to it.
    of_meshio.write(tmp_path / "pair.vtu")
    assert (meshio.read(tmp_path / "pair.vtu").points == mesh.points).all()


@pytest.mark.parametrize("file_format", ["vtu", "gmsh22"])
def test_groups_survive_what_meshio_writes(tmp_path: Path, file_format: str) -> None:
    mesh = gearwear.Mesh.read(MESHES / "cylinder-on-block-quad8.msh")
    sizes = sorted(sum(map(len, lists)) for lists in mesh.cell_sets.values())
    meshio.write(tmp_path / "written", mesh.to_meshio(), file_format=file_format)
    back = gearwear.Mesh.read(tmp_path / "written")
    assert sorted(sum(map(len, lists)) for lists in back.cell_sets.values()) == sizes


@pytest.mark.parametrize("name", ["cylinder-on-block-quad8.msh", "pair"])
@pytest.mark.parametrize("binary", [True, False])
def test_groups_survive_gmsh_41(tmp_path: Path, name: str, binary: bool) -> None:
    mesh = SCENE.mesh() if name == "pair" else gearwear.Mesh.read(MESHES / name)
    meshio.write(tmp_path / "written.msh", mesh.to_meshio(gmsh=True), file_format="gmsh", binary=binary)
    back = gearwear.Mesh.read(tmp_path / "written.msh")
    assert len(back.points) == len(mesh.points)

    def corners(mesh: gearwear.Mesh) -> dict[str, list[list[float]]]:
        """The points of the cells of each group; the file has points in another order."""
        found: dict[str, list[list[float]]] = {}
        for group, of_blocks in mesh.cell_sets.items():
            pairs = zip(mesh.cells, of_blocks, strict=True)
            found[group] = sorted(mesh.points[nodes].ravel().tolist() for (_, cells), members in pairs for nodes in cells[members])
        return {group: cells for group, cells in found.items() if cells}

    written, read = corners(mesh), corners(back)
    # A cell is in one group: those of the working flanks are not among the flanks any more.
    flanks = [group for group in written if group.endswith("-flanks")]
    assert all(len(read.pop(group)) < len(written.pop(group)) for group in flanks)
    assert read == written


def test_tags_that_are_no_sets_stay(tmp_path: Path) -> None:
    square = meshio.Mesh(
        np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), [("triangle", [[0, 1, 2]])], cell_data={"gmsh:physical": [np.array([7])]}
    )
    mesh = gearwear.Mesh.from_meshio(square)
    assert mesh.cell_data["gmsh:physical"][0].tolist() == [7]
    mesh.write(tmp_path / "square.vtu")
    assert [lists.tolist() for lists in gearwear.Mesh.read(tmp_path / "square.vtu").cell_sets["7"]] == [[0]]


def test_a_problem_on_a_mesh_of_meshio() -> None:
    problem = MESHES / "cylinder-on-block.toml"
    from_file = gearwear.fem_problem(problem)
    mesh = meshio.read(MESHES / "cylinder-on-block-quad8.msh")
    found = gearwear.fem_problem(problem, mesh=mesh)
    assert found.summary["contact"] == from_file.summary["contact"]
    assert found.mesh.point_data.keys() == from_file.mesh.point_data.keys()
    for name, values in from_file.mesh.point_data.items():
        assert found.mesh.point_data[name].tobytes() == values.tobytes(), name
    # The same scaled by 2: pressure of a given load falls by its root where the elements do too.
    mesh.points *= 2.0
    assert gearwear.fem_problem(problem, mesh=gearwear.Mesh.from_meshio(mesh)).summary != from_file.summary
    del mesh.cell_sets[next(iter(mesh.cell_sets))]
    with pytest.raises(gearwear.SceneError):
        gearwear.fem_problem(problem, mesh=mesh)


def test_what_is_no_mesh() -> None:
    points = np.zeros((3, 3))
    unknown = meshio.Mesh(np.zeros((5, 3)), [("triangle", [[0, 1, 2]])])
    unknown.cells[0].type = "polygon3"
    for mesh, says in [
        (meshio.Mesh(points, [("triangle", [[0, 1, 3]])]), "3"),
        (meshio.Mesh(np.zeros((4, 1)), []), "two or three coordinates"),
        (meshio.Mesh(points, [("triangle", [[0, 1, 2]])], point_sets={"a": np.array([-1])}), "0 or more"),
        (unknown, "polygon3"),
    ]:
        with pytest.raises(ValueError, match=says):
            gearwear.Mesh.from_meshio(mesh)

"""Reads with meshio and Gmsh what gearwear writes, and lets gearwear read what they write.

    cargo build --example convert_mesh
    python tests/python/check_meshes.py target/release/examples/convert_mesh      (needs meshio, numpy and gmsh)

The program is the converter of `examples/convert_mesh.rs`. Ends with status 1 at the first difference.
"""

import pathlib
import subprocess
import sys
import tempfile

import gmsh
import meshio
import numpy as np

STYLES = [("a.msh", "2.2"), ("a.msh", "2.2-binary"), ("a.msh", "4.1"), ("a.msh", "4.1-binary"), ("a.vtu", "ascii"),
          ("a.vtu", "base64"), ("a.vtu", "zlib"), ("a.inp", None)]
# Plane and solid kinds whose node order differs between formats are the ones worth checking.
KINDS = ["line3", "triangle6", "quad8", "quad9", "tetra10", "hexahedron20", "hexahedron27"]


def convert(program, source, target, style=None):
    subprocess.run([program, source, target] + ([style] if style else []), check=True)


def joined(mesh, kind):
    blocks = [block.data for block in mesh.cells if block.type == kind]
    return np.concatenate(blocks) if blocks else np.empty((0, 0))


def same(a, b, what, kinds=None):
    # A plane mesh has two coordinates in an Abaqus file.
    assert np.array_equal(a.points[:, : b.points.shape[1]], b.points), f"{what}: points"
    for kind in kinds or {block.type for block in a.cells}:
        assert np.array_equal(joined(a, kind), joined(b, kind)), f"{what}: {kind}"


def known_to_meshio(file):
    """meshio 5.3.5 does not know Abaqus's elements for plane strain: shells of the same nodes stand in for them."""
    text = file.read_text()
    for plane, shell in (("CPE3", "S3"), ("CPE4", "S4"), ("CPE6", "STRI65"), ("CPE8", "S8R")):
        text = text.replace(f"TYPE={plane}\n", f"TYPE={shell}\n")
    file.write_text(text)


def bodies_of(mesh):
    """Kinds of cells of the greatest dimension: those on their boundary are surfaces in an Abaqus file."""
    greatest = max(block.dim for block in mesh.cells)
    return {block.type for block in mesh.cells if block.dim == greatest}


def sets(mesh):
    """Number of cells of each named set. meshio makes sets of the groups of Gmsh 4.1 only: of 2.2 they are counted by their tag."""
    named = {name: sum(0 if cells is None else len(cells) for cells in lists)
             for name, lists in mesh.cell_sets.items() if not name.startswith("gmsh:")}
    tags = np.concatenate(mesh.cell_data["gmsh:physical"])
    return named or {name: int(np.count_nonzero(tags == tag)) for name, (tag, _) in mesh.field_data.items()}


def reference_meshes(program, meshes, folder):
    """Meshes that Gmsh made, through every format of ours, read again by meshio and opened by Gmsh."""
    for source in sorted(meshes.glob("*.msh")):
        original = meshio.read(source)
        for name, style in STYLES:
            target = folder / name
            convert(program, source, target, style)
            if name == "a.inp":
                known_to_meshio(target)
            ours = meshio.read(target)
            what = f"{source.name} as {style or name}"
            same(original, ours, what, bodies_of(original) if name == "a.inp" else None)
            if style in ("4.1", "4.1-binary"):
                assert sets(ours) == sets(original), f"{what}: sets"
            if name == "a.msh":
                gmsh.initialize()
                gmsh.option.setNumber("General.Terminal", 0)
                gmsh.logger.start()
                gmsh.open(str(target))
                names = {gmsh.model.getPhysicalName(*group) for group in gmsh.model.getPhysicalGroups()}
                complaints = [line for line in gmsh.logger.get() if line.startswith(("Warning", "Error"))]
                gmsh.logger.stop()
                gmsh.finalize()
                assert names == set(original.field_data), f"{what}: groups {names}"
                assert not complaints, f"{what}: {complaints}"


def kinds_of_cells(program, folder):
    """One cell of every kind, written by meshio, through our formats."""
    random = np.random.default_rng(1)
    for kind in KINDS:
        nodes = meshio._mesh.num_nodes_per_cell[kind]
        mesh = meshio.Mesh(random.random((nodes, 3)), [(kind, random.permutation(nodes)[None, :])])
        for source in (folder / "in.vtu", folder / "in.msh"):
            meshio.write(source, mesh, **({"file_format": "gmsh22"} if source.suffix == ".msh" else {}))
            for name, style in STYLES[:-1]:
                target = folder / name
                convert(program, source, target, style)
                same(mesh, meshio.read(target), f"{kind} from {source.name} as {style}")


def data(program, folder):
    """Data of points and cells."""
    random = np.random.default_rng(2)
    mesh = meshio.Mesh(random.random((4, 3)), [("triangle", [[0, 1, 2], [1, 3, 2]])],
                       point_data={"u": random.random((4, 3))}, cell_data={"p": [random.random(2)]})
    for compression in (None, "zlib"):
        meshio.vtu.write(folder / "in.vtu", mesh, compression=compression)
        for name, style in STYLES[:-1]:
            convert(program, folder / "in.vtu", folder / name, style)
            ours = meshio.read(folder / name)
            assert np.array_equal(ours.point_data["u"], mesh.point_data["u"]), style
            assert np.array_equal(ours.cell_data["p"][0], mesh.cell_data["p"][0]), style


def main():
    program = sys.argv[1]
    meshes = pathlib.Path(__file__).resolve().parents[2] / "meshes"
    with tempfile.TemporaryDirectory() as folder:
        reference_meshes(program, meshes, pathlib.Path(folder))
        kinds_of_cells(program, pathlib.Path(folder))
        data(program, pathlib.Path(folder))
    print("meshio and Gmsh agree with gearwear's mesh files")


main()

"""What the mesh scripts share: orders and kinds of elements, and writing."""

import argparse

import gmsh

KINDS = ("tri3", "tri6", "quad4", "quad8")


def arguments(description):
    """The options that every script has."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--kind", choices=KINDS, default="quad4")
    parser.add_argument("--refine", type=float, default=1.0, help="elements along a line, times this")
    parser.add_argument("--out", required=True, help="the .msh file to write (4.1, binary)")
    return parser.parse_args()


def begin(kind):
    """An empty model whose elements will be of `kind`."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
    gmsh.option.setNumber("Mesh.Algorithm", 6 if kind.startswith("tri") else 8)
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
    gmsh.option.setNumber("Mesh.MeshSizeFromPoints", 0)
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 0)
    gmsh.option.setNumber("Mesh.SaveAll", 0)


def divide(curves, refine):
    """Divides curves evenly: `curves` maps a curve to its elements at refinement 1."""
    for curve, elements in curves.items():
        gmsh.model.mesh.setTransfiniteCurve(curve, max(1, round(elements * refine)) + 1)


def graded(focus, size_mm, far_mm, reach_mm, refine):
    """Element size: `size_mm` within `reach_mm` of the focus points, then growing to `far_mm`; all of it over `refine`."""
    field = gmsh.model.mesh.field
    distance = field.add("Distance")
    field.setNumbers(distance, "PointsList", focus)
    size = field.add("MathEval")
    field.setString(size, "F", f"min({far_mm}, {size_mm} + 0.15*max(0, F{distance} - {reach_mm})) / {refine}")
    field.setAsBackgroundMesh(size)


def group(dimension, tags, name):
    """A physical group."""
    gmsh.model.setPhysicalName(dimension, gmsh.model.addPhysicalGroup(dimension, tags), name)


def finish(kind, out, version=4.1, binary=True):
    """Meshes and writes."""
    if kind.startswith("quad"):
        gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 1)
        gmsh.option.setNumber("Mesh.RecombineAll", 1)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2 if kind in ("tri6", "quad8") else 1)
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", int(binary))
    gmsh.write(out)
    gmsh.finalize()

"""Makes the small files of this folder with Gmsh and meshio themselves, so that tests read what those programs write.

    python make.py        (needs gmsh and meshio)
"""

import gmsh
import meshio


def gmsh_files():
    """Two quadrilaterals and triangles of second order; a surface in two groups, names with blanks and of other alphabets."""
    for version, label in ((2.2, "22"), (4.1, "41")):
        for binary, encoding in ((0, "ascii"), (1, "binary")):
            for parametric in (0, 1):
                gmsh.initialize()
                gmsh.option.setNumber("General.Terminal", 0)
                gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
                geo = gmsh.model.geo
                points = [geo.addPoint(x, y, 0) for x, y in ((0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1))]
                ends = ((0, 1), (1, 4), (4, 5), (5, 0), (1, 2), (2, 3), (3, 4))
                lines = [geo.addLine(points[a], points[b]) for a, b in ends]
                left = geo.addPlaneSurface([geo.addCurveLoop(lines[:4])])
                right = geo.addPlaneSurface([geo.addCurveLoop([lines[4], lines[5], lines[6], -lines[1]])])
                geo.synchronize()
                for line in lines:
                    gmsh.model.mesh.setTransfiniteCurve(line, 2)
                for surface in (left, right):
                    gmsh.model.mesh.setTransfiniteSurface(surface)
                gmsh.model.mesh.setRecombine(2, left)
                for dimension, tags, name in ((2, [left, right], "whole body"), (2, [right], "правая"),
                                              (1, [lines[0], lines[4]], "base"), (0, [points[0]], "corner"), (1, [lines[5]], "")):
                    group = gmsh.model.addPhysicalGroup(dimension, tags, tag=40 if not name else -1)
                    if name:
                        gmsh.model.setPhysicalName(dimension, group, name)
                gmsh.model.mesh.generate(2)
                gmsh.model.mesh.setOrder(2)
                gmsh.option.setNumber("Mesh.MshFileVersion", version)
                gmsh.option.setNumber("Mesh.Binary", binary)
                gmsh.option.setNumber("Mesh.SaveParametric", parametric)
                suffix = "-parametric" if parametric else ""
                gmsh.write(f"gmsh-{label}-{encoding}{suffix}.msh")
                gmsh.finalize()


def meshio_files():
    """A quadrilateral and two triangles with data of points and cells, as meshio writes them."""
    mesh = meshio.Mesh(
        points=[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.5, 0.1]],
        cells=[("quad", [[0, 1, 2, 3]]), ("triangle", [[1, 4, 2], [0, 1, 2]])],
        point_data={"temperature": [1.5, 2.5, -3.5, 0.1, 1e-300]},
        cell_data={"body": [[7], [8, 9]]},
    )
    for name, options in (("ascii", {"binary": False}), ("zlib", {"compression": "zlib"}), ("base64", {"compression": None})):
        meshio.vtu.write(f"meshio-{name}.vtu", mesh, **options)
    plain = meshio.Mesh(mesh.points, mesh.cells, point_sets={"low": [0, 1]}, cell_sets={"slanted": [[], [0]]})
    meshio.write("meshio.inp", plain)
    # In ASCII meshio 5.3.5 writes data as `np.float64(1.5)`, and 4.1 only with Gmsh's entities.
    meshio.write("meshio-22-binary.msh", mesh, file_format="gmsh22", binary=True)


gmsh_files()
meshio_files()

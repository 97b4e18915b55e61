"""The NAFEMS cylinder on a block, solved by CalculiX on the mesh that gearwear's own tests use.

Case 1 of A. Konter, Advanced finite element contact benchmarks, NAFEMS R0094 (2006): a steel cylinder of radius 50 mm on
an aluminium block, 35 kN per mm, plane strain, frictionless. Half of it is meshed, so half of the load acts.

    python3 nafems_cylinder.py WORK_FOLDER
"""

import pathlib
import sys

import calculix
import mesh_files
import pressure_course
import table

HERE = pathlib.Path(__file__).parent
MESH = HERE / "../../meshes/cylinder-on-block-quad8.msh"
MODULI_MPA = {"cylinder": 210e3, "block": 70e3}
POISSON_RATIO = 0.3
HALF_LOAD_N_PER_MM, TOP_MM = 17500.0, 50.0
# The penalty of the result, and two more ten times apart around it.
PENALTY_MPA_PER_MM, OTHER_PENALTIES_MPA_PER_MM = 1e7, (3e6, 3e7)
# Nothing but contact holds the cylinder up, and a single point of contact does not start the iteration. So the
# cylinder is moved into the block by this much first: a motion of the whole body, which the solution is free to undo.
FIRST_OVERCLOSURE_MM = 1e-3


def solve(folder, penalty_mpa_per_mm):
    """The course (x_mm, pressure_MPa) and the row of figures at a penalty."""
    mesh = mesh_files.read_gmsh(MESH)
    for node in {node for cell in mesh.bodies["cylinder"] for node in mesh.cells[cell][1]}:
        x, y = mesh.points[node]
        mesh.points[node] = x, y - FIRST_OVERCLOSURE_MM
    deck = calculix.Deck(mesh)
    for body, modulus_mpa in MODULI_MPA.items():
        deck.material(body, modulus_mpa, POISSON_RATIO)
    deck.penalty(penalty_mpa_per_mm)
    deck.contact("cylinder-surface", "block-top")
    for node in mesh.nodes_of("symmetry"):
        deck.displace(node, 1)
    for node in mesh.nodes_of("base"):
        deck.displace(node, 2)
    deck.press("top", HALF_LOAD_N_PER_MM / TOP_MM)
    results = deck.solve(folder, f"cylinder-{penalty_mpa_per_mm:.0e}", "base")

    course = sorted((mesh.points[node][0], results.pressure_mpa[node]) for node in mesh.nodes_of("cylinder-surface"))
    fitted = pressure_course.hertz_ellipse(*pressure_course.mirrored(*zip(*course)))
    force = results.contacts["cylinder-surface"]
    row = [penalty_mpa_per_mm, max(pressure for _, pressure in course), force.length_mm, 2.0 * force.y_n_per_mm,
           fitted.peak_mpa, fitted.half_width_mm]
    return course, row


def main():
    folder = pathlib.Path(sys.argv[1])
    notes = [
        f"CalculiX {calculix.version()}, made by validation/cross-check/run.sh (nafems_cylinder.py)",
        "penalty_MPa_per_mm: stiffness of the contact",
        "peak_pressure_MPa: greatest at a node",
        "half_width_mm: length of surface under pressure, of half the problem",
        "contact_force_N_per_mm: of the whole problem",
        "fitted_pressure_MPa, fitted_half_width_mm: of the ellipse through the pressures at the nodes",
    ]
    columns = ["penalty_MPa_per_mm", "peak_pressure_MPa", "half_width_mm", "contact_force_N_per_mm",
               "fitted_pressure_MPa", "fitted_half_width_mm"]
    course, row = solve(folder, PENALTY_MPA_PER_MM)
    table.write(HERE / "nafems-cylinder.csv", notes, columns, [row])
    table.write(HERE / "nafems-cylinder-pressure.csv", notes[:1] + ["x_mm: distance from the line of symmetry"],
                ["x_mm", "pressure_MPa"], [point for point in course if point[1] > 0.0])
    others = [solve(folder, penalty)[1] for penalty in OTHER_PENALTIES_MPA_PER_MM]
    table.write(HERE / "nafems-cylinder-penalty.csv", notes, columns, sorted([row, *others]))


if __name__ == "__main__":
    main()

"""A pinion in an internal wheel, solved by CalculiX on the path of contact, new and worn.

20 in 60 teeth of module 3 at 20°, shifted by +0.3 and −0.3, the ring cut by a shaper cutter of 25 teeth and held 3.5 modules outside its root
circle. Tips are rounded at 0.1 mm; none touches at these positions. Sectors of five teeth with free sides, in plane strain, on the meshes that `gearwear mesh` writes.

Normals are those of CalculiX's master: below the pitch point the pinion, above it the wheel, as in gearwear. Root stresses are those along the
surface at the nodes of the reference teeth's fillets, means of what the elements around a node extrapolate to it.

The worn flanks are those of `gearwear run` after twenty million revolutions (worn_flanks.py), 11.5 µm deep on the pinion and 5.1 µm on the wheel.

    python3 internal_pair.py WORK_FOLDER
"""

import math
import pathlib
import subprocess
import sys

import calculix
import table
import turned_pair
import worn_flanks

HERE = pathlib.Path(__file__).parent
SCENE = """
[pair]
normal_module_mm = 3.0
pressure_angle_deg = 20.0
centre_distance_mm = 60.0
face_width_mm = 20.0
pinion = { teeth = 20, profile_shift = 0.3, tip_rounding_mm = 0.1 }
wheel = { teeth = 60, internal = true, profile_shift = -0.3, tip_diameter_mm = 176.2, tip_rounding_mm = 0.1, rim_thickness_mm = 10.5, cutter = { teeth = 25 } }
[fem]
body = "sector"
sector_teeth = 5
elements_per_half_width = 5
[operation]
pinion_torque_Nm = 150.0
pinion_revolutions = 2e7
[contact]
surface = "fem"
[wear]
law = "archard"
coefficient_m2_per_N = 1e-17
[numerics]
flank_points = 6000
step = "adaptive"
tolerance_um = 0.05
error_estimate = false
verify = false
"""
PRESSURE_ANGLE_RAD = math.radians(20.0)
TORQUE_NM, FACE_WIDTH_MM = 150.0, 20.0
BASE_RADIUS_MM = 30.0 * math.cos(PRESSURE_ANGLE_RAD)
BASE_PITCH_MM = 3.0 * math.pi * math.cos(PRESSURE_ANGLE_RAD)
PITCH_POINT_MM = 30.0 * math.sin(PRESSURE_ANGLE_RAD)
# Of the reference pair, by revolutions, with the transmission error in µm that the search begins at, near the answer to save runs. Contact lasts from A,
# 4.1594 mm, to E, 18.8279 mm; B is at 9.9715 and D at 13.0157 mm. The mesh cycle of the run is that between 7.07 and 15.92 mm.
REVOLUTIONS = 2e7
POSITIONS_MM = {
    0.0: [("7", 8.430), ("11.5", 13.033), ("17", 8.524)],
    REVOLUTIONS: [("7", 17.88), ("7.5", 17.214), ("11.5", 18.019), ("15.5", 18.261)],
}
PENALTY_MPA_PER_MM = 1e8
YOUNG_MODULUS_MPA, POISSON_RATIO = 206e3, 0.3
REACH_MM = 0.06
PAIR = turned_pair.TurnedPair(
    dict.fromkeys(turned_pair.GEARS, YOUNG_MODULUS_MPA), POISSON_RATIO, BASE_RADIUS_MM, FACE_WIDTH_MM, TORQUE_NM,
    torque_tolerance=2e-3, stresses=True)

# Radii from the ends of the fillets to those of the tip roundings.
WORN = worn_flanks.WornFlanks(
    {"pinion": worn_flanks.Gear(0.0, BASE_RADIUS_MM, (29.5, 33.5)),
     "wheel": worn_flanks.Gear(-60.0, 3.0 * BASE_RADIUS_MM, (88.5, 93.0), is_internal=True)},
    YOUNG_MODULUS_MPA, POISSON_RATIO)


def fillets_of_reference_tooth(mesh, gear):
    """The nodes of the fillet that ends on the working flank of the reference tooth, in order from there."""
    beside = {}
    for edge in mesh.edges[f"{gear}-fillets"]:
        nodes = mesh.edge_nodes(*edge)
        for a, b in zip(nodes, nodes[1:]):
            beside.setdefault(a, []).append(b)
            beside.setdefault(b, []).append(a)
    chain = [node for node in mesh.nodes_of(turned_pair.flank(gear, 0)) if node in beside][:1]
    while True:
        further = [node for node in beside[chain[-1]] if node not in chain]
        if not further:
            return chain
        chain.append(further[0])


def root_stress_mpa(mesh, results, gear):
    """Greatest stress along the fillet of the working flank."""
    chain = fillets_of_reference_tooth(mesh, gear)
    along = []
    for k, node in enumerate(chain):
        a, b = (mesh.points[chain[at]] for at in (max(k - 1, 0), min(k + 1, len(chain) - 1)))
        length = math.dist(a, b)
        t = (b[0] - a[0]) / length, (b[1] - a[1]) / length
        xx, yy, _, xy, *_ = results.stress_mpa[node]
        along.append(t[0] * t[0] * xx + t[1] * t[1] * yy + 2.0 * t[0] * t[1] * xy)
    return max(along)


def row(folder, scene, run, revolutions, position_mm, guess_um):
    """A line of the table: new at 0 revolutions, with the wear of the run at its end."""
    mesh = turned_pair.pair_mesh(scene, position_mm)
    name = f"internal-{revolutions:g}-at-{position_mm}"
    if revolutions > 0.0:
        WORN.wear_down(folder, f"{name}-shape", mesh, run)
    whole = {group: list(edges) for group, edges in mesh.edges.items()}
    own_mm = float(position_mm)
    sides = turned_pair.contacts(mesh, lambda pair: own_mm + pair * BASE_PITCH_MM < PITCH_POINT_MM, REACH_MM)
    error_um, torque_nm, results = PAIR.at_torque(folder, name, mesh, guess_um, sides, PENALTY_MPA_PER_MM)
    loads, peaks = PAIR.line_loads(results, torque_nm, sides), turned_pair.peaks(mesh, results, sides)
    mesh.edges.update(whole)
    return [revolutions, own_mm, torque_nm, error_um, *loads, *peaks,
            *(root_stress_mpa(mesh, results, gear) for gear in turned_pair.GEARS)]


def main():
    folder = pathlib.Path(sys.argv[1])
    scene, run = folder / "internal.toml", folder / "internal-worn"
    scene.write_text(SCENE, encoding="utf-8")
    subprocess.run([turned_pair.gearwear(), "run", scene, "--out", run, "--quiet", "--no-report"], check=True)
    rows = [row(folder, scene, run, revolutions, position_mm, guess_um)
            for revolutions, positions in POSITIONS_MM.items() for position_mm, guess_um in positions]
    table.write(HERE / "internal-pair.csv", [
        f"CalculiX {calculix.version()}, made by validation/cross-check/run.sh (internal_pair.py)",
        f"revolutions: 0 new; {REVOLUTIONS:g} with the wear of gearwear run in the mesh",
        "position_mm: radius of curvature of the pinion at the theoretical contact point of the reference pair",
        "behind, reference, ahead: tooth pairs -1, 0, 1; zeros without contact",
        "line_load: the pair's part of the torque over base radius and face width; peak_pressure: greatest at a node",
        "root_stress: greatest along the fillet on the working side of the reference tooth",
    ], ["revolutions", "position_mm", "torque_Nm", "transmission_error_um",
        *[name.format(pair) for name in ("line_load_{}_N_per_mm", "peak_pressure_{}_MPa") for pair in ("behind", "reference", "ahead")],
        "root_stress_pinion_MPa", "root_stress_wheel_MPa"], rows)


if __name__ == "__main__":
    main()

"""A pinion that the rack undercuts, on its wheel, solved by CalculiX where the corner of the undercut touches and elsewhere.

15 on 40 teeth of module 1 at 20° without profile shift, whose flank ends at a form circle of 7.0498 mm, 2 µm above the base
circle: contact begins there, in the corner between involute and trochoid, and not at the wheel's tip edge. Tips are rounded at
0.05 mm. Plane strain on the meshes that `gearwear mesh` writes; their outlines are held against the rack's own envelope.

Normals are those of CalculiX's master. Below the pitch point that is the pinion, as in gearwear, whose contact ends at the corner. In
the rows with `below_corner` the trochoid is a part of the surface that may touch, and the normals of the pair at the corner are the
wheel's, whose flank is the smooth one.

    python3 undercut_pair.py WORK_FOLDER
"""

import math
import pathlib
import sys

import calculix
import rack_outline
import table
import turned_pair

HERE = pathlib.Path(__file__).parent
SCENE = """
[pair]
normal_module_mm = 1.0
pressure_angle_deg = 20.0
centre_distance_mm = 27.5
face_width_mm = 10.0
[pair.pinion]
teeth = 15
profile_shift = 0.0
tip_rounding_mm = 0.05
[pair.wheel]
teeth = 40
profile_shift = 0.0
tip_rounding_mm = 0.05
[fem]
elements_per_half_width = 5
[operation]
pinion_torque_Nm = 12.0
pinion_revolutions = 1000.0
[wear]
law = "archard"
coefficient_m2_per_N = 1e-20
[numerics]
error_estimate = false
verify = false
"""
PRESSURE_ANGLE_RAD = math.radians(20.0)
CENTRE_DISTANCE_MM, TORQUE_NM, FACE_WIDTH_MM = 27.5, 12.0, 10.0
REFERENCE_RADIUS_MM = {"pinion": 7.5, "wheel": 20.0}
BASE_RADIUS_MM = REFERENCE_RADIUS_MM["pinion"] * math.cos(PRESSURE_ANGLE_RAD)
BASE_PITCH_MM = math.pi * math.cos(PRESSURE_ANGLE_RAD)
PITCH_POINT_MM = REFERENCE_RADIUS_MM["pinion"] * math.sin(PRESSURE_ANGLE_RAD)
# Of the reference pair, whether the trochoid may touch, the transmission error in µm that the search begins at, near the
# answer to save runs, and the penalty in MPa/mm. Contact lasts from A, 0.1713 mm, to E, 4.7521 mm.
POSITIONS_MM = [
    ("1.0", False, 6.846, 3e8),  # two pairs on the path
    ("1.85", False, 7.590, 3e8),  # the pair ahead 0.05 mm beyond E, with the pinion's tip edge
    ("2.4", False, 10.579, 3e8),  # one pair
    ("3.0", False, 7.528, 3e8),  # the pair behind 0.12 mm before A, where the wheel's tip edge touches above the corner
    ("3.05", False, 7.145, 1e9),  # the pair behind 0.07 mm before A, with the corner
    ("3.1234", False, 7.086, 1e9),  # the pair behind at A
    ("3.05", True, 7.170, 1e9),
    ("3.1234", True, 7.120, 1e9),
]
YOUNG_MODULUS_MPA, POISSON_RATIO = 206e3, 0.3
# CalculiX takes a last correction of a thousandth for converged while places of contact still pull, and then appends an increment.
TOLERANCES = "1e-6,1e-5,,,1e-6"
# Flanks farther apart than this before deformation do not touch, and the trochoid is looked at so far from the corner.
REACH_MM, BELOW_CORNER_MM = 0.015, 0.04
PAIR = turned_pair.TurnedPair(
    dict.fromkeys(turned_pair.GEARS, YOUNG_MODULUS_MPA), POISSON_RATIO, BASE_RADIUS_MM, FACE_WIDTH_MM, TORQUE_NM,
    torque_tolerance=2e-3, tolerances=TOLERANCES)


def contacts(mesh, position_mm, below_corner):
    """Slave and master of each tooth pair."""
    def is_wheel_slave(pair):
        own_mm = position_mm + pair * BASE_PITCH_MM
        return own_mm < PITCH_POINT_MM and not (below_corner and own_mm < 0.5)

    if below_corner:
        for pair in turned_pair.PAIRS:
            add_trochoid(mesh, turned_pair.flank("pinion", pair))
    return turned_pair.contacts(mesh, is_wheel_slave, REACH_MM)


def add_trochoid(mesh, flank):
    """Lets a flank of the pinion go on below its form circle."""
    corner = min((mesh.points[node] for node in mesh.nodes_of(flank)), key=lambda point: math.hypot(*point))
    mesh.edges[flank] = mesh.edges[flank] + [
        edge for edge in mesh.edges["pinion-fillets"]
        if all(math.dist(mesh.points[node], corner) < BELOW_CORNER_MM for node in mesh.edge_nodes(*edge))]


def from_space(gear, position_mm, point):
    """Radius and angle of a point of the mesh from the middle of the nearest tooth space.

    One rack lies between both gears; its flank goes through the contact point, and its teeth point towards either axis.
    """
    x, y = point if gear == "pinion" else (-point[0], CENTRE_DISTANCE_MM - point[1])
    # Of the rack's tooth that cuts the pinion's space: where its middle is, along the pitch line.
    middle_mm = (PITCH_POINT_MM - position_mm) / math.cos(PRESSURE_ANGLE_RAD) - 0.25 * math.pi
    if gear == "wheel":
        middle_mm = -(middle_mm + 0.5 * math.pi)
    radius_mm = REFERENCE_RADIUS_MM[gear]
    pitch = 1.0 / radius_mm * math.pi
    angle = math.atan2(-x, y) + middle_mm / radius_mm
    return math.hypot(x, y), (angle + 0.5 * pitch) % pitch - 0.5 * pitch


def outlines(mesh, position_mm):
    """Rows of greatest distances of the mesh's nodes from the rack's envelope, part by part, and the pinion's form circle."""
    rack = rack_outline.Rack(1.0, PRESSURE_ANGLE_RAD, 1.25, 0.38)
    rows = []
    for number, (gear, teeth, tip_mm) in enumerate((("pinion", 15, 8.5), ("wheel", 40, 21.0))):
        cut = rack_outline.CutGear(rack, teeth, tip_mm, 0.05)
        flanks = {node for pair in turned_pair.PAIRS for node in mesh.nodes_of(turned_pair.flank(gear, pair))}
        parts = [flanks, *(set(mesh.nodes_of(f"{gear}-{part}")) for part in ("fillets", "roots"))]
        for part, nodes in enumerate(parts):
            off_um = [1e3 * cut.off_mm(*from_space(gear, position_mm, mesh.points[node])) for node in nodes]
            rows.append([number, part, len(off_um), max(off_um), min(off_um), cut.form_radius_mm()])
    return rows


def main():
    folder = pathlib.Path(sys.argv[1])
    scene, rows = folder / "undercut.toml", []
    scene.write_text(SCENE, encoding="utf-8")
    for position_mm, below_corner, guess_um, penalty_mpa_per_mm in POSITIONS_MM:
        mesh = turned_pair.pair_mesh(scene, position_mm)
        if not rows:
            write_outlines(outlines(mesh, float(position_mm)))
        sides = contacts(mesh, float(position_mm), below_corner)
        name = f"undercut-at-{position_mm}{'-below-corner' if below_corner else ''}"
        error_um, torque_nm, results = PAIR.at_torque(folder, name, mesh, guess_um, sides, penalty_mpa_per_mm)
        rows.append([float(position_mm), below_corner, penalty_mpa_per_mm, torque_nm, error_um, *PAIR.line_loads(results, torque_nm, sides),
                     *turned_pair.peaks(mesh, results, sides)])
    write_rows(rows, calculix.version())


def write_rows(rows, version):
    table.write(HERE / "undercut-pair.csv", [
        f"CalculiX {version}, made by validation/cross-check/run.sh (undercut_pair.py)",
        "position_mm: radius of curvature of the pinion at the theoretical contact point of the reference pair",
        "below_corner: 0 where contact ends at the corner of the undercut and its normals are the pinion's, as in gearwear; 1 where it goes on "
        "over the trochoid and the normals of the pair behind are the wheel's",
        "behind, reference, ahead: tooth pairs -1, 0, 1; zeros without contact",
        "line_load: the pair's part of the torque over base radius and face width; peak_pressure: greatest at a node",
    ], ["position_mm", "below_corner", "penalty_MPa_per_mm", "torque_Nm", "transmission_error_um",
        *[name.format(pair) for name in ("line_load_{}_N_per_mm", "peak_pressure_{}_MPa") for pair in ("behind", "reference", "ahead")]], rows)


def write_outlines(rows):
    table.write(HERE / "undercut-outline.csv", [
        "The outlines of the mesh at the first position against the envelope of the rack alone (rack_outline.py), made by "
        "validation/cross-check/run.sh (undercut_pair.py)",
        "gear: 0 pinion, 1 wheel; part: 0 working flanks with roundings, 1 fillets, 2 roots (tips of teeth that are not resolved are left sharp and are left out)",
        "lacking, proud: how far a node lies inside and outside of the envelope, at most; form_radius: where the rack's tip begins to cut",
    ], ["gear", "part", "nodes", "lacking_um", "proud_um", "form_radius_mm"],
        [[*row[:4], -row[4], row[5]] for row in rows])


if __name__ == "__main__":
    main()

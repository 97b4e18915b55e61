"""The fzg-c pair with tips rounded at 0.1 mm, solved by CalculiX where a tip edge touches before A and after E, new and worn.

Two pairs touch everywhere here: the one at its tip edge and the one that has the path to itself otherwise. The slave is
the flank whose tip edge may touch, so that the normals CalculiX takes, the master's, are those of the smoother surface.

The worn flanks are those of `gearwear run` after 127.75 h: every working flank's node is moved inwards along the normal
by the depth at its nominal radius, and the bodies follow as an elastic solid would, without keeping its stress.

    python3 tip_edges.py WORK_FOLDER
"""

import bisect
import dataclasses
import math
import pathlib
import subprocess
import sys

import calculix
import fzg_c_pair
import table
import turned_pair

HERE = pathlib.Path(__file__).parent
SCENE = """
[pair]
preset = "fzg-c"
pinion = { tip_rounding_mm = 0.1 }
wheel = { tip_rounding_mm = 0.1 }
[operation]
pinion_torque_Nm = 302.0
pinion_speed_rpm = 150.0
hours = 127.75
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
A_MM, E_MM, BASE_PITCH_MM = 4.4723, 23.5694, 13.2846
# Of the reference pair. The pair behind it is before A at the first two, the pair ahead of it after E at the last two;
# with the transmission error in µm that the search begins at, new and worn, near the answer to save runs.
POSITIONS_MM = {
    f"{A_MM - 0.4 + BASE_PITCH_MM:.4f}": (29.794, 37.0),
    f"{A_MM - 0.2 + BASE_PITCH_MM:.4f}": (27.260, 34.520),
    "7": (24.730, 30.805),
    f"{E_MM + 0.2 - BASE_PITCH_MM:.4f}": (27.215, 34.140),
    f"{E_MM + 0.4 - BASE_PITCH_MM:.4f}": (29.280, 36.246),
}
PITCH_POINT_MM = 13.9701
GEARS = {"pinion": (0.0, 0.5 * 4.5 * 16 * math.cos(math.radians(20.0))), "wheel": (91.5, 0.5 * 4.5 * 24 * math.cos(math.radians(20.0)))}
# Radii between which the flank is involute, whose nodes tell where the tooth stands.
INVOLUTE_MM = {"pinion": (36.0, 40.0), "wheel": (55.0, 58.0)}
HOURS = 127.75
# Flanks further apart than this before deformation do not touch: they approach each other by the transmission error at most.
REACH_MM = 0.06
PAIR = dataclasses.replace(fzg_c_pair.PAIR, torque_tolerance=1e-3)


def contacts(mesh, position_mm):
    """Slave and master of each tooth pair: first the gear whose addendum touches."""
    return turned_pair.contacts(mesh, lambda pair: position_mm + pair * BASE_PITCH_MM < PITCH_POINT_MM, REACH_MM)


def wear_of(run, gear):
    """Radii of the nominal flank in mm, and the depth in mm there."""
    rows = table.read(run / f"{gear}.csv")
    return [float(row["radius_mm"]) for row in rows], [1e-3 * float(row["wear_um"]) for row in rows]


def interpolated(places, values, at):
    k = min(max(bisect.bisect_right(places, at), 1), len(places) - 1)
    t = (at - places[k - 1]) / (places[k] - places[k - 1])
    return values[k - 1] + min(max(t, 0.0), 1.0) * (values[k] - values[k - 1])


def chain(mesh, group):
    """The nodes of a flank from root to tip."""
    centre = (0.0, GEARS[group.split("-")[0]][0])
    return sorted(mesh.nodes_of(group), key=lambda node: math.dist(mesh.points[node], centre))


def inward_normal(before, at, after):
    """Of the parabola through three points of a flank at the middle one, towards the material.

    Working flanks are those on the anticlockwise side of their tooth: the material is to the right of the way from root to tip.
    """
    h, k = math.dist(before, at), math.dist(at, after)
    tangent = [(k * k * (b - a) + h * h * (c - b)) / (h * k * (h + k)) for a, b, c in zip(before, at, after)]
    length = math.hypot(*tangent)
    return tangent[1] / length, -tangent[0] / length


def nominal_radii(points, gear):
    """Radius of the involute's point whose normal passes through each point: normals are tangents of the base circle."""
    axis_mm, base_mm = GEARS[gear]
    polar = [(math.hypot(x, y - axis_mm), math.atan2(y - axis_mm, x)) for x, y in points]
    # Roll angle + polar angle - pressure angle is one and the same for all points of an involute.
    sums = sorted(math.tan(math.acos(base_mm / r)) + angle - math.acos(base_mm / r)
                  for r, angle in polar if INVOLUTE_MM[gear][0] < r < INVOLUTE_MM[gear][1])
    if sums[-1] - sums[0] > 1e-7:
        raise SystemExit(f"the flank of the {gear} is no involute between {INVOLUTE_MM[gear]} mm")
    whole = sums[len(sums) // 2]
    rolls = [whole - angle + (math.acos(base_mm / r) if r > base_mm else 0.0) for r, angle in polar]
    return [base_mm * math.hypot(1.0, max(roll, 0.0)) for roll in rolls]


def wear_down(folder, name, mesh, run):
    """Moves the nodes of the mesh to where the flanks are worn."""
    moves = {}
    for gear in GEARS:
        worn = wear_of(run, gear)
        for pair in turned_pair.PAIRS:
            nodes = chain(mesh, turned_pair.flank(gear, pair))
            points = [mesh.points[node] for node in nodes]
            for i, (node, radius_mm) in enumerate(zip(nodes, nominal_radii(points, gear))):
                middle = min(max(i, 1), len(nodes) - 2)
                depth_mm = interpolated(*worn, radius_mm)
                moves[node] = [depth_mm * part for part in inward_normal(*points[middle - 1:middle + 2])]
    deck = calculix.Deck(mesh)
    for body in mesh.bodies:
        deck.material(body, fzg_c_pair.YOUNG_MODULUS_MPA, fzg_c_pair.POISSON_RATIO)
    fixed = {node: (0.0, 0.0) for gear in GEARS for node in mesh.nodes_of(f"{gear}-clamp")}
    for node, move in {**fixed, **moves}.items():
        deck.displace(node, 1, move[0])
        deck.displace(node, 2, move[1])
    moved = {**deck.solve(folder, name, "wheel-clamp").displacement_mm, **moves}
    for node, (x, y) in mesh.points.items():
        dx, dy = moved.get(node, (0.0, 0.0))
        mesh.points[node] = x + dx, y + dy


def row(folder, scene, run, hours, position_mm):
    """A line of the table: new at 0 hours, with the wear of the run at its end."""
    mesh = turned_pair.pair_mesh(scene, position_mm)
    name = f"tips-{hours:g}-h-at-{position_mm}"
    if hours > 0.0:
        wear_down(folder, f"{name}-shape", mesh, run)
    sides = contacts(mesh, float(position_mm))
    guess_um = POSITIONS_MM[position_mm][hours > 0.0]
    error_um, torque_nm, results = PAIR.at_torque(folder, name, mesh, guess_um, sides, fzg_c_pair.PENALTY_MPA_PER_MM)
    return [hours, float(position_mm), torque_nm, error_um, *PAIR.line_loads(results, torque_nm, sides),
            *turned_pair.peaks(mesh, results, sides)]


def main():
    folder = pathlib.Path(sys.argv[1])
    scene, run = folder / "rounded.toml", folder / "worn"
    scene.write_text(SCENE, encoding="utf-8")
    subprocess.run([turned_pair.gearwear(), "run", scene, "--out", run, "--quiet"], check=True)
    rows = [row(folder, scene, run, hours, position_mm) for hours in (0.0, HOURS) for position_mm in POSITIONS_MM]
    write_rows(rows, calculix.version())


def write_rows(rows, version):
    columns = [name.format(pair) for name in ("line_load_{}_N_per_mm", "peak_pressure_{}_MPa")
               for pair in ("behind", "reference", "ahead")]
    table.write(HERE / "fzg-c-tip-edges.csv", [
        f"CalculiX {version}, made by validation/cross-check/run.sh (tip_edges.py)",
        "hours: 0 new; 127.75 with the wear of gearwear run in the mesh (committed: that of revision c373fed)",
        "position_mm: radius of curvature of the pinion at the theoretical contact point of the reference pair",
        "behind, reference, ahead: tooth pairs -1, 0, 1; zeros without contact",
        "line_load: the pair's part of the torque over base radius and face width; peak_pressure: greatest at a node",
    ], ["hours", "position_mm", "torque_Nm", "transmission_error_um", *columns], rows)


if __name__ == "__main__":
    main()

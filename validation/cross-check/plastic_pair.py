"""A plastic wheel on a rigid pinion, solved by CalculiX where tip edges touch far before A and after E.

The pair of validation/plastic-rigid-pinion in plane strain, its tips rounded at 0.05 mm so that no pressure is singular, on the meshes
that `gearwear mesh` writes: sectors of seven teeth whose cuts move with the clamp circles. Up to three pairs touch at once. As in
tip_edges.py the slave is the flank whose tip edge may touch.

    python3 plastic_pair.py WORK_FOLDER
"""

import math
import pathlib
import sys

import calculix
import fzg_c_pair
import table
import tip_edges

HERE = pathlib.Path(__file__).parent
SCENE = HERE.parent / "plastic-rigid-pinion" / "scene.toml"
ROUNDING_MM = 0.05
TORQUE_NM, FACE_WIDTH_MM = 15.692308, 15.0
BASE_RADIUS_MM = 0.5 * 51 * math.cos(math.radians(20.0))
BASE_PITCH_MM = math.pi * math.cos(math.radians(20.0))
PITCH_POINT_MM = 9.421
YOUNG_MODULUS_MPA = {"pinion": 1e8, "wheel": 2282.0}
POISSON_RATIO = 0.3
# Of the reference pair: the pair behind it is 1.7, 1.3 and 0.6 mm before A, the pair ahead of it 0.8, 1.2 and 1.9 mm after E; with the
# transmission error in µm that the search begins at, near the answer to save runs.
POSITIONS_MM = {"9.0": 80.0, "9.42": 85.0, "10.1": 75.0}
# 0.1 % of the greatest approach, under the greatest pressure.
PENALTY_MPA_PER_MM = 1e6
# Flanks farther apart than this before deformation do not touch.
REACH_MM = 0.2
TORQUE_TOLERANCE = 1e-3


def scene_file(folder):
    """The pair with rounded tips and five elements in the half-width."""
    text = SCENE.read_text(encoding="utf-8")
    for name in ("pinion", "wheel"):
        text = text.replace(f"[pair.{name}]\n", f"[pair.{name}]\ntip_rounding_mm = {ROUNDING_MM}\n")
    text = text.replace("[fem]\n", "[fem]\nelements_per_half_width = 5\n")
    path = folder / "plastic.toml"
    path.write_text(text, encoding="utf-8")
    return path


def contacts(mesh, position_mm):
    """Slave and master of each tooth pair, only the edges that may touch."""
    sides = []
    for pair in fzg_c_pair.PAIRS:
        below_pitch_point = position_mm + pair * BASE_PITCH_MM < PITCH_POINT_MM
        order = ("wheel", "pinion") if below_pitch_point else ("pinion", "wheel")
        sides.append(tuple(fzg_c_pair.flank(gear, pair) for gear in order))
    for pair in sides:
        near = [tip_edges.edges_near(mesh, group, other, reach_mm)
                for group, other, reach_mm in zip(pair, reversed(pair), (REACH_MM, 2.0 * REACH_MM))]
        mesh.edges.update(zip(pair, near))
    return [pair for pair in sides if all(mesh.edges[side] for side in pair)]


def solve(folder, name, mesh, transmission_error_um, sides):
    """The results at an angle, and the torque in N·m."""
    angle_rad = 1e-3 * transmission_error_um / BASE_RADIUS_MM
    deck = calculix.Deck(mesh)
    for body in mesh.bodies:
        deck.material(body, YOUNG_MODULUS_MPA[body], POISSON_RATIO)
    deck.penalty(PENALTY_MPA_PER_MM)
    for slave, master in sides:
        deck.contact(slave, master)
    for gear in YOUNG_MODULUS_MPA:
        mesh.edges[f"{gear}-held"] = mesh.edges[f"{gear}-clamp"] + mesh.edges[f"{gear}-sides"]
    for node in mesh.nodes_of("wheel-held"):
        deck.displace(node, 1)
        deck.displace(node, 2)
    for node in mesh.nodes_of("pinion-held"):
        x, y = mesh.points[node]
        deck.displace(node, 1, -angle_rad * y)
        deck.displace(node, 2, angle_rad * x)
    results = deck.solve(folder, name, "pinion-held")
    moment_n = sum(mesh.points[node][0] * fy - mesh.points[node][1] * fx
                   for node, (fx, fy) in results.reaction_n_per_mm.items())
    return results, 1e-3 * moment_n * FACE_WIDTH_MM


def at_torque(folder, name, mesh, error_um, sides):
    """The transmission error in µm that gives the torque, with the results there: secant steps from the origin."""
    before = (0.0, 0.0)
    for _ in range(8):
        results, torque_nm = solve(folder, name, mesh, error_um, sides)
        print(f"{name}: {error_um:.5f} µm, {torque_nm:.5f} N·m, {results.iterations} iterations", flush=True)
        if abs(torque_nm - TORQUE_NM) < TORQUE_TOLERANCE * TORQUE_NM:
            return error_um, torque_nm, results
        slope = (error_um - before[0]) / (torque_nm - before[1])
        before = (error_um, torque_nm)
        error_um += slope * (TORQUE_NM - torque_nm)
    raise SystemExit(f"{name}: no angle found that gives {TORQUE_NM} N·m")


def line_loads(results, torque_nm, sides):
    """Line loads in N/mm, pair by pair: shares of the moment of all contact forces about the pinion's axis."""
    whole = 1e3 * torque_nm / (BASE_RADIUS_MM * FACE_WIDTH_MM)
    moments = {slave: abs(results.contacts[slave].moment_n) for slave, _ in sides}
    loads = []
    for pair in fzg_c_pair.PAIRS:
        names = [fzg_c_pair.flank(gear, pair) for gear in YOUNG_MODULUS_MPA]
        slave = next((slave for slave, _ in sides if slave in names), None)
        loads.append(moments[slave] / sum(moments.values()) * whole if slave else 0.0)
    return loads


def main():
    folder = pathlib.Path(sys.argv[1])
    scene, rows = scene_file(folder), []
    for position_mm, guess_um in POSITIONS_MM.items():
        mesh = fzg_c_pair.pair_mesh(scene, position_mm)
        sides = contacts(mesh, float(position_mm))
        error_um, torque_nm, results = at_torque(folder, f"plastic-at-{position_mm}", mesh, guess_um, sides)
        rows.append([float(position_mm), torque_nm, error_um, *line_loads(results, torque_nm, sides)])
    table.write(HERE / "plastic-pair.csv", [
        f"CalculiX {calculix.version()}, made by validation/cross-check/run.sh (plastic_pair.py)",
        "position_mm: radius of curvature of the pinion at the theoretical contact point of the reference pair",
        "behind, reference, ahead: tooth pairs -1, 0, 1; zeros without contact",
        "line_load: the pair's part of the torque over base radius and face width",
    ], ["position_mm", "torque_Nm", "transmission_error_um",
        *[f"line_load_{pair}_N_per_mm" for pair in ("behind", "reference", "ahead")]], rows)


if __name__ == "__main__":
    main()

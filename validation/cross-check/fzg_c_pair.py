"""The fzg-c pair at 302 N·m, solved by CalculiX on the meshes that `gearwear mesh` writes, at three positions.

Tips are sharp: no tip edge touches at these positions.

    python3 fzg_c_pair.py WORK_FOLDER
"""

import math
import pathlib
import subprocess
import sys

import calculix
import pressure_course
import table
import turned_pair
from turned_pair import PAIRS, PINION_ON_WHEEL, TurnedPair, flank, gearwear

HERE = pathlib.Path(__file__).parent
# Double contact before B (10.28 mm), single contact at C, double contact after D (17.76 mm); with the transmission error
# in µm that the search begins at, near the answer to save runs.
POSITIONS_MM = {"7": 25.0, "13.9701": 37.5, "21.5": 25.0}
SINGLE_CONTACT_MM = "13.9701"
YOUNG_MODULUS_MPA, POISSON_RATIO = 206e3, 0.3
TORQUE_NM, FACE_WIDTH_MM = 302.0, 14.0
BASE_RADIUS_MM = 0.5 * 4.5 * 16 * math.cos(math.radians(20.0))
# The penalty of the result, and two more ten times apart around it.
PENALTY_MPA_PER_MM, OTHER_PENALTIES_MPA_PER_MM = 1e8, (3e7, 3e8)
YOUNG_MODULI_MPA = dict.fromkeys(turned_pair.GEARS, YOUNG_MODULUS_MPA)
PAIR = TurnedPair(YOUNG_MODULI_MPA, POISSON_RATIO, BASE_RADIUS_MM, FACE_WIDTH_MM, TORQUE_NM, torque_tolerance=1e-4)


def scene_file(folder):
    """The pair with sharp tips as a file."""
    scene = folder / "fzg-c.toml"
    scene.write_bytes(subprocess.run([gearwear(), "init", "thesis-spur"], capture_output=True, check=True).stdout)
    return scene


def course(mesh, results, pair):
    """The pressure (along_mm, MPa) over the pinion's flank, from its middle towards the tip."""
    nodes = sorted(mesh.nodes_of(flank("pinion", pair)), key=lambda node: math.hypot(*mesh.points[node]))
    along_mm = [0.0]
    for a, b in zip(nodes, nodes[1:]):
        along_mm.append(along_mm[-1] + math.dist(mesh.points[a], mesh.points[b]))
    pressure = [results.pressure_mpa.get(node, 0.0) for node in nodes]
    if not any(pressure):
        return []
    middle_mm = sum(s * p for s, p in zip(along_mm, pressure)) / sum(pressure)
    return [(s - middle_mm, p) for s, p in zip(along_mm, pressure) if p > 0.0]


def figures(results, points, torque_nm, pair):
    """Line load, peak pressure, half-width, fitted peak and half-width of a pair; zeros without contact."""
    if not points:
        return [0.0] * 5
    moments = {key: contact.moment_n for key, contact in results.contacts.items()}
    share = moments[flank("pinion", pair)] / sum(moments.values())
    line_load = share * 1e3 * torque_nm / (BASE_RADIUS_MM * FACE_WIDTH_MM)
    half_width_mm = 0.5 * results.contacts[flank("pinion", pair)].length_mm
    fitted = pressure_course.hertz_ellipse(*zip(*points))
    return [line_load, max(p for _, p in points), half_width_mm, fitted.peak_mpa, fitted.half_width_mm]


def main():
    folder = pathlib.Path(sys.argv[1])
    made_by = f"CalculiX {calculix.version()}, made by validation/cross-check/run.sh (fzg_c_pair.py)"
    scene, rows, pressures = scene_file(folder), [], []
    for position_mm, guess_um in POSITIONS_MM.items():
        mesh = turned_pair.pair_mesh(scene, position_mm)
        error_um, torque_nm, results = PAIR.at_torque(
            folder, f"pair-at-{position_mm}", mesh, guess_um, PINION_ON_WHEEL, PENALTY_MPA_PER_MM)
        courses = [course(mesh, results, pair) for pair in PAIRS]
        of_pairs = [figures(results, points, torque_nm, pair) for pair, points in zip(PAIRS, courses)]
        rows.append([float(position_mm), torque_nm, error_um, *[value for column in zip(*of_pairs) for value in column]])
        pressures += [[float(position_mm), pair, *point] for pair, points in zip(PAIRS, courses) for point in points]
        if position_mm == SINGLE_CONTACT_MM:
            penalties = [penalty_row(PENALTY_MPA_PER_MM, results, torque_nm, mesh)]
            for penalty in OTHER_PENALTIES_MPA_PER_MM:
                other, other_nm = PAIR.solve(
                    folder, f"pair-penalty-{penalty:.0e}", mesh, error_um, PINION_ON_WHEEL, penalty)
                penalties.append(penalty_row(penalty, other, other_nm, mesh))
    quantities = ("line_load_{}_N_per_mm", "peak_pressure_{}_MPa", "half_width_{}_mm", "fitted_pressure_{}_MPa",
                  "fitted_half_width_{}_mm")
    columns = [name.format(pair) for name in quantities for pair in ("behind", "reference", "ahead")]
    table.write(HERE / "fzg-c-pair.csv", [
        made_by,
        "position_mm: radius of curvature of the pinion at the theoretical contact point of the reference pair",
        "behind, reference, ahead: tooth pairs -1, 0, 1; zeros without contact",
        "line_load: the pair's part of the torque over base radius and face width",
        "peak_pressure: greatest at a node; half_width: half the length of flank under pressure",
        "fitted: of the ellipse through the pressures at the nodes",
    ], ["position_mm", "torque_Nm", "transmission_error_um", *columns], rows)
    table.write(HERE / "fzg-c-pair-pressure.csv", [
        made_by, "pair: 0 the reference pair, 1 the one ahead, -1 the one behind",
        "along_mm: distance from the mean of the pressure along the pinion's flank, towards its tip",
    ], ["position_mm", "pair", "along_mm", "pressure_MPa"], pressures)
    table.write(HERE / "fzg-c-pair-penalty.csv", [
        made_by, f"at {SINGLE_CONTACT_MM} mm, the angle that gives {TORQUE_NM} N·m with the penalty of fzg-c-pair.csv",
    ], ["penalty_MPa_per_mm", "torque_Nm", "peak_pressure_MPa", "half_width_mm"], sorted(penalties))


def penalty_row(penalty_mpa_per_mm, results, torque_nm, mesh):
    """What depends on the penalty, of the reference pair in single contact."""
    _, peak_mpa, half_width_mm, _, _ = figures(results, course(mesh, results, 0), torque_nm, 0)
    return [penalty_mpa_per_mm, torque_nm, peak_mpa, half_width_mm]


if __name__ == "__main__":
    main()

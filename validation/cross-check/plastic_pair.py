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
import table
import turned_pair

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
PAIR = turned_pair.TurnedPair(
    YOUNG_MODULUS_MPA, POISSON_RATIO, BASE_RADIUS_MM, FACE_WIDTH_MM, TORQUE_NM, held=("clamp", "sides"))


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
    """Slave and master of each tooth pair: first the gear whose addendum touches."""
    return turned_pair.contacts(mesh, lambda pair: position_mm + pair * BASE_PITCH_MM < PITCH_POINT_MM, REACH_MM)


def main():
    folder = pathlib.Path(sys.argv[1])
    scene, rows = scene_file(folder), []
    for position_mm, guess_um in POSITIONS_MM.items():
        mesh = turned_pair.pair_mesh(scene, position_mm)
        sides = contacts(mesh, float(position_mm))
        error_um, torque_nm, results = PAIR.at_torque(
            folder, f"plastic-at-{position_mm}", mesh, guess_um, sides, PENALTY_MPA_PER_MM)
        rows.append([float(position_mm), torque_nm, error_um, *PAIR.line_loads(results, torque_nm, sides)])
    table.write(HERE / "plastic-pair.csv", [
        f"CalculiX {calculix.version()}, made by validation/cross-check/run.sh (plastic_pair.py)",
        "position_mm: radius of curvature of the pinion at the theoretical contact point of the reference pair",
        "behind, reference, ahead: tooth pairs -1, 0, 1; zeros without contact",
        "line_load: the pair's part of the torque over base radius and face width",
    ], ["position_mm", "torque_Nm", "transmission_error_um",
        *[f"line_load_{pair}_N_per_mm" for pair in ("behind", "reference", "ahead")]], rows)


if __name__ == "__main__":
    main()

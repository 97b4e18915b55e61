"""The fzg-c pair with tips rounded at 0.1 mm, solved by CalculiX where a tip edge touches before A and after E, new and worn.

Two pairs touch everywhere here: the one at its tip edge and the one that has the path to itself otherwise. The slave is
the flank whose tip edge may touch, so that the normals CalculiX takes, the master's, are those of the smoother surface.

The worn flanks are those of `gearwear run` after 127.75 h (worn_flanks.py).

    python3 tip_edges.py WORK_FOLDER
"""

import dataclasses
import math
import pathlib
import subprocess
import sys

import calculix
import fzg_c_pair
import table
import turned_pair
import worn_flanks

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
WORN = worn_flanks.WornFlanks(
    {"pinion": worn_flanks.Gear(0.0, 0.5 * 4.5 * 16 * math.cos(math.radians(20.0)), (36.0, 40.0)),
     "wheel": worn_flanks.Gear(91.5, 0.5 * 4.5 * 24 * math.cos(math.radians(20.0)), (55.0, 58.0))},
    fzg_c_pair.YOUNG_MODULUS_MPA, fzg_c_pair.POISSON_RATIO)
HOURS = 127.75
# Flanks further apart than this before deformation do not touch: they approach each other by the transmission error at most.
REACH_MM = 0.06
PAIR = dataclasses.replace(fzg_c_pair.PAIR, torque_tolerance=1e-3)


def contacts(mesh, position_mm):
    """Slave and master of each tooth pair: first the gear whose addendum touches."""
    return turned_pair.contacts(mesh, lambda pair: position_mm + pair * BASE_PITCH_MM < PITCH_POINT_MM, REACH_MM)


def row(folder, scene, run, hours, position_mm):
    """A line of the table: new at 0 hours, with the wear of the run at its end."""
    mesh = turned_pair.pair_mesh(scene, position_mm)
    name = f"tips-{hours:g}-h-at-{position_mm}"
    if hours > 0.0:
        WORN.wear_down(folder, f"{name}-shape", mesh, run)
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

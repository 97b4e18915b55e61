"""A life to 0.3 modules of wear on teeth that are made anew as they wear, against the run whose path and sections stay those of thin wear.

    pip install numpy
    python validation/cross-check/remeshed_life.py --program target/release/gearwear --out validation/cross-check/remeshed-life.csv

An involute worn by D along its normals is the same involute, turned by D/r_b: a point of it at the radius of curvature rho is at rho - D then. The
life is divided into parts of ``--step`` um of wear. After each part both flanks are described anew as turned involutes of thinner teeth
(``tooth_thickness_allowance_um``), beside which they deviate by what is left of the wear (``initial_flank``),

    e(rho) = h(rho + D) - D        beyond the tip: as at the tip, within the tip circle

so that path, curvature, stiffness and tip edges are those of the worn teeth. D is the median of the wear of the active flank. The depth of a material
point of the new flank is h(rho) = D + e(rho - D).

The pair is the sun and a planet of Zhao, Tian, Liang and Xie, IEEE Trans. Reliability 67 (2018) 316-327, with their prior coefficient: 2825 N m on a sun
with four planets, 3.24 meshes of a tooth in a revolution, counted as four in as many revolutions fewer.
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

import numpy as np

MODULE, ANGLE, TEETH = 3.2, math.radians(20.0), {"pinion": 19, "wheel": 31}
#: Face width, mm, and density, g/mm3.
WIDTH, DENSITY = 38.1, 7.83e-3
CENTRE_DISTANCE = 0.5 * MODULE * sum(TEETH.values())
#: Revolutions of the sun at which the mass was measured, as revolutions with four meshes.
MEASURED = [3.24 / 4 * cycles for cycles in (268800, 358400, 448000, 582400, 716800, 868000, 1100000, 1136800, 1271200)]
BASE = {gear: 0.5 * MODULE * z * math.cos(ANGLE) for gear, z in TEETH.items()}
#: Radius of curvature at the tip, and at the start of the active profile.
TIP = {gear: math.sqrt((0.5 * MODULE * (z + 2)) ** 2 - BASE[gear] ** 2) for gear, z in TEETH.items()}
LINE = math.sqrt(CENTRE_DISTANCE**2 - sum(BASE.values()) ** 2)
START = {"pinion": LINE - TIP["wheel"], "wheel": LINE - TIP["pinion"]}
#: Radii of curvature, mm, from which a profile is given: above the root form circle of teeth as thin as they become.
FIRST = {"pinion": 1.6, "wheel": 7.6}
#: The rounding of the tip edges, and the roll length it may take, mm; ends of the flank that are not compared.
ROUNDING, ROUNDED, ENDS = 0.1, 0.12, (0.65, 0.3)

SCENE = f"""
[pair]
normal_module_mm = {MODULE}
pressure_angle_deg = 20.0
centre_distance_mm = {CENTRE_DISTANCE}
face_width_mm = {WIDTH}
[pair.pinion]
teeth = 19
profile_shift = 0.0
tip_rounding_mm = {ROUNDING}
tooth_thickness_allowance_um = {{pinion}}
[pair.wheel]
teeth = 31
profile_shift = 0.0
tip_rounding_mm = {ROUNDING}
tooth_thickness_allowance_um = {{wheel}}
{{flanks}}
[material]
young_modulus_GPa = 210.0
density_kg_per_m3 = {1e6 * DENSITY}
[operation]
pinion_torque_Nm = 706.25
pinion_speed_rpm = 1200.0
pinion_revolutions = {{revolutions}}
meshes_per_revolution = {{{{ pinion = 4 }}}}
{{operation}}
[contact]
surface = "half-space"
[stiffness]
model = "weber-banaschek"
[wear]
law = "archard"
coefficient_m2_per_N = 1.27e-15
[numerics]
flank_points = 300
positions = 120
verify = false
error_estimate = false
"""


def run(program, folder, name, **values):
    """Folder of a run of the scene with these values."""
    (folder / f"{name}.toml").write_text(SCENE.format(**values))
    out = folder / name
    subprocess.run([program, "run", folder / f"{name}.toml", "--out", out, "--quiet", "--no-report"], check=True, stderr=subprocess.DEVNULL)
    return out


def rows(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def profile(gear, points):
    """Radii of curvature and wear depths of the rows of a gear, mm."""
    radius = np.array([float(point["radius_mm"]) for point in points])
    wear = 1e-3 * np.array([float(point["wear_um"]) for point in points])
    return np.sqrt(np.maximum(radius**2 - BASE[gear] ** 2, 0.0)), wear


def mass_g(rho, depth):
    """Mass lost by all teeth of the sun, g, its flanks as long as new ones."""
    return DENSITY * WIDTH * TEETH["pinion"] * float(np.trapezoid(depth * rho / BASE["pinion"], rho))


class WornFlank:
    """A flank as a turned involute and its deviation from it."""

    def __init__(self, gear):
        self.gear, self.turned = gear, 0.0
        self.rho = np.linspace(0.0, TIP[gear], 1500)
        self.deviation = np.zeros_like(self.rho)

    def table(self, folder):
        """The lines of the scene for the deviation, which is written as a measured profile."""
        inside = (self.rho > FIRST[self.gear]) & (self.rho < TIP[self.gear] - ROUNDED)
        lines = [f"{rho:.6f},{-1e3 * e:.6f}" for rho, e in zip(self.rho[inside], self.deviation[inside])]
        (folder / f"{self.gear}.csv").write_text("\n".join(["roll_length_mm,height_um", *lines, ""]))
        return f'[pair.{self.gear}.initial_flank]\nfile = "{self.gear}.csv"\ncutoff_mm = 0.1\n'

    def wear(self, rho, depth):
        """Wears the flank, and turns its involute after it."""
        self.deviation += np.interp(self.rho, rho, depth)
        active = (self.rho > START[self.gear]) & (self.rho < TIP[self.gear] - 2 * ROUNDED)
        turn = max(0.0, float(np.median(self.deviation[active])))
        turned = np.interp(self.rho + turn, self.rho, self.deviation) - turn
        beyond = self.rho + turn > TIP[self.gear]
        turned[beyond] = np.maximum(turned[beyond], self.rho[beyond] - TIP[self.gear])
        self.deviation, self.turned = turned, self.turned + turn

    def depth(self, rho):
        """Depth of wear at points of the new flank."""
        return self.turned + np.interp(rho - self.turned, self.rho, self.deviation)


def remeshed_life(program, folder, step_um):
    """Revolutions, depths of the sun at its radii of curvature, and mass lost by it in g, after each part of the life."""
    flanks = {gear: WornFlank(gear) for gear in TEETH}
    states, revolutions, mass = [], 0.0, 0.0
    while revolutions < MEASURED[-1] * (1 - 1e-9):
        tables = "".join(flank.table(folder) for flank in flanks.values()) if states else ""
        allowance = {gear: -1e3 * flank.turned / math.cos(ANGLE) for gear, flank in flanks.items()}
        operation = f"stop = {{ wear_um = {step_um} }}"
        left = MEASURED[-1] - revolutions
        out = run(program, folder, f"part-{len(states)}", flanks=tables, revolutions=left, operation=operation, **allowance)
        summary = json.loads((out / "summary.json").read_text())
        revolutions += summary["revolutions"]
        mass += 1e-3 * summary["pinion"]["worn_mass_mg"]
        for gear, flank in flanks.items():
            flank.wear(*profile(gear, rows(out / f"{gear}.csv")))
        states.append((revolutions, flanks["pinion"].depth(flanks["pinion"].rho), mass))
        print(f"{revolutions:.0f} revolutions, {flanks['pinion'].turned:.3f} mm, {mass:.2f} g", flush=True)
    return flanks["pinion"].rho, states


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="gearwear", help="gearwear")
    parser.add_argument("--step", type=float, default=100.0, help="wear of a part of the life, um")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="CSV file to write")
    asked = parser.parse_args()
    program = str(pathlib.Path(asked.program).resolve()) if "/" in asked.program else asked.program
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        at = f"snapshots_revolutions = {MEASURED}"
        thin = run(program, folder, "thin", flanks="", revolutions=MEASURED[-1], operation=at, pinion=0.0, wheel=0.0)
        rho, states = remeshed_life(program, folder, asked.step)
        points = [row for row in rows(thin / "profiles.csv") if row["gear"] == "pinion"]
    with asked.out.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["revolutions", "wear_over_module", "maximum_percent", "root_mean_square_percent", "greatest_percent", "thin_mass_g", "remeshed_mass_g"])
        for revolutions in MEASURED:
            after = next(i for i, state in enumerate(states) if state[0] >= revolutions * (1 - 1e-9))
            (r0, h0, m0), (r1, h1, m1) = states[after - 1], states[after]
            part = (revolutions - r0) / (r1 - r0)
            places, thin_depth = profile("pinion", [row for row in points if abs(float(row["revolutions"]) / revolutions - 1) < 1e-9])
            depth = np.interp(places, rho, h0 + part * (h1 - h0))
            active = (places > START["pinion"] + ENDS[0]) & (places < TIP["pinion"] - ENDS[1])
            greatest = depth[active].max()
            apart = (thin_depth[active] - depth[active]) / greatest
            figures = [greatest / MODULE, *(100 * x for x in (thin_depth[active].max() / greatest - 1, np.sqrt(np.mean(apart**2)), np.abs(apart).max()))]
            table.writerow([f"{revolutions:.0f}", *(f"{figure:.3f}" for figure in figures), f"{mass_g(places, thin_depth):.2f}", f"{m0 + part * (m1 - m0):.2f}"])


if __name__ == "__main__":
    main()

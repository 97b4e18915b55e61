"""Ordinary internal spur pairs drawn at random, as the list of values that case.toml holds: python3 pairs.py [SEED [COUNT]].

Module 2 to 6 mm, 17 to 30 teeth in rings of 20 to 90 more, profile shifts, tip rounding 0.02 to 0.05 modules, tip relief on three in ten; half of the rings
are cut by a shaper, the others have an arc for a fillet; rims of 2.5 to 5 modules. Tips of rings are those of the program's default, shortened where they
would interfere; pairs that `gearwear plan` refuses are drawn again. The face width is such that 100 N·m on the pinion make a Hertz pressure of about
800 MPa at the pitch point, so that one range of torques is one range of pressures for all of them. Needs gearwear on the PATH, or GEARWEAR.
"""

import math
import os
import random
import subprocess
import sys

CONTACT_MODULUS_MPA = 206e3 / (1.0 - 0.3**2) / 2.0
SCENE = """
[operation]
pinion_torque_Nm = 100.0
pinion_revolutions = 1e6
[wear]
law = "archard"
coefficient_m2_per_N = 1e-17
"""


def accepted(pair):
    command = [os.environ.get("GEARWEAR", "gearwear"), "plan", "-"]
    ran = subprocess.run(command, input=f"pair = {pair}\n{SCENE}", text=True, capture_output=True, check=False)
    return ran.returncode == 0


def draw(r):
    while True:
        module = r.choice([2.0, 2.5, 3.0, 4.0, 4.5, 5.0, 6.0])
        z1 = r.randint(17, 30)
        z2 = z1 + r.randint(20, 90)
        x1, x2 = round(r.uniform(0.0, 0.5), 3), round(r.uniform(-0.5, 0.2), 3)
        alpha = math.radians(20.0)
        rho = [0.5 * module * z * math.sin(alpha) for z in (z1, z2)]
        load = 800.0**2 * math.pi * rho[0] * rho[1] / (rho[1] - rho[0]) / CONTACT_MODULUS_MPA
        width = round(100e3 / (0.5 * module * z1 * math.cos(alpha)) / load, 3)
        roundings = [round(r.uniform(0.02, 0.05) * module, 4) for _ in range(2)]
        relief = ""
        if r.random() < 0.3:
            amount, length = round(r.uniform(2.0, 5.0) * module, 1), round(r.uniform(0.3, 0.8) * module, 2)
            relief = f", tip_relief = {{ amount_um = {amount}, length_mm = {length} }}"
        cutter = f", cutter = {{ teeth = {r.randint(15, min(z2 - 16, 40))} }}" if r.random() < 0.5 else ""
        ring = f", internal = true, rim_thickness_mm = {round(r.uniform(2.5, 5.0) * module, 2)}{cutter}"
        gears = ", ".join(
            f"{name} = {{ teeth = {z}, profile_shift = {x}, tip_rounding_mm = {rounding}{relief}{own} }}"
            for name, z, x, rounding, own in (("pinion", z1, x1, roundings[0], ""), ("wheel", z2, x2, roundings[1], ring))
        )
        pair = (
            f"{{ normal_module_mm = {module}, pressure_angle_deg = 20.0, backlash_um = {round(20.0 * module)}, "
            f"face_width_mm = {width}, {gears} }}"
        )
        if accepted(pair):
            return pair


if __name__ == "__main__":
    seed, count = (list(map(int, sys.argv[1:])) + [1, 50])[:2] if len(sys.argv) < 3 else map(int, sys.argv[1:3])
    r = random.Random(seed)
    for _ in range(count):
        print(f"    {draw(r)},")

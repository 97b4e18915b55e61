"""Ordinary spur pairs drawn at random, as the list of values that case.toml holds: python3 pairs.py [SEED [COUNT]].

Module 2 to 6 mm, 16 to 30 over 16 to 70 teeth, profile shifts, tip rounding 0.02 to 0.05 modules, tip relief on three in ten; no undercut,
contact ratio 1.2 to 1.9, tips at least 0.3 modules thick. The face width is such that 100 N·m on the pinion make a Hertz pressure of
1000 MPa at the pitch point, so that one range of torques is one range of pressures for all of them.
"""

import math
import random
import sys

CONTACT_MODULUS_MPA = 206e3 / (1.0 - 0.3**2) / 2.0


def involute(angle):
    return math.tan(angle) - angle


def inverse_involute(value):
    low, high = 0.0, 1.2
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if involute(middle) < value else (low, middle)
    return low


def draw(r):
    while True:
        module = r.choice([2.0, 2.5, 3.0, 4.0, 4.5, 5.0, 6.0])
        z1 = r.randint(16, 30)
        z2 = r.randint(max(16, z1), 70)
        x1, x2 = round(r.uniform(0.0, 0.6), 3), round(r.uniform(-0.3, 0.5), 3)
        if 17.0 * (1.0 - x1) > z1 or 17.0 * (1.0 - x2) > z2:
            continue
        alpha = math.radians(20.0)
        working = inverse_involute(involute(alpha) + 2.0 * math.tan(alpha) * (x1 + x2) / (z1 + z2))
        distance = round(0.5 * module * (z1 + z2) * math.cos(alpha) / math.cos(working), 4)
        shortening = 0.5 * (z1 + z2) + x1 + x2 - distance / module
        tips = [0.5 * module * (z + 2.0 + 2.0 * x - 2.0 * shortening) for z, x in ((z1, x1), (z2, x2))]
        bases = [0.5 * module * z * math.cos(alpha) for z in (z1, z2)]
        ends = [math.sqrt(tip**2 - base**2) for tip, base in zip(tips, bases)]
        line = distance * math.sin(working)
        ratio = (sum(ends) - line) / (math.pi * module * math.cos(alpha))
        thickness = min(
            2.0 * tip * ((math.pi / 2.0 + 2.0 * x * math.tan(alpha)) / z + involute(alpha) - involute(math.acos(base / tip)))
            for tip, base, z, x in ((tips[0], bases[0], z1, x1), (tips[1], bases[1], z2, x2))
        )
        if not 1.2 < ratio < 1.9 or min(line - ends[0], line - ends[1]) < 0.06 * line or thickness < 0.3 * module:
            continue
        radii = [base * math.tan(working) for base in bases]
        relative = radii[0] * radii[1] / sum(radii)
        load = 1000.0**2 * math.pi * relative / CONTACT_MODULUS_MPA
        width = round(100e3 / bases[0] / load, 3)
        roundings = [round(r.uniform(0.02, 0.05) * module, 4) for _ in range(2)]
        relief = ""
        if r.random() < 0.3:
            amount, length = round(r.uniform(2.0, 5.0) * module, 1), round(r.uniform(0.3, 0.8) * module, 2)
            relief = f", tip_relief = {{ amount_um = {amount}, length_mm = {length} }}"
        gears = ", ".join(
            f"{name} = {{ teeth = {z}, profile_shift = {x}, tip_rounding_mm = {rounding}{relief} }}"
            for name, z, x, rounding in (("pinion", z1, x1, roundings[0]), ("wheel", z2, x2, roundings[1]))
        )
        return (
            f"{{ normal_module_mm = {module}, pressure_angle_deg = 20.0, centre_distance_mm = {distance}, "
            f"face_width_mm = {width}, {gears} }}"
        )


if __name__ == "__main__":
    seed, count = (list(map(int, sys.argv[1:])) + [1, 50])[:2] if len(sys.argv) < 3 else map(int, sys.argv[1:3])
    r = random.Random(seed)
    for _ in range(count):
        print(f"    {draw(r)},")

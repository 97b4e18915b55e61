"""Ordinary pairs with slices drawn at random, as the members that case.toml holds: python3 pairs.py [SEED [COUNT]].

Module 2 to 6 mm, 16 to 30 over 16 to 70 teeth, helix angle 1 to 30°, every fifth a spur pair whose slices come of its flanks; face width 3 to 15
modules; profile shifts, tip rounding 0.02 to 0.05 modules, tip relief on three in ten; no undercut, transverse contact ratio 1.2 to 1.9, tips at
least 0.3 modules thick. All of it in the transverse section. Hertz pressure at the pitch point, with the whole torque on one line of contact as
long as the face is wide, 700 to 1800 MPa. Helix slope, lead crowning and end relief are shares of what teeth of 14 N/(mm·µm) give way
under that load: slopes 0.1 to 0.8 on four in ten and on spur pairs without crowning, of the pinion or of axes across their plane; crowning 0.1
to 0.5 on a quarter and on half of the spur pairs; end relief 0.2 to 1 on three in twenty. The duration is such that all of
the load would wear the deeper one of both flanks, where contact begins or ends, by 3 to 40 µm; shared among pairs of teeth it wears less.
"""

import math
import random
import sys

CONTACT_MODULUS_MPA = 206e3 / (1.0 - 0.3**2) / 2.0
STIFFNESS_N_PER_MM_UM = 14.0
COEFFICIENT_MM2_PER_N = 1e-11
NORMAL = math.radians(20.0)


def involute(angle):
    return math.tan(angle) - angle


def inverse_involute(value):
    low, high = 0.0, 1.2
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if involute(middle) < value else (low, middle)
    return low


def section(r, helix_deg):
    """A transverse section, drawn until it is one of ordinary teeth."""
    cosine = math.cos(math.radians(helix_deg))
    alpha = math.atan(math.tan(NORMAL) / cosine)
    while True:
        module = r.choice([2.0, 2.5, 3.0, 4.0, 4.5, 5.0, 6.0])
        z1 = r.randint(16, 30)
        z2 = r.randint(max(16, z1), 70)
        x1, x2 = round(r.uniform(0.0, 0.6), 3), round(r.uniform(-0.3, 0.5), 3)
        transverse = module / cosine
        if any(1.0 - x > 0.5 * z / cosine * math.sin(alpha) ** 2 for z, x in ((z1, x1), (z2, x2))):
            continue
        working = inverse_involute(involute(alpha) + 2.0 * math.tan(NORMAL) * (x1 + x2) / (z1 + z2))
        distance = round(0.5 * transverse * (z1 + z2) * math.cos(alpha) / math.cos(working), 4)
        shortening_mm = 0.5 * transverse * (z1 + z2) + module * (x1 + x2) - distance
        tips = [0.5 * transverse * z + module * (1.0 + x) - shortening_mm for z, x in ((z1, x1), (z2, x2))]
        bases = [0.5 * transverse * z * math.cos(alpha) for z in (z1, z2)]
        ends = [math.sqrt(tip**2 - base**2) for tip, base in zip(tips, bases)]
        line = distance * math.sin(working)
        ratio = (sum(ends) - line) / (math.pi * transverse * math.cos(alpha))
        thickness = min(
            2.0 * tip * ((math.pi / 2.0 + 2.0 * x * math.tan(NORMAL)) / z + involute(alpha) - involute(math.acos(base / tip)))
            for tip, base, z, x in ((tips[0], bases[0], z1, x1), (tips[1], bases[1], z2, x2))
        )
        if not 1.2 < ratio < 1.9 or min(line - ends[0], line - ends[1]) < 0.06 * line or thickness < 0.3 * module:
            continue
        return module, (z1, z2), (x1, x2), distance, bases, ends, line, working


def draw(r, number):
    helix_deg = 0.0 if number % 5 == 4 else round(r.uniform(1.0, 30.0), 1)
    module, teeth, shifts, distance, bases, ends, line, working = section(r, helix_deg)
    width = round(r.uniform(3.0, 15.0) * module, 1)
    pitch = [base * math.tan(working) for base in bases]
    load = r.uniform(700.0, 1800.0) ** 2 * math.pi * pitch[0] * pitch[1] / sum(pitch) / CONTACT_MODULUS_MPA
    torque = round(load * bases[0] * width / 1e3, 1)
    give_um = load / STIFFNESS_N_PER_MM_UM
    extras = [[f"tip_rounding_mm = {round(r.uniform(0.02, 0.05) * module, 4)}"] for _ in range(2)]
    if r.random() < 0.3:
        amount, length = round(r.uniform(2.0, 5.0) * module, 1), round(r.uniform(0.3, 0.8) * module, 2)
        for extra in extras:
            extra.append(f"tip_relief = {{ amount_um = {amount}, length_mm = {length} }}")
    kind = ["spur" if helix_deg == 0.0 else f"{helix_deg}°"]
    crowned = r.random() < (0.25 if helix_deg else 0.5)
    if crowned:
        extras[0].append(f"lead_crowning_um = {round(r.uniform(0.1, 0.5) * give_um, 1)}")
        kind.append("crowned")
    axes = ""
    if r.random() < 0.4 or not (helix_deg or crowned):
        slope_um = round(r.choice([-1.0, 1.0]) * r.uniform(0.1, 0.8) * give_um, 1)
        if r.random() < 0.3:
            axes = f"axis_parallelism = {{ out_of_plane_um = {slope_um} }}, "
        else:
            extras[0].append(f"helix_slope_deviation_um = {slope_um}")
        kind.append("misaligned")
    if r.random() < 0.15:
        length = round(r.uniform(0.05, 0.2) * width, 2)
        extras[0].append(f"end_relief = {{ amount_um = {round(r.uniform(0.2, 1.0) * give_um, 1)}, length_mm = {length} }}")
        kind.append("end relief")
    # Distance slid over distance rolled, at A on the pinion and at E on the wheel.
    slid = max(abs(mate * z / other - (line - mate)) / (line - mate) for mate, z, other in (
        (ends[1], teeth[0], teeth[1]), (ends[0], teeth[1], teeth[0])))
    depth_mm = math.exp(r.uniform(math.log(3e-3), math.log(4e-2)))
    revolutions = float(f"{depth_mm / (COEFFICIENT_MM2_PER_N * load * slid):.3g}")
    gears = ", ".join(
        f"{name} = {{ teeth = {z}, profile_shift = {x}, {', '.join(extra)} }}"
        for name, z, x, extra in zip(("pinion", "wheel"), teeth, shifts, extras)
    )
    return (
        f'    {{ label = "{number + 1}: {", ".join(kind)}", value = {helix_deg}, set = {{ "operation.pinion_torque_Nm" = {torque}, '
        f'"operation.pinion_revolutions" = {revolutions}, "pair" = {{ normal_module_mm = {module}, pressure_angle_deg = 20.0, '
        f"helix_angle_deg = {helix_deg}, centre_distance_mm = {distance}, face_width_mm = {width}, {axes}{gears} }} }} }},"
    )


if __name__ == "__main__":
    seed, count = map(int, (sys.argv[1:] + ["1", "24"][len(sys.argv) - 1 :])[:2])
    r = random.Random(seed)
    for number in range(count):
        print(draw(r, number))

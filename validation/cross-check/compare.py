"""Gearwear's own results beside the committed ones of CalculiX, as Markdown.

    python3 compare.py WORK_FOLDER
"""

import json
import pathlib
import subprocess
import sys

import fzg_c_pair
import pressure_course
import table
import tip_edges
import turned_pair
import worn_flanks

HERE = pathlib.Path(__file__).parent
# The course of the pressure is compared up to this part of gearwear's fitted half-width; see pressure_course.py.
COMPARED_HALF_WIDTHS = 0.8


def solve(out, *arguments):
    """The folder in which `gearwear fem` left its results."""
    subprocess.run([turned_pair.gearwear(), "fem", *arguments, "--out", out, "--quiet"], check=True)
    return out


def columns(rows, *names):
    return [[float(row[name]) for row in rows] for name in names]


def interpolated(along_mm, pressure_mpa, at_mm):
    points = sorted(zip(along_mm, pressure_mpa))
    for (s0, p0), (s1, p1) in zip(points, points[1:]):
        if s0 <= at_mm <= s1:
            return p0 + (p1 - p0) * (at_mm - s0) / (s1 - s0)
    return 0.0


def course_difference(ours, theirs):
    """Root mean square difference of two courses at our nodes, over our peak, with the middles of their ellipses together."""
    own, other = pressure_course.hertz_ellipse(*ours), pressure_course.hertz_ellipse(*theirs)
    from_centre = [(s - own.centre_mm, p) for s, p in zip(*ours)]
    squares = [(p - interpolated(*theirs, other.centre_mm + s)) ** 2
               for s, p in from_centre if abs(s) < COMPARED_HALF_WIDTHS * own.half_width_mm]
    return (sum(squares) / len(squares)) ** 0.5 / own.peak_mpa


def print_table(title, lines):
    print(f"\n{title}\n\n| quantity | CalculiX | gearwear | CalculiX − gearwear |\n|---|---|---|---|")
    for name, digits, theirs, ours in lines:
        print(f"| {name} | {theirs:.{digits}f} | {ours:.{digits}f} | {100.0 * (theirs / ours - 1.0):+.2f} % |")


def cylinder(folder):
    out = solve(folder / "cylinder", HERE / "../../meshes/cylinder-on-block.toml")
    contact = json.loads((out / "summary.json").read_text(encoding="utf-8"))["contact"][0]
    theirs = {name: float(word) for name, word in table.read(HERE / "nafems-cylinder.csv")[0].items()}
    rows = [row for row in table.read(out / "contact.csv") if float(row["pressure_MPa"]) > 0.0]
    our_course = pressure_course.mirrored(*columns(rows, "x_mm", "pressure_MPa"))
    their_course = pressure_course.mirrored(
        *columns(table.read(HERE / "nafems-cylinder-pressure.csv"), "x_mm", "pressure_MPa"))
    fitted = pressure_course.hertz_ellipse(*our_course)
    # CalculiX measures the surface after deformation, gearwear before.
    end_mm, shift_mm = columns(rows, "along_mm", "displacement_x_mm")
    own_half_width_mm = contact["half_width_mm"] + interpolated(end_mm, shift_mm, min(contact["half_width_mm"], max(end_mm)))
    print_table("NAFEMS cylinder on a block (Hertz: 3585.4 MPa, 6.215 mm)", [
        ("peak pressure, MPa", 1, theirs["peak_pressure_MPa"], contact["peak_pressure_MPa"]),
        ("half-width after deformation, mm", 3, theirs["half_width_mm"], own_half_width_mm),
        ("peak of the fitted ellipse, MPa", 1, theirs["fitted_pressure_MPa"], fitted.peak_mpa),
        ("half-width of the fitted ellipse, mm", 3, theirs["fitted_half_width_mm"], fitted.half_width_mm),
        ("contact force, N/mm", 1, theirs["contact_force_N_per_mm"], 2.0 * contact["force_N_per_mm"][1]),
    ])
    difference = course_difference(our_course, their_course)
    print(f"\npressure along the contact: {100.0 * difference:.2f} % of the peak (root mean square)")


def gear_pair(folder):
    scene = fzg_c_pair.scene_file(folder)
    their_courses = table.read(HERE / "fzg-c-pair-pressure.csv")
    for theirs, position_mm in zip(table.read(HERE / "fzg-c-pair.csv"), fzg_c_pair.POSITIONS_MM, strict=True):
        out = solve(folder / f"at-{position_mm}", scene, "--position", position_mm)
        ours = {int(row["pair"]): row for row in table.read(out / "mesh_cycle.csv")}
        our_courses = table.read(out / "pressure.csv")
        lines = [("transmission error, µm", 3, float(theirs["transmission_error_um"]),
                  float(ours[0]["transmission_error_um"]))]
        differences = []
        for pair, name in zip(turned_pair.PAIRS, ("behind", "reference", "ahead")):
            if pair not in ours:
                continue
            our_course = columns([row for row in our_courses if int(row["pair"]) == pair and float(row["pressure_MPa"]) > 0.0],
                                 "along_mm", "pressure_MPa")
            their_course = columns([row for row in their_courses if float(row["position_mm"]) == float(position_mm)
                                    and int(row["pair"]) == pair], "along_mm", "pressure_MPa")
            fitted = pressure_course.hertz_ellipse(*our_course)
            figures = (("line load, N/mm", 2, "line_load_{}_N_per_mm", float(ours[pair]["line_load_N_per_mm"])),
                       ("peak pressure, MPa", 1, "peak_pressure_{}_MPa", float(ours[pair]["peak_pressure_MPa"])),
                       ("half-width, mm", 4, "half_width_{}_mm", float(ours[pair]["half_width_mm"])),
                       ("fitted peak, MPa", 1, "fitted_pressure_{}_MPa", fitted.peak_mpa),
                       ("fitted half-width, mm", 4, "fitted_half_width_{}_mm", fitted.half_width_mm))
            lines += [(f"{what}, pair {pair}", digits, float(theirs[column.format(name)]), value)
                      for what, digits, column, value in figures]
            difference = course_difference(our_course, their_course)
            differences.append(f"{100.0 * difference:.2f} % (pair {pair})")
        print_table(f"fzg-c at {position_mm} mm", lines)
        print(f"\npressure along the contact: {', '.join(differences)} of the peak (root mean square)")


def rounded_tips(folder):
    """Transmission error and line loads where tip edges touch; the run lies in the folder, new and worn in its mesh_cycle.csv."""
    cycle = table.read(folder / "worn" / "mesh_cycle.csv")
    places = [float(row["position_mm"]) for row in cycle]
    whole = 1e3 * fzg_c_pair.TORQUE_NM / (fzg_c_pair.BASE_RADIUS_MM * fzg_c_pair.FACE_WIDTH_MM)
    for row in table.read(HERE / "fzg-c-tip-edges.csv"):
        theirs = {name: float(word) for name, word in row.items()}
        state = "worn" if theirs["hours"] > 0.0 else "new"

        at_mm, to_whole = theirs["position_mm"], fzg_c_pair.TORQUE_NM / theirs["torque_Nm"]
        error_um, share = (worn_flanks.interpolated(places, [float(line[column]) for line in cycle], at_mm)
                           for column in (f"transmission_error_{state}_um", f"load_share_{state}"))
        lines = [("transmission error, µm", 3, theirs["transmission_error_um"] * to_whole, error_um)]
        for name, own in (("behind", 1.0 - share), ("reference", share), ("ahead", 1.0 - share)):
            load = theirs[f"line_load_{name}_N_per_mm"] * to_whole
            if load > 0.0:
                lines.append((f"line load {name}, N/mm", 2, load, own * whole))
        print_table(f"rounded tips at {at_mm:g} mm, {state}", lines)


def main():
    folder = pathlib.Path(sys.argv[1])
    cylinder(folder)
    gear_pair(folder)
    rounded_tips(folder)


if __name__ == "__main__":
    main()

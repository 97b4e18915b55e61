"""The compliance of pinion teeth in space, solved by CalculiX on the hexahedra that `gearwear mesh --three-dimensional` writes.

One pitch of the pinion is set side by side with itself, turned tooth by tooth: to the whole ring, or to a row of teeth whose outer
cuts are held. The row is solved on finer elements too, each hexahedron split in its own coordinates. The clamp circle is held.

A load is 1 N of transverse force in all, even along a line of contact or along a part of it at an end face, spread over the nodes of the
working flank by their shape functions; at each node it acts along the normal of the involute helicoid there. What comes back is the
displacement under such loads, averaged in the same way, on the loaded tooth and on those beside it.

    python3 teeth_in_space.py WORK_FOLDER
"""

import itertools
import math
import os
import pathlib
import re
import subprocess
import sys
from dataclasses import dataclass

import calculix
import fzg_c_pair
import table
import turned_pair

HERE = pathlib.Path(__file__).parent
TEETH, BASE_RADIUS_MM = 16, fzg_c_pair.BASE_RADIUS_MM
COS_PRESSURE_ANGLE = math.cos(math.radians(20.0))
# Places of contact in the middle of the face width, radii of curvature of the pinion's flank in mm: after A, at C, before E.
POSITIONS_MM = (7.5, 13.9701, 20.5)
# Part of the face width that the short loads take.
END_PART = 0.2
# Gauss's places and weights on (-1, 1).
GAUSS_3 = ((-math.sqrt(0.6), 5.0 / 9.0), (0.0, 8.0 / 9.0), (math.sqrt(0.6), 5.0 / 9.0))
# Points of integration of CalculiX's hexahedra of twenty nodes.
INTEGRATION_POINTS = {"C3D20": 27, "C3D20R": 8}
# Corners of a hexahedron, then the middles of its lower edges, of its upper ones and of those between, by Abaqus and CalculiX.
CORNERS = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))
EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
NODES = CORNERS + tuple(tuple((CORNERS[a][i] + CORNERS[b][i]) // 2 for i in range(3)) for a, b in EDGES)


@dataclass
class Case:
    preset: str
    file: str
    helix_angle_deg: float
    face_width_mm: float
    bodies: tuple  # (teeth, elements that one becomes along each side of the section, over the width, kind)


CASES = (
    Case("thesis-helical", "helical-pinion-in-space.csv", 15.0, 20.0, (
        (TEETH, 1, 1, "C3D20"), (TEETH, 1, 1, "C3D20R"),
        (4, 1, 1, "C3D20"), (4, 1, 1, "C3D20R"), (4, 2, 1, "C3D20"), (4, 1, 2, "C3D20"))),
    Case("fzg-c", "fzg-c-pinion-in-space.csv", 0.0, 14.0, ((TEETH, 1, 1, "C3D20"), (TEETH, 1, 1, "C3D20R"))),
)


@dataclass
class Line:
    """An even load along a line of contact."""

    position_mm: float  # in the middle of the face width
    from_mm: float
    to_mm: float


@dataclass
class Solid:
    points: dict  # number: (x_mm, y_mm, z_mm)
    hexahedra: list  # of twenty node numbers
    sets: dict  # name: node numbers


def lines_of(case):
    """The loads, and which of them act in turn; displacements are taken along all of them."""
    width_mm = case.face_width_mm
    whole = [Line(position_mm, 0.0, width_mm) for position_mm in POSITIONS_MM]
    ends = [Line(POSITIONS_MM[-1], 0.0, END_PART * width_mm), Line(POSITIONS_MM[-1], (1.0 - END_PART) * width_mm, width_mm)]
    return whole + ends, (0, 2, 3)


def read_solid(path, body):
    """One body of the Abaqus file that `gearwear mesh --three-dimensional` writes, with its sets, named without the body."""
    text = pathlib.Path(path).read_text(encoding="ascii").replace(",\n", ",")
    solid, cells, own = Solid({}, [], {}), {}, []
    for block in re.split(r"^\*", text, flags=re.MULTILINE)[1:]:
        head, *lines = block.splitlines()
        keyword, *options = [word.strip() for word in head.split(",")]
        name = options[-1].split("=", 1)[1].strip('"') if options else ""
        rows = [[word for word in line.split(",") if word.strip()] for line in lines]
        if keyword == "NODE":
            solid.points = {int(row[0]): tuple(map(float, row[1:])) for row in rows}
        elif keyword == "ELEMENT":
            cells.update({int(row[0]): list(map(int, row[1:])) for row in rows})
        elif keyword == "NSET" and name.startswith(body + "_"):
            solid.sets[name[len(body) + 1:]] = {int(word) for row in rows for word in row}
        elif keyword == "ELSET" and name == body:
            own = [int(word) for row in rows for word in row]
    solid.hexahedra = [cells[cell] for cell in own]
    used = {node for nodes in solid.hexahedra for node in nodes}
    solid.points = {node: solid.points[node] for node in used}
    return solid


def shape(at):
    """The shape functions of the hexahedron of twenty nodes."""
    values = []
    for node in NODES:
        factors = [1.0 + x * n if n else 1.0 - x * x for x, n in zip(at, node)]
        product = math.prod(factors)
        if 0 in node:
            values.append(0.25 * product)
        else:
            values.append(0.125 * product * (sum(x * n for x, n in zip(at, node)) - 2.0))
    return values


def split(solid, in_section, over_width):
    """Each hexahedron as `in_section`² · `over_width` smaller ones in its own coordinates; the third of these is along the axis."""
    counts = (in_section, in_section, over_width)
    fine = Solid({}, [], {name: set() for name in solid.sets})
    numbers = {}

    def number(nodes, place):
        weights = shape([half / count - 1.0 for half, count in zip(place, counts)])
        parents = [(node, weight) for node, weight in zip(nodes, weights) if abs(weight) > 1e-9]
        # The same parents with the same weights are the same node, whichever element it is seen from.
        key = tuple(sorted((node, round(1e6 * weight)) for node, weight in parents))
        if key not in numbers:
            numbers[key] = len(numbers) + 1
            fine.points[numbers[key]] = tuple(sum(w * solid.points[node][i] for node, w in parents) for i in range(3))
            for name, members in solid.sets.items():
                if all(node in members for node, _ in parents):
                    fine.sets[name].add(numbers[key])
        return numbers[key]

    for nodes in solid.hexahedra:
        places = itertools.product(*(range(count) for count in counts))
        for first in places:
            fine.hexahedra.append([number(nodes, [2 * a + 1 + n for a, n in zip(first, node)]) for node in NODES])
    return fine


def by_height_and_radius(solid, name):
    """The nodes of a set by place along the axis, each row by radius."""
    rows = {}
    for node in solid.sets[name]:
        rows.setdefault(round(solid.points[node][2], 6), []).append(node)
    return [sorted(rows[z], key=lambda node: math.hypot(*solid.points[node][:2])) for z in sorted(rows)]


def turned(point, angle_rad):
    x, y, z = point
    cos, sin = math.cos(angle_rad), math.sin(angle_rad)
    return cos * x - sin * y, sin * x + cos * y, z


class Teeth:
    """Teeth of a gear side by side, anticlockwise: all of them, or a row with its outer cuts held. Tooth 0 is the second."""

    def __init__(self, case, sector, teeth):
        self.case, self.sector, self.teeth = case, sector, teeth
        self.points, self.hexahedra, self.held, self.numbers = {}, [], set(), []
        right, left = ([node for row in by_height_and_radius(sector, name) for node in row] for name in ("right_cut", "left_cut"))
        pitch_rad = 2.0 * math.pi / TEETH
        for a, b in zip(right, left, strict=True):
            assert math.dist(turned(sector.points[a], pitch_rad), sector.points[b]) < 1e-9, "cuts do not meet"
        for tooth in range(teeth):
            known = dict(zip(right, (self.numbers[-1][node] for node in left))) if self.numbers else {}
            if tooth == TEETH - 1:
                known.update(zip(left, (self.numbers[0][node] for node in right)))
            of_tooth = {}
            for node, point in sector.points.items():
                of_tooth[node] = known.get(node) or len(self.points) + 1
                self.points.setdefault(of_tooth[node], turned(point, (tooth - 1) * pitch_rad))
            self.numbers.append(of_tooth)
            self.hexahedra += [[of_tooth[node] for node in nodes] for nodes in sector.hexahedra]
            self.held |= {of_tooth[node] for node in sector.sets["clamp"]}
        if teeth < TEETH:
            self.held |= {self.numbers[0][node] for node in right} | {self.numbers[-1][node] for node in left}
        # Ends and middles of elements along the flank; middles of layers have ends only.
        self.flank = by_height_and_radius(sector, "flank")
        self.layer_ends_mm = [sector.points[row[0]][2] for row in self.flank[::2]]
        radii_mm = [math.hypot(*sector.points[node][:2]) for node in self.flank[0]]
        self.radii_mm, self.elements = (radii_mm[0], radii_mm[-1]), len(radii_mm) // 2

    def of_line(self, line, tooth):
        """The forces of a load on a tooth: {node: (x, y, z)}."""
        ends_mm = self.layer_ends_mm
        first, last = (min(range(len(ends_mm)), key=lambda k: abs(ends_mm[k] - at_mm)) for at_mm in (line.from_mm, line.to_mm))
        assert max(abs(ends_mm[first] - line.from_mm), abs(ends_mm[last] - line.to_mm)) < 1e-6, "the line ends within a layer"
        tan_base_helix = math.tan(math.radians(self.case.helix_angle_deg)) * COS_PRESSURE_ANGLE
        forces = {}
        for layer, (t, weight) in itertools.product(range(first, last), GAUSS_3):
            layer_mm = ends_mm[layer + 1] - ends_mm[layer]
            z_mm = ends_mm[layer] + layer_mm * (0.5 + 0.5 * t)
            rho_mm = line.position_mm + (0.5 * self.case.face_width_mm - z_mm) * tan_base_helix
            radius_mm = math.hypot(BASE_RADIUS_MM, rho_mm)
            place = (radius_mm - self.radii_mm[0]) / (self.radii_mm[1] - self.radii_mm[0]) * self.elements
            element = min(int(place), self.elements - 1)
            s = 2.0 * (place - element) - 1.0
            # A face is a hexahedron's at its side.
            for (x, y, z), value in zip(NODES, shape((s, -1.0, t))):
                if y == -1:
                    row = self.flank[2 * layer + 1 + z]
                    node = row[2 * element + 1 + x] if z else row[element + (x + 1) // 2]
                    part = 0.5 * weight * layer_mm / (line.to_mm - line.from_mm) * value
                    number = self.numbers[tooth + 1][node]
                    sums = forces.setdefault(number, [0.0] * 3)
                    for i, normal in enumerate(self.normal(number, tan_base_helix)):
                        sums[i] += part * normal
        return forces

    def normal(self, number, tan_base_helix):
        """Of the working flank into the tooth, its transverse component 1: clockwise cos α, along the radius -sin α."""
        x, y, _ = self.points[number]
        radius = math.hypot(x, y)
        cos = BASE_RADIUS_MM / radius
        sin = math.sqrt(1.0 - cos * cos)
        return (cos * y - sin * x) / radius, (-cos * x - sin * y) / radius, -tan_base_helix

    def deck(self, kind, loads):
        number = calculix.NUMBER
        lines = ["*NODE", *(f"{node},{','.join(map(number, point))}" for node, point in self.points.items())]
        lines.append(f"*ELEMENT,TYPE={kind},ELSET=BODY")
        for cell, nodes in enumerate(self.hexahedra, 1):
            lines += [",".join(map(str, [cell, *nodes[:10]])) + ",", ",".join(map(str, nodes[10:]))]
        lines += ["*NSET,NSET=HELD", *(f"{node}," for node in sorted(self.held)), "*NSET,NSET=FLANKS"]
        lines += [f"{of_tooth[node]}," for of_tooth in self.numbers[:3] for row in self.flank for node in row]
        lines += ["*MATERIAL,NAME=STEEL", "*ELASTIC", f"{number(fzg_c_pair.YOUNG_MODULUS_MPA)},{fzg_c_pair.POISSON_RATIO}"]
        lines += ["*SOLID SECTION,ELSET=BODY,MATERIAL=STEEL", "*BOUNDARY", "HELD,1,3"]
        for forces in loads:
            lines += ["*STEP", "*STATIC", "*CLOAD,OP=NEW"]
            lines += [f"{node},{i},{number(value)}" for node, force in forces.items() for i, value in enumerate(force, 1)]
            lines += ["*NODE PRINT,NSET=FLANKS", "U", "*END STEP"]
        return "\n".join([*lines, ""])


def solve(folder, name, deck):
    """The displacements of the flanks' nodes, step by step."""
    (folder / f"{name}.inp").write_text(deck, encoding="ascii")
    with open(folder / f"{name}.log", "w", encoding="ascii") as log:
        subprocess.run([calculix.program(), name], cwd=folder, stdout=log, stderr=log, check=True, timeout=7200,
                       env={"OMP_NUM_THREADS": "1", **os.environ})
    blocks = (folder / f"{name}.dat").read_text(encoding="ascii").split("displacements")[1:]
    rows = ([line.split() for line in block.splitlines()[1:] if line.strip()] for block in blocks)
    return [{int(row[0]): tuple(map(float, row[1:4])) for row in block if row[0].isdigit()} for block in rows]


def rows_of(folder, case, sector, teeth, in_section, over_width, kind):
    """The rows of one body."""
    fine = sector if in_section == over_width == 1 else split(sector, in_section, over_width)
    body = Teeth(case, fine, teeth)
    lines, acting = lines_of(case)
    name = f"{case.preset}-{teeth}-{in_section}-{over_width}-{kind}"
    print(f"{name}: {3 * len(body.points)} degrees of freedom", flush=True)
    found = solve(folder, name, body.deck(kind, [body.of_line(lines[load], 0) for load in acting]))
    # In the row, the tooth behind the loaded one is at its end.
    displaced = (-1, 0, 1) if teeth == TEETH else (0, 1)
    for load, displacement in zip(acting, found, strict=True):
        for tooth, of in itertools.product(displaced, lines):
            value = sum(f * u for node, force in body.of_line(of, tooth).items() for f, u in zip(force, displacement[node]))
            under = lines[load]
            yield [teeth, in_section, over_width, INTEGRATION_POINTS[kind], of.position_mm, of.from_mm, of.to_mm,
                   under.position_mm, under.from_mm, under.to_mm, -tooth, value]


def main():
    folder = pathlib.Path(sys.argv[1])
    for case in CASES:
        scene, mesh = folder / f"{case.preset}-in-space.toml", folder / f"{case.preset}-in-space.inp"
        preset = subprocess.run([turned_pair.gearwear(), "init", case.preset], capture_output=True, check=True, text=True).stdout
        # Bodies are held 2.5 normal modules below the root circles.
        depth_mm = 2.5 * 4.5 * math.cos(math.radians(case.helix_angle_deg))
        clamp = ", ".join(f"{gear} = {root_mm - depth_mm!r}" for gear, root_mm in (("pinion", 31.19265), ("wheel", 49.14675)))
        scene.write_text(f"{preset}\n[fem]\nclamp_radius_mm = {{ {clamp} }}\n")
        command = [turned_pair.gearwear(), "mesh", scene, "--three-dimensional", "--out", mesh]
        subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
        sector = read_solid(mesh, "pinion")
        rows = [row for body in case.bodies for row in rows_of(folder, case, sector, *body)]
        table.write(HERE / case.file, [
            f"CalculiX {calculix.version()}, made by validation/cross-check/run.sh (teeth_in_space.py)",
            f"the pinion of the preset {case.preset}, hexahedra of gearwear mesh --three-dimensional",
            f"teeth: {TEETH} the whole ring, fewer a row with its outer cuts held, the loaded tooth the second, clockwise first",
            "section_split, layer_split: elements that one becomes along each side of the section and over the face width",
            "integration_points: of an element, 27 C3D20, 8 C3D20R",
            "of, under: lines of contact by radius of curvature in the middle of the face width, and their loaded part",
            "pitches: of the tooth under load from the other, anticlockwise",
            "mm_per_N: displacement along the transverse line of action, by transverse force",
        ], ["teeth", "section_split", "layer_split", "integration_points", "of_position_mm", "of_from_mm", "of_to_mm",
            "under_position_mm", "under_from_mm", "under_to_mm", "pitches", "mm_per_N"], rows)


if __name__ == "__main__":
    main()

"""Meshes of gear pairs whose flanks are worn as a run of gearwear has them.

Every working flank's node is moved inwards along the normal by the depth at its nominal radius, and the bodies follow as an elastic solid would,
without keeping its stress.
"""

import bisect
import math
from dataclasses import dataclass

import calculix
import table
import turned_pair


@dataclass(frozen=True)
class Gear:
    axis_mm: float  # y of its axis; x is 0
    base_radius_mm: float
    # Radii between which the flank is involute, whose nodes tell where the tooth stands.
    involute_mm: tuple
    is_internal: bool = False


@dataclass(frozen=True)
class WornFlanks:
    gears: dict  # name: Gear
    young_modulus_mpa: float
    poisson_ratio: float

    def wear_down(self, folder, name, mesh, run):
        """Moves the nodes of the mesh to where the flanks are worn."""
        moves = {}
        for gear in self.gears:
            worn = wear_of(run, gear)
            for pair in turned_pair.PAIRS:
                nodes = self.chain(mesh, gear, turned_pair.flank(gear, pair))
                points = [mesh.points[node] for node in nodes]
                for i, (node, radius_mm) in enumerate(zip(nodes, self.nominal_radii(points, gear))):
                    middle = min(max(i, 1), len(nodes) - 2)
                    depth_mm = interpolated(*worn, radius_mm)
                    moves[node] = [depth_mm * part for part in inward_normal(*points[middle - 1:middle + 2])]
        deck = calculix.Deck(mesh)
        for body in mesh.bodies:
            deck.material(body, self.young_modulus_mpa, self.poisson_ratio)
        fixed = {node: (0.0, 0.0) for gear in self.gears for node in mesh.nodes_of(f"{gear}-clamp")}
        for node, move in {**fixed, **moves}.items():
            deck.displace(node, 1, move[0])
            deck.displace(node, 2, move[1])
        moved = {**deck.solve(folder, name, "wheel-clamp").displacement_mm, **moves}
        for node, (x, y) in mesh.points.items():
            dx, dy = moved.get(node, (0.0, 0.0))
            mesh.points[node] = x + dx, y + dy

    def chain(self, mesh, gear, group):
        """The nodes of a flank from root to tip."""
        centre = (0.0, self.gears[gear].axis_mm)
        return sorted(mesh.nodes_of(group), key=lambda node: math.dist(mesh.points[node], centre),
                      reverse=self.gears[gear].is_internal)

    def nominal_radii(self, points, name):
        """Radius of the involute's point whose normal passes through each point: normals are tangents of the base circle."""
        gear = self.gears[name]
        base_mm, (from_mm, to_mm) = gear.base_radius_mm, gear.involute_mm
        polar = [(math.hypot(x, y - gear.axis_mm), math.atan2(y - gear.axis_mm, x)) for x, y in points]
        # Roll angle + polar angle - pressure angle is one and the same for all points of an involute.
        sums = sorted(math.tan(math.acos(base_mm / r)) + angle - math.acos(base_mm / r)
                      for r, angle in polar if from_mm < r < to_mm)
        if sums[-1] - sums[0] > 1e-7:
            raise SystemExit(f"the flank of the {name} is no involute between {gear.involute_mm} mm")
        whole = sums[len(sums) // 2]
        rolls = [whole - angle + (math.acos(base_mm / r) if r > base_mm else 0.0) for r, angle in polar]
        return [base_mm * math.hypot(1.0, max(roll, 0.0)) for roll in rolls]


def wear_of(run, gear):
    """Radii of the nominal flank in mm, rising, and the depth in mm there."""
    rows = sorted((float(row["radius_mm"]), 1e-3 * float(row["wear_um"])) for row in table.read(run / f"{gear}.csv"))
    return [radius_mm for radius_mm, _ in rows], [depth_mm for _, depth_mm in rows]


def interpolated(places, values, at):
    k = min(max(bisect.bisect_right(places, at), 1), len(places) - 1)
    t = (at - places[k - 1]) / (places[k] - places[k - 1])
    return values[k - 1] + min(max(t, 0.0), 1.0) * (values[k] - values[k - 1])


def inward_normal(before, at, after):
    """Of the parabola through three points of a flank at the middle one, towards the material.

    Working flanks are those on the anticlockwise side of their tooth: the material is to the right of the way from root to tip.
    """
    h, k = math.dist(before, at), math.dist(at, after)
    tangent = [(k * k * (b - a) + h * h * (c - b)) / (h * k * (h + k)) for a, b, c in zip(before, at, after)]
    length = math.hypot(*tangent)
    return tangent[1] / length, -tangent[0] / length

"""A tooth pair in CalculiX whose wheel is held while its pinion is turned, on the meshes that `gearwear mesh` writes.

The pinion's clamp circle is turned rigidly by θ, linearly: u = θ (−y, x). The transmission error is θ r_b1; θ is what gives
the torque, the moment of the reactions about the pinion's axis (the origin) with arms before deformation, times the face
width.
"""

import math
import os
import subprocess
from dataclasses import dataclass

import calculix
import mesh_files

GEARS = ("pinion", "wheel")
# The pairs whose flanks are resolved: the one behind the reference pair, that pair, the one ahead of it.
PAIRS = (-1, 0, 1)


def gearwear():
    return os.environ.get("GEARWEAR", "gearwear")


def pair_mesh(scene, position_mm):
    """The mesh of a scene's pair with the reference pair in contact at the position."""
    path = scene.with_name(f"pair-{position_mm}.inp")
    command = [gearwear(), "mesh", scene, "--position", position_mm, "--out", path]
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    return mesh_files.read_abaqus(path)


def flank(gear, pair):
    """The name of the flank of a gear's tooth in the mesh."""
    return f"{gear}-flank{pair:+d}" if pair else f"{gear}-flank-0"


# Slave and master of each tooth pair.
PINION_ON_WHEEL = [(flank("pinion", pair), flank("wheel", pair)) for pair in PAIRS]


def contacts(mesh, is_wheel_slave, reach_mm):
    """Slave and master of each tooth pair, the wheel's flank first where that is said of the pair. Only the edges that may touch:
    CalculiX spends its time on others."""
    sides = []
    for pair in PAIRS:
        order = ("wheel", "pinion") if is_wheel_slave(pair) else ("pinion", "wheel")
        sides.append(tuple(flank(gear, pair) for gear in order))
    for pair in sides:
        near = [edges_near(mesh, group, other, reach)
                for group, other, reach in zip(pair, reversed(pair), (reach_mm, 2.0 * reach_mm))]
        mesh.edges.update(zip(pair, near))
    return [pair for pair in sides if all(mesh.edges[side] for side in pair)]


def edges_near(mesh, group, other, reach_mm):
    """The edges of a flank with a node within reach of the other flank's nodes."""
    of_other = [mesh.points[node] for node in mesh.nodes_of(other)]
    near = {node for node in mesh.nodes_of(group)
            if any(math.dist(mesh.points[node], point) < reach_mm for point in of_other)}
    return [edge for edge in mesh.edges[group] if near.intersection(mesh.edge_nodes(*edge))]


@dataclass(frozen=True)
class TurnedPair:
    young_modulus_mpa: dict  # of each gear
    poisson_ratio: float
    base_radius_mm: float  # of the pinion
    face_width_mm: float
    torque_nm: float
    # The torque is met to this part of it.
    torque_tolerance: float = 1e-3
    # What of each body is held or turned.
    held: tuple = ("clamp",)
    tolerances: str = calculix.TOLERANCES
    # Whether stresses at the nodes are wanted.
    stresses: bool = False

    def solve(self, folder, name, mesh, transmission_error_um, sides, penalty_mpa_per_mm):
        """The results at an angle, and the torque in N·m."""
        angle_rad = 1e-3 * transmission_error_um / self.base_radius_mm
        deck = calculix.Deck(mesh, self.tolerances, self.stresses)
        for body in mesh.bodies:
            deck.material(body, self.young_modulus_mpa[body], self.poisson_ratio)
        deck.penalty(penalty_mpa_per_mm)
        for slave, master in sides:
            deck.contact(slave, master)
        for gear in GEARS:
            mesh.edges[f"{gear}-held"] = [edge for part in self.held for edge in mesh.edges[f"{gear}-{part}"]]
        for node in mesh.nodes_of("wheel-held"):
            deck.displace(node, 1)
            deck.displace(node, 2)
        for node in mesh.nodes_of("pinion-held"):
            x, y = mesh.points[node]
            deck.displace(node, 1, -angle_rad * y)
            deck.displace(node, 2, angle_rad * x)
        results = deck.solve(folder, name, "pinion-held")
        moment_n = sum(mesh.points[node][0] * fy - mesh.points[node][1] * fx
                       for node, (fx, fy) in results.reaction_n_per_mm.items())
        return results, 1e-3 * moment_n * self.face_width_mm

    def at_torque(self, folder, name, mesh, error_um, sides, penalty_mpa_per_mm):
        """The transmission error in µm that gives the torque, with the results there: secant steps from the origin."""
        before = (0.0, 0.0)
        for _ in range(8):
            results, torque_nm = self.solve(folder, name, mesh, error_um, sides, penalty_mpa_per_mm)
            print(f"{name}: {error_um:.5f} µm, {torque_nm:.5f} N·m, {results.iterations} iterations", flush=True)
            if abs(torque_nm - self.torque_nm) < self.torque_tolerance * self.torque_nm:
                return error_um, torque_nm, results
            slope = (error_um - before[0]) / (torque_nm - before[1])
            before = (error_um, torque_nm)
            error_um += slope * (self.torque_nm - torque_nm)
        raise SystemExit(f"{name}: no angle found that gives {self.torque_nm} N·m")

    def line_loads(self, results, torque_nm, sides):
        """Line loads in N/mm, pair by pair: shares of the moment of all contact forces about the pinion's axis."""
        whole = 1e3 * torque_nm / (self.base_radius_mm * self.face_width_mm)
        moments = {slave: abs(results.contacts[slave].moment_n) for slave, _ in sides}
        return [moments[slave] / sum(moments.values()) * whole if slave else 0.0 for slave in slaves(sides)]


def peaks(mesh, results, sides):
    """Greatest pressures at a node in MPa, pair by pair."""
    return [max(results.pressure_mpa.get(node, 0.0) for node in mesh.nodes_of(slave)) if slave else 0.0
            for slave in slaves(sides)]


def slaves(sides):
    """The slave of each of PAIRS; none where that does not touch."""
    of_pairs = [[flank(gear, pair) for gear in GEARS] for pair in PAIRS]
    return [next((slave for slave, _ in sides if slave in names), None) for names in of_pairs]

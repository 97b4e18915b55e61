"""Compliance of a deeply worn plastic tooth: meshed on its worn outline, against the unworn tooth that gearwear bends.

    pip install meshio numpy scipy
    python validation/cross-check/worn_outline.py --program target/release/gearwear --out validation/cross-check/worn-outline.csv

The pair of the case plastic-worn wears on finite elements; the mesh of the pair (``gearwear mesh``) is cut down to the wheel, and the nodes
of one working flank are moved into the material by the wear depth at their radius, the others after them as a harmonic field. Both wheels are
held at the rim and loaded along the line of action over 0.16 mm of the flank (``gearwear fem`` on each mesh); the mean displacement
of the loaded nodes over the load is compared. Depths of the first 0.5 mm above the root and at the tip rounding are evened out, where the
step that wear leaves would fold elements.
"""

import argparse
import csv
import pathlib
import subprocess
import tempfile

import meshio
import numpy as np
import scipy.sparse
import scipy.sparse.linalg
import scipy.spatial

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
#: Revolutions of the pinion whose wear is looked at, and factors on the last of them.
REVOLUTIONS = (0.7e7, 1.35e7, 2.6e7, 6.0e7)
LAST_FACTOR = 0.7
#: Radii of the wheel that are loaded, mm; half the length of flank; the load, N/mm.
RADII, REACH, LOAD = (25.7, 26.0, 26.3, 26.6, 26.9), 0.08, 30.0
#: The wheel of the scene: its axis is at (0, a), and between these radii depths are taken as they are.
CENTRE, PLAIN = np.array([0.0, 52.0]), (25.5, 27.12)
#: Nodes as far from the flank as this stay, mm.
FAR = 1.6
#: Edges of a six-node triangle and an eight-node quadrilateral.
EDGES = {
    6: [(0, 3), (3, 1), (1, 4), (4, 2), (2, 5), (5, 0), (3, 4), (4, 5), (5, 3)],
    8: [(0, 4), (4, 1), (1, 5), (5, 2), (2, 6), (6, 3), (3, 7), (7, 0), (4, 6), (5, 7)],
}


def smooth_step(t):
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


class Wheel:
    """The wheel's part of the mesh of the pair."""

    def __init__(self, path):
        mesh = meshio.read(path)
        names = {tuple(tag): name for name, tag in mesh.field_data.items()}
        self.points = mesh.points[:, :2]
        self.bodies, lines = [], {}
        for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
            for tag in np.unique(tags):
                dimension = 1 if block.type == "line3" else 2
                name = names[(int(tag), dimension)]
                if name == "wheel":
                    self.bodies.append((block.type, block.data[tags == tag]))
                elif dimension == 1:
                    lines.setdefault(name, []).append(block.data[tags == tag])
        self.lines = {name: np.vstack(parts) for name, parts in lines.items()}
        self.nodes = np.unique(np.hstack([cells.ravel() for _, cells in self.bodies]))
        self.place = np.full(len(self.points), -1)
        self.place[self.nodes] = np.arange(len(self.nodes))
        self.radius = np.hypot(*(self.points - CENTRE).T)
        flank = np.unique(self.lines["wheel-flank-0"])
        self.flank = flank[np.argsort(self.radius[flank])]
        tangent = np.gradient(self.points[self.flank], axis=0)
        tangent /= np.linalg.norm(tangent, axis=1)[:, None]
        self.normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
        middle = len(self.flank) // 2
        body, probe = self.points[self.nodes], self.points[self.flank[middle]] + 0.3 * self.normal[middle]
        if np.linalg.norm(body - probe, axis=1).min() > 0.1:
            self.normal = -self.normal
        at_rounding = np.searchsorted(self.radius[self.flank], PLAIN[1])
        self.normal[at_rounding:] = self.normal[at_rounding]
        self._prepare()

    def _prepare(self):
        edges = np.vstack([cells[:, pair] for _, cells in self.bodies for pair in EDGES[cells.shape[1]]])
        one, two = self.place[edges].T
        body = self.points[self.nodes]
        weight = 1.0 / np.maximum(np.linalg.norm(body[one] - body[two], axis=1), 1e-9)
        count = len(self.nodes)
        both = (np.r_[one, two], np.r_[two, one])
        joined = scipy.sparse.coo_matrix((np.r_[weight, weight], both), shape=(count, count)).tocsr()
        self.laplace = scipy.sparse.diags(np.asarray(joined.sum(1)).ravel()) - joined
        tree = scipy.spatial.cKDTree(self.points[self.flank])
        far = np.flatnonzero(tree.query(body)[0] > FAR)
        others = np.unique(np.hstack([np.unique(part) for name, part in self.lines.items() if name.startswith("wheel-flank")]))
        others = np.setdiff1d(self.place[others], self.place[self.flank])
        self.held = np.unique(np.r_[self.place[self.flank], far, others])
        self.free = np.setdiff1d(np.arange(count), self.held)
        self.solve = scipy.sparse.linalg.splu(self.laplace[self.free][:, self.free].tocsc()).solve

    def worn(self, radius, depth_mm):
        """Points of the wheel, and the depth at the nodes of its flank."""
        at = self.radius[self.flank]
        plain = (at > PLAIN[0]) & (at < PLAIN[1])
        depth = np.interp(at, at[plain], np.interp(at[plain], radius, depth_mm))
        depth *= smooth_step((at - at[0]) / 0.5)
        depth = np.convolve(np.pad(depth, 10, mode="edge"), np.ones(21) / 21, "valid")
        moved = np.zeros((len(self.nodes), 2))
        moved[self.place[self.flank]] = depth[:, None] * self.normal
        moved[self.free] = self.solve(np.ascontiguousarray(-(self.laplace[self.free][:, self.held] @ moved[self.held])))
        return self.points[self.nodes] + moved, depth

    def compliance(self, program, folder, points, radius):
        """Mean displacement of the flank about `radius` along its normal over the load there, mm²/N."""
        flank = self.lines["wheel-flank-0"]
        loaded = flank[np.abs(self.radius[flank[:, 2]] - radius) < REACH]
        direction = self.normal[np.argmin(np.abs(self.radius[self.flank] - radius))]
        cells = [(kind, self.place[part]) for kind, part in self.bodies]
        cells += [("line3", self.place[self.lines["wheel-clamp"]]), ("line3", self.place[loaded])]
        tags = [np.full(len(part), tag) for (_, part), tag in zip(cells, [1] * len(self.bodies) + [2, 3])]
        mesh = meshio.Mesh(
            np.column_stack([points, np.zeros(len(points))]),
            cells,
            cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
            field_data={"wheel": np.array([1, 2]), "clamp": np.array([2, 1]), "load": np.array([3, 1])},
        )
        meshio.write(folder / "wheel.msh", mesh, file_format="gmsh22", binary=False)
        force = (LOAD * direction).tolist()
        (folder / "wheel.toml").write_text(
            'title = "worn tooth"\n[mesh]\nfile = "wheel.msh"\n'
            '[[body]]\ngroup = "wheel"\nyoung_modulus_GPa = 4.156\npoisson_ratio = 0.34\n'
            '[[fixed]]\ngroup = "clamp"\ncomponents = ["x", "y"]\n'
            f'[[load]]\ngroup = "load"\nforce_N_per_mm = {force}\n'
        )
        subprocess.run([program, "fem", folder / "wheel.toml", "--out", folder / "solved", "--quiet"], check=True)
        solved = meshio.read(folder / "solved" / "solution.vtu").point_data
        displacement = next(values for name, values in solved.items() if "displacement" in name)
        return float((displacement[self.place[np.unique(loaded)], :2] @ direction).mean()) / LOAD


def profiles(program, folder):
    """Wear depth of the wheel, mm, over its radius at each of REVOLUTIONS, on finite elements."""
    text = (REPOSITORY / "validation" / "plastic-worn" / "scene.toml").read_text()
    for old, new in (
        ('surface = "winkler"\nmatch = "half-width"\ntip_contact = true\n', 'surface = "fem"\n'),
        ('[stiffness]\nmodel = "fem"\n', ""),
        ("pinion_revolutions = 2.0e7", f"pinion_revolutions = {REVOLUTIONS[-1]:e}"),
        ("snapshots_revolutions = [2.0e7]", f"snapshots_revolutions = {list(REVOLUTIONS)}"),
        ("stop = { wear_um = 100.0 }\n", ""),
    ):
        assert old in text, old
        text = text.replace(old, new)
    (folder / "scene.toml").write_text(text)
    subprocess.run([program, "mesh", folder / "scene.toml", "--out", folder / "pair.msh"], check=True, capture_output=True)
    command = [program, "run", folder / "scene.toml", "--out", folder / "run", "--quiet", "--no-report"]
    subprocess.run(command, check=True, capture_output=True)
    found = {}
    with open(folder / "run" / "profiles.csv") as file:
        for row in csv.DictReader(file):
            if row["gear"] == "wheel":
                found.setdefault(float(row["revolutions"]), []).append((float(row["radius_mm"]), 1e-3 * float(row["wear_um"])))
    return {revolutions: np.array(rows).T for revolutions, rows in found.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="target/release/gearwear")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    asked = parser.parse_args()
    program = pathlib.Path(asked.program).resolve()
    with tempfile.TemporaryDirectory() as name, open(asked.out, "w", newline="") as out:
        folder = pathlib.Path(name)
        worn = profiles(program, folder)
        wheel = Wheel(folder / "pair.msh")
        unworn = [wheel.compliance(program, folder, wheel.points[wheel.nodes], radius) for radius in RADII]
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["revolutions", "factor", "radius_mm", "depth_um", "greatest_depth_um", "unworn_mm2_per_N", "worn_outline_mm2_per_N", "ratio"])
        for revolutions, (radius, depth) in sorted(worn.items()):
            factor = LAST_FACTOR if revolutions == REVOLUTIONS[-1] else 1.0
            points, at_nodes = wheel.worn(radius, factor * depth)
            for loaded, before in zip(RADII, unworn):
                after = wheel.compliance(program, folder, points, loaded)
                here = np.interp(loaded, wheel.radius[wheel.flank], at_nodes)
                figures = [f"{before:.4e}", f"{after:.4e}", f"{after / before:.4f}"]
                table.writerow([f"{revolutions:g}", factor, loaded, f"{1e3 * here:.0f}", f"{1e3 * at_nodes.max():.0f}", *figures])
                out.flush()


if __name__ == "__main__":
    main()

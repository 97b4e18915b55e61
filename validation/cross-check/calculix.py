"""Decks for CalculiX, its runs, and what they print.

Plane strain of thickness 1 mm, so forces are per mm. Contact is frictionless, face to face, by a linear penalty.

Every analysis is one increment from the undeformed state, without NLGEOM. CalculiX fixes the normals and the facing of
the surfaces at the start of an increment; one increment therefore is linear kinematics, as gearwear has it. With more
increments the normals turn with the surfaces, which is another model, so a run that was cut into more is refused.
"""

import os
import pathlib
import re
import shutil
import subprocess
from dataclasses import dataclass

# CalculiX reads at most 20 characters of a number.
NUMBER = "{:.12e}".format
# Residual force and last correction, as parts of the mean force and of the maximum displacement; by default CalculiX is
# content with 0.005 and 0.01. The two blanks stand for means it is to compute itself; after nine iterations it uses the
# fifth number in place of the first.
TOLERANCES = "1e-6,1e-3,,,1e-6"


@dataclass
class ContactForce:
    """What acts on the slave surface of a contact pair, per mm of thickness."""

    x_n_per_mm: float
    y_n_per_mm: float
    moment_n: float  # about the origin, N·mm/mm, with arms after deformation
    length_mm: float  # of the surface under pressure


@dataclass
class Results:
    displacement_mm: dict  # node: (x, y)
    pressure_mpa: dict  # slave node: pressure
    reaction_n_per_mm: dict  # node whose reaction was asked for: (x, y)
    contacts: dict  # name of the slave surface: ContactForce
    iterations: int
    stress_mpa: dict  # node: (xx, yy, zz, xy, yz, zx); empty where it was not asked for


class Deck:
    """An input deck of one step, in the order CalculiX wants it."""

    def __init__(self, mesh, tolerances=TOLERANCES, stresses=False):
        self.mesh, self.lines, self.step, self.contacts = mesh, ["*NODE"], [], []
        self.tolerances, self.stresses = tolerances, stresses
        self.lines += [f"{node},{NUMBER(x)},{NUMBER(y)},0." for node, (x, y) in sorted(mesh.points.items())]
        for body, cells in mesh.bodies.items():
            for kind in sorted({mesh.cells[cell][0] for cell in cells}):
                self.lines.append(f"*ELEMENT,TYPE={kind},ELSET={body}")
                for cell in cells:
                    if mesh.cells[cell][0] == kind:
                        self.lines.append(",".join(map(str, [cell, *mesh.cells[cell][1]])))

    def material(self, body, young_modulus_mpa, poisson_ratio):
        self.lines += [f"*MATERIAL,NAME=M{body}", "*ELASTIC", f"{NUMBER(young_modulus_mpa)},{NUMBER(poisson_ratio)}"]
        self.lines += [f"*SOLID SECTION,ELSET={body},MATERIAL=M{body}", "1."]

    def penalty(self, mpa_per_mm):
        self.lines += ["*SURFACE INTERACTION,NAME=CONTACT", "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR"]
        self.lines.append(NUMBER(mpa_per_mm))

    def contact(self, slave, master):
        """Contact of two groups of edges. The names CalculiX sees are numbered: it takes no + in them."""
        number = len(self.contacts)
        for side, group in (("SLAVE", slave), ("MASTER", master)):
            self.lines.append(f"*SURFACE,NAME={side}{number},TYPE=ELEMENT")
            self.lines += [f"{cell},S{edge}" for cell, edge in self.mesh.edges[group]]
        self.lines += ["*CONTACT PAIR,INTERACTION=CONTACT,TYPE=SURFACE TO SURFACE", f"SLAVE{number},MASTER{number}"]
        self.contacts.append(slave)

    def displace(self, node, component, value_mm=0.0):
        self.step += ["*BOUNDARY", f"{node},{component},{component},{NUMBER(value_mm)}"]

    def press(self, group, pressure_mpa):
        self.step.append("*DLOAD")
        self.step += [f"{cell},P{side},{NUMBER(pressure_mpa)}" for cell, side in self.mesh.edges[group]]

    def text(self, reactions_of):
        """The whole deck; it asks for the reactions of the nodes on a group of edges."""
        lines = self.lines + ["*NSET,NSET=REACTIONS"] + [f"{node}," for node in self.mesh.nodes_of(reactions_of)]
        lines += ["*STEP", "*CONTROLS,PARAMETERS=FIELD", self.tolerances, "*STATIC,DIRECT", "1.,1."] + self.step
        lines += ["*NODE PRINT,NSET=REACTIONS", "RF", "*NODE FILE", "U"]
        if self.stresses:
            lines += ["*EL FILE", "S"]
        if self.contacts:
            lines += ["*CONTACT FILE", "CSTR"]
        for number in range(len(self.contacts)):
            lines += [f"*CONTACT PRINT,SLAVE=SLAVE{number},MASTER=MASTER{number}", "CF"]
        return "\n".join([*lines, "*END STEP", ""])

    def solve(self, folder, name, reactions_of):
        """Runs CalculiX in `folder` on this deck and reads the results."""
        folder = pathlib.Path(folder)
        (folder / f"{name}.inp").write_text(self.text(reactions_of), encoding="ascii")
        with open(folder / f"{name}.log", "w", encoding="ascii") as log:
            subprocess.run([program(), name], cwd=folder, stdout=log, stderr=log, check=True, timeout=3600,
                           env={**os.environ, "OMP_NUM_THREADS": "1"})
        status = [line.split() for line in (folder / f"{name}.sta").read_text(encoding="ascii").splitlines()[2:]]
        if len(status) != 1 or status[0][5:] != ["0.100000E+01"] * 2:
            raise SystemExit(f"{folder / name}: CalculiX did not converge in one increment; see {name}.log and {name}.sta")
        displacement = {node: row[:2] for node, row in _nodal(folder / f"{name}.frd", "DISP").items()}
        pressure = {node: row[3] for node, row in _nodal(folder / f"{name}.frd", "CONTACT").items()}
        reactions, contacts = _printed((folder / f"{name}.dat").read_text(encoding="ascii"), self.contacts)
        stress = _nodal(folder / f"{name}.frd", "STRESS") if self.stresses else {}
        return Results(displacement, pressure, reactions, contacts, int(status[0][3]), stress)


def program():
    path = shutil.which(os.environ.get("CCX", "ccx"))
    if path is None:
        raise SystemExit("ccx is not on the PATH and CCX does not name it; see README.md")
    return os.path.abspath(path)


def version():
    """As `ccx -v` says it, which ends with status 201 after saying it."""
    said = subprocess.run([program(), "-v"], capture_output=True, text=True, check=False).stdout
    return re.search(r"Version (\S+)", said).group(1)


def _nodal(path, name):
    """The last block of a nodal result in an .frd file: columns of 12 characters after the node's number."""
    rows, reading = {}, False
    with open(path, encoding="ascii") as file:
        for line in file:
            if line.startswith(" -4"):
                reading = line.split()[1] == name
            elif line.startswith(" -3"):
                reading = False
            elif reading and line.startswith(" -1"):
                rows[int(line[3:13])] = [float(line[i:i + 12]) for i in range(13, len(line.rstrip()), 12)]
    return rows


def _printed(text, slaves):
    """Reactions and contact forces of a .dat file with one increment."""
    reactions_text, *blocks = text.split("statistics for slave set")
    reactions = {}
    for line in reactions_text.splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            reactions[int(words[0])] = float(words[1]), float(words[2])
    contacts = {}
    for slave, block in zip(slaves, blocks, strict=True):
        rows = [[float(word) for word in line.split()] for line in block.splitlines()[1:] if line.strip() and "(" not in line
                and "center" not in line]
        contacts[slave] = ContactForce(rows[0][0], rows[0][1], rows[0][5], rows[-1][0])
    return reactions, contacts

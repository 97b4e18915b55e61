"""Plane meshes with named groups, from Gmsh's binary format 4.1 or from the Abaqus file that `gearwear mesh` writes.

A mesh has points by number, cells by number, groups of cells, and groups of edges. An edge is (cell, side); side i of a
cell runs from its corner i to the next, counted from 1, as Abaqus and CalculiX count.
"""

import struct
from dataclasses import dataclass, field

# Gmsh's element types: name in CalculiX (plane strain; lines have none) and number of nodes.
GMSH_KINDS = {1: (None, 2), 8: (None, 3), 2: ("CPE3", 3), 9: ("CPE6", 6), 3: ("CPE4", 4), 16: ("CPE8", 8)}
CORNERS = {"CPE3": 3, "CPE6": 3, "CPE4": 4, "CPE8": 4}


@dataclass
class Mesh:
    points: dict = field(default_factory=dict)  # number: (x_mm, y_mm)
    cells: dict = field(default_factory=dict)  # number: (kind, nodes)
    bodies: dict = field(default_factory=dict)  # name: cell numbers
    edges: dict = field(default_factory=dict)  # name: [(cell, side)]

    def edge_nodes(self, cell, side):
        """The nodes of an edge from end to end, the one in its middle included where there is one."""
        kind, nodes = self.cells[cell]
        n = CORNERS[kind]
        ends = nodes[side - 1], nodes[side % n]
        return (ends[0], nodes[n + side - 1], ends[1]) if len(nodes) > n else ends

    def turn_anticlockwise(self):
        """Numbers the nodes of every cell anticlockwise, as CalculiX needs it. Sides of edges named before are lost."""
        for kind, nodes in self.cells.values():
            n = CORNERS[kind]
            ring = [self.points[node] for node in nodes[:n]]
            if sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) < 0.0:
                nodes[:n] = nodes[:1] + nodes[n - 1:0:-1]
                nodes[n:] = nodes[:n - 1:-1]

    def nodes_of(self, group):
        """All nodes on a group of edges, in order of number."""
        return sorted({node for edge in self.edges[group] for node in self.edge_nodes(*edge)})


class _Bytes:
    """A cursor over the bytes of a file."""

    def __init__(self, data, at):
        self.data, self.at = data, at

    def take(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values


def _section(data, name):
    start = data.index(b"$" + name + b"\n") + len(name) + 2
    return _Bytes(data, start)


def read_gmsh(path):
    """A binary Gmsh 4.1 file whose cells and boundary lines lie in named physical groups."""
    with open(path, "rb") as file:
        data = file.read()
    if not data[data.index(b"\n") + 1:].startswith(b"4.1 1 8\n"):
        raise SystemExit(f"{path}: not a binary Gmsh file of version 4.1")
    names, mesh = {}, Mesh()

    lines = data[data.index(b"$PhysicalNames"):data.index(b"$EndPhysicalNames")].decode().splitlines()
    for line in lines[2:]:
        dimension, tag, name = line.split(maxsplit=2)
        names[int(dimension), int(tag)] = name.strip('"')

    group_of = {}  # of an entity: name of its physical group
    cursor = _section(data, b"Entities")
    points, curves, surfaces, _ = cursor.take("4Q")
    for _ in range(points):
        cursor.take("i3d")
        cursor.take(f"{cursor.take('Q')[0]}i")
    for dimension, count in ((1, curves), (2, surfaces)):
        for _ in range(count):
            (tag,) = cursor.take("i6d")[:1]
            physical = cursor.take(f"{cursor.take('Q')[0]}i")
            cursor.take(f"{cursor.take('Q')[0]}i")
            if physical:
                group_of[dimension, tag] = names[dimension, physical[0]]

    cursor = _section(data, b"Nodes")
    for _ in range(cursor.take("4Q")[0]):
        _, _, _, count = cursor.take("3iQ")
        tags = cursor.take(f"{count}Q")
        for tag in tags:
            mesh.points[tag] = cursor.take("3d")[:2]

    lines_of = {}
    cursor = _section(data, b"Elements")
    for _ in range(cursor.take("4Q")[0]):
        dimension, entity, kind, count = cursor.take("3iQ")
        if kind not in GMSH_KINDS:
            raise SystemExit(f"{path}: element type {kind} of Gmsh is not supported")
        name, size = GMSH_KINDS[kind]
        group = group_of.get((dimension, entity))
        for _ in range(count):
            tag, *nodes = cursor.take(f"{1 + size}Q")
            if dimension == 2:
                mesh.cells[tag] = (name, nodes)
                mesh.bodies.setdefault(group, []).append(tag)
            elif group is not None:
                lines_of.setdefault(group, []).append(frozenset(nodes[:2]))

    mesh.turn_anticlockwise()
    side_of = {}
    for tag, (kind, nodes) in mesh.cells.items():
        for i in range(CORNERS[kind]):
            side_of[frozenset((nodes[i], nodes[(i + 1) % CORNERS[kind]]))] = (tag, i + 1)
    mesh.edges = {group: [side_of[line] for line in ends] for group, ends in lines_of.items()}
    return mesh


def read_abaqus(path):
    """The subset of the Abaqus format that `gearwear mesh` writes."""
    mesh, keep = Mesh(), lambda row: None
    with open(path, encoding="ascii") as file:
        for line in file:
            if not line.startswith("*"):
                keep([word.strip() for word in line.split(",")])
                continue
            keyword, *options = [word.strip() for word in line[1:].split(",")]
            options = dict(option.split("=", 1) for option in options)
            keep = _keeper(mesh, keyword.upper(), {name.upper(): value.strip('"') for name, value in options.items()})
    return mesh


def _keeper(mesh, keyword, options):
    """What to do with the rows below a keyword."""
    if keyword == "NODE":
        return lambda row: mesh.points.update({int(row[0]): (float(row[1]), float(row[2]))})
    if keyword == "ELEMENT":
        kind = options["TYPE"]
        return lambda row: mesh.cells.update({int(row[0]): (kind, [int(word) for word in row[1:]])})
    if keyword == "ELSET":
        cells = mesh.bodies.setdefault(options["ELSET"], [])
        return lambda row: cells.extend(int(word) for word in row if word)
    if keyword == "SURFACE":
        edges = mesh.edges.setdefault(options["NAME"], [])
        return lambda row: edges.append((int(row[0]), int(row[1][1:])))
    return lambda row: None

"""A quarter of a square plate, 20 x 20 x 1 mm, as hexahedra; needs nothing but Python, and writes Gmsh 2.2 as text.

Groups: plate (volumes); supported-x, supported-y (the edges x = 0 and y = 0), middle-x, middle-y (the planes of symmetry x = 10 and
y = 10), top (surfaces).

    python plate.py --kind hex8 --out plate-hex8.msh
    python plate.py --kind hex20 --out plate-hex20.msh
"""

import argparse

SIZE_MM = (10.0, 10.0, 1.0)
CELLS = {"hex8": (10, 10, 2), "hex20": (5, 5, 1)}
# Gmsh's numbers of the elements: volumes, their faces.
TYPES = {"hex8": (5, 3), "hex20": (17, 16)}
CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
# Gmsh's order of the middles.
EDGES = ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7))
# Name, direction, whether at its end, corners.
FACES = (
    ("supported-x", 0, False, (0, 4, 7, 3)),
    ("supported-y", 1, False, (0, 1, 5, 4)),
    ("middle-x", 0, True, (1, 2, 6, 5)),
    ("middle-y", 1, True, (3, 7, 6, 2)),
    ("top", 2, True, (4, 5, 6, 7)),
)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kind", choices=CELLS, default="hex8")
    parser.add_argument("--out", required=True, help="the .msh file to write")
    options = parser.parse_args()
    cells, (volume, face) = CELLS[options.kind], TYPES[options.kind]
    quadratic = options.kind == "hex20"
    nodes, volumes, faces = {}, [], []

    def node(at):
        return nodes.setdefault(at, len(nodes) + 1)

    for first in ((i, j, k) for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])):
        corner = [tuple(2 * f + c for f, c in zip(first, own)) for own in CORNERS]

        def cell(corners, sides):
            middles = [tuple((p + q) // 2 for p, q in zip(corner[a], corner[b])) for a, b in sides if quadratic]
            return [node(at) for at in [corner[c] for c in corners] + middles]

        volumes.append(cell(range(8), EDGES))
        for number, (_, axis, at_end, own) in enumerate(FACES):
            if all(corner[c][axis] == (2 * cells[axis] if at_end else 0) for c in own):
                faces.append((number + 2, cell(own, [(own[i], own[(i + 1) % 4]) for i in range(4)])))

    names = [(3, 1, "plate")] + [(2, number + 2, name) for number, (name, *_) in enumerate(FACES)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{dimension} {tag} "{name}"' for dimension, tag, name in names]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
    for at, number in nodes.items():
        place = (size * half / (2 * count) for size, half, count in zip(SIZE_MM, at, cells))
        lines.append(" ".join([str(number)] + [f"{x:g}" for x in place]))
    lines += ["$EndNodes", "$Elements", str(len(volumes) + len(faces))]
    elements = [(volume, 1, own) for own in volumes] + [(face, tag, own) for tag, own in faces]
    for number, (kind, tag, own) in enumerate(elements, 1):
        lines.append(" ".join(map(str, [number, kind, 2, tag, tag] + own)))
    lines.append("$EndElements")
    with open(options.out, "w", encoding="ascii") as out:
        out.write("\n".join(lines) + "\n")


main()

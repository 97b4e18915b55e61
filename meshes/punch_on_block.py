"""A flat punch of 20 mm by 10 mm pressed on a block of 100 mm by 50 mm, half of it (symmetry line x = 0).

The edge of the punch is sharp: the pressure of a rigid punch grows there as 1/sqrt of the distance (K. L. Johnson, Contact
Mechanics, section 2.8); the meshes are graded to it.

Groups: punch, block (surfaces); punch-bottom, block-top, base, symmetry, top (lines).

    python punch_on_block.py --kind quad4 --out punch-on-block-quad4.msh
"""

import gmsh

import common


def block(width_mm, bottom_mm, top_mm):
    geo = gmsh.model.occ
    points = [geo.addPoint(x, y, 0) for x, y in ((0, bottom_mm), (width_mm, bottom_mm), (width_mm, top_mm), (0, top_mm))]
    lines = [geo.addLine(points[i], points[(i + 1) % 4]) for i in range(4)]
    return geo.addPlaneSurface([geo.addCurveLoop(lines)]), lines, points


def main():
    options = common.arguments(__doc__)
    common.begin(options.kind)
    punch, (bottom, _, top, punch_axis), points = block(10, 0, 10)
    base_block, (base, _, upper, block_axis), _ = block(50, -50, 0)
    under_edge = gmsh.model.occ.addPoint(10, 0, 0)
    gmsh.model.occ.synchronize()
    common.group(2, [punch], "punch")
    common.group(2, [base_block], "block")
    for tags, name in (([bottom], "punch-bottom"), ([upper], "block-top"), ([base], "base"),
                       ([punch_axis, block_axis], "symmetry"), ([top], "top")):
        common.group(1, tags, name)
    common.graded([points[1], under_edge], 0.4, 8.0, 1.0, options.refine)
    common.finish(options.kind, options.out)


main()

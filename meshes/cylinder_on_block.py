"""The NAFEMS benchmark of a cylinder on a block (A. Konter, Advanced finite element contact benchmarks, NAFEMS 2006), half of it.

A cylinder of radius 50 mm rests on a block of 200 mm by 200 mm; the contact is at the origin, the symmetry line x = 0.
Refinement 1 has about 3000 unknowns, 4 to 5 about 70 000. Half model: a quarter disc (its flat top carries the load) on half a block. The contact half-width under 35 kN/mm is 6.2 mm.

Groups: cylinder, block (surfaces); cylinder-surface, block-top, base, symmetry, top (lines).

    python cylinder_on_block.py --kind quad8 --refine 2 --out cylinder-on-block-quad8.msh
"""

import gmsh

import common

RADIUS_MM, WIDTH_MM, HEIGHT_MM = 50.0, 100.0, 200.0
# Elements are evenly small within this of the first contact, then grow.
REACH_MM = 8.0


def main():
    options = common.arguments(__doc__)
    common.begin(options.kind)
    geo = gmsh.model.occ
    origin = geo.addPoint(0, 0, 0)
    centre = geo.addPoint(0, RADIUS_MM, 0)
    right = geo.addPoint(RADIUS_MM, RADIUS_MM, 0)
    arc = geo.addCircleArc(origin, centre, right)
    top = geo.addLine(right, centre)
    axis = geo.addLine(centre, origin)
    cylinder = geo.addPlaneSurface([geo.addCurveLoop([arc, top, axis])])
    corner = [geo.addPoint(x, y, 0) for x, y in ((0, 0), (0, -HEIGHT_MM), (WIDTH_MM, -HEIGHT_MM), (WIDTH_MM, 0))]
    left, base, side, upper = (geo.addLine(corner[i], corner[(i + 1) % 4]) for i in range(4))
    block = geo.addPlaneSurface([geo.addCurveLoop([left, base, side, upper])])
    geo.synchronize()
    common.group(2, [cylinder], "cylinder")
    common.group(2, [block], "block")
    for tags, name in (([arc], "cylinder-surface"), ([upper], "block-top"), ([base], "base"), ([axis, left], "symmetry"), ([top], "top")):
        common.group(1, tags, name)
    linear = options.kind in ("tri3", "quad4")
    common.graded([origin, corner[0]], 0.4 if linear else 0.8, 20.0, REACH_MM, options.refine)
    common.finish(options.kind, options.out)


main()

"""Two blocks on each other with meshes that do not match, for the contact patch test.

Lower block 0 to 10 by 0 to 5 mm, upper block 0 to 10 by 5 to 10 mm; under even pressure on the top the stress is the same
everywhere, whatever the meshes.

Groups: lower, upper (surfaces); lower-top, upper-bottom, base, top, left (lines; left is the symmetry line x = 0 of both).

    python patch_test.py --kind quad4 --out patch-test-quad4.msh
"""

import gmsh

import common


def block(bottom_mm, top_mm):
    geo = gmsh.model.occ
    points = [geo.addPoint(x, y, 0) for x, y in ((0, bottom_mm), (10, bottom_mm), (10, top_mm), (0, top_mm))]
    lines = [geo.addLine(points[i], points[(i + 1) % 4]) for i in range(4)]
    return geo.addPlaneSurface([geo.addCurveLoop(lines)]), lines


def main():
    options = common.arguments(__doc__)
    common.begin(options.kind)
    lower, (base, lower_right, lower_top, lower_left) = block(0, 5)
    upper, (upper_bottom, upper_right, top, upper_left) = block(5, 10)
    gmsh.model.occ.synchronize()
    # Five and seven elements share no node on the interface but its ends.
    common.divide({base: 5, lower_top: 5, lower_left: 3, lower_right: 3}, options.refine)
    common.divide({upper_bottom: 7, top: 7, upper_left: 4, upper_right: 4}, options.refine)
    for surface in (lower, upper):
        gmsh.model.mesh.setTransfiniteSurface(surface)
    common.group(2, [lower], "lower")
    common.group(2, [upper], "upper")
    for tags, name in (([lower_top], "lower-top"), ([upper_bottom], "upper-bottom"), ([base], "base"), ([top], "top"),
                       ([lower_left, upper_left], "left")):
        common.group(1, tags, name)
    common.finish(options.kind, options.out)


main()

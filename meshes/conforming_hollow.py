"""A cylinder of radius 50 mm in a hollow of radius 50.5 mm, half of it: nearly conforming contact (symmetry line x = 0).

The hollow is a half-cylinder in a block of 160 mm by 120 mm whose upper side is level with the hollow's centre; contact begins
at the origin.

Groups: cylinder, block (surfaces); cylinder-surface, hollow, base, symmetry, top (lines).

    python conforming_hollow.py --kind quad8 --out conforming-hollow-quad8.msh
"""

import gmsh

import common

RADIUS_MM, HOLLOW_MM, WIDTH_MM, DEPTH_MM = 50.0, 50.5, 80.0, 70.0


def main():
    options = common.arguments(__doc__)
    common.begin(options.kind)
    geo = gmsh.model.occ
    low, centre, right = geo.addPoint(0, 0, 0), geo.addPoint(0, RADIUS_MM, 0), geo.addPoint(RADIUS_MM, RADIUS_MM, 0)
    arc, top, axis = geo.addCircleArc(low, centre, right), geo.addLine(right, centre), geo.addLine(centre, low)
    cylinder = geo.addPlaneSurface([geo.addCurveLoop([arc, top, axis])])
    bed, middle, edge = geo.addPoint(0, 0, 0), geo.addPoint(0, HOLLOW_MM, 0), geo.addPoint(HOLLOW_MM, HOLLOW_MM, 0)
    shoulder, foot = geo.addPoint(WIDTH_MM, HOLLOW_MM, 0), geo.addPoint(WIDTH_MM, -DEPTH_MM, 0)
    corner = geo.addPoint(0, -DEPTH_MM, 0)
    hollow = geo.addCircleArc(edge, middle, bed)
    left, base = geo.addLine(bed, corner), geo.addLine(corner, foot)
    side, ledge = geo.addLine(foot, shoulder), geo.addLine(shoulder, edge)
    block = geo.addPlaneSurface([geo.addCurveLoop([hollow, left, base, side, ledge])])
    geo.synchronize()
    common.group(2, [cylinder], "cylinder")
    common.group(2, [block], "block")
    for tags, name in (([arc], "cylinder-surface"), ([hollow], "hollow"), ([base], "base"), ([axis, left], "symmetry"), ([top], "top")):
        common.group(1, tags, name)
    size = 2.0 if options.kind in ("tri3", "quad4") else 4.0
    common.graded([low, bed], size, 15.0, 20.0, options.refine)
    common.finish(options.kind, options.out)


main()

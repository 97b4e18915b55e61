// Half of a roller of radius 10 mm on a block of 20 mm by 20 mm; the line of symmetry is x = 0.
R = 10;  W = 20;  fine = 0.03;  coarse = 2.5;
Point(1) = {0, 0, 0, fine};      // roller: contact
Point(2) = {0, R, 0, coarse};    // its centre
Point(3) = {R, R, 0, coarse};
Circle(1) = {1, 2, 3};
Line(2) = {3, 2};
Line(3) = {2, 1};
Point(4) = {0, 0, 0, fine};      // block: a node of its own at the same place
Point(5) = {W, 0, 0, coarse};
Point(6) = {W, -W, 0, coarse};
Point(7) = {0, -W, 0, coarse};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 4};
Curve Loop(1) = {1, 2, 3};  Plane Surface(1) = {1};
Curve Loop(2) = {-7, -6, -5, -4};  Plane Surface(2) = {2};
Field[1] = Distance;  Field[1].PointsList = {1};
Field[2] = Threshold;  Field[2].InField = 1;
Field[2].SizeMin = fine;  Field[2].DistMin = 0.5;
Field[2].SizeMax = coarse;  Field[2].DistMax = 10;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;  Mesh.MeshSizeFromPoints = 0;
Mesh.ElementOrder = 2;
Physical Surface("roller") = {1};
Physical Surface("block") = {2};
Physical Curve("running-surface") = {1};
Physical Curve("top") = {2};
Physical Curve("symmetry") = {3, 7};
Physical Curve("track") = {4};
Physical Curve("base") = {6};

// The boom of a crane, in m: a solid steel bar along x with four bores along y: the foot at the origin, the jack, a lug for the
// jack of the jib, and the tip.
SetFactory("OpenCASCADE");

length = 3; half_width = 0.04; half_depth = 0.1; beyond = 0.1; bore = 0.035;

Box(1) = {-beyond, -half_width, -half_depth, length + 2 * beyond, 2 * half_width, 2 * half_depth};
x() = {0, 1.1, 2.2, length};
For i In {0:3}
  Cylinder(10 + i) = {x(i), -half_width, 0, 0, 2 * half_width, 0, bore};
EndFor
body() = BooleanDifference{ Volume{1}; Delete; }{ Volume{10:13}; Delete; };

e = 1e-3;
Physical Volume("boom") = body();
foot() = Surface In BoundingBox {-bore - e, -1, -bore - e, bore + e, 1, bore + e};
jack() = Surface In BoundingBox {1.1 - bore - e, -1, -bore - e, 1.1 + bore + e, 1, bore + e};
lug() = Surface In BoundingBox {2.2 - bore - e, -1, -bore - e, 2.2 + bore + e, 1, bore + e};
tip() = Surface In BoundingBox {length - bore - e, -1, -bore - e, length + bore + e, 1, bore + e};
Physical Surface("foot") = foot();
Physical Surface("jack") = jack();
Physical Surface("lug") = lug();
Physical Surface("tip") = tip();

// A thick square plate, 10 m x 10 m x 1 m, with its faces named after the axes.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 10, 10, 1};
e = 0.1;
Physical Volume("plate") = {1};
Physical Surface("x0") = Surface In BoundingBox {-e, -e, -e, e, 10 + e, 1 + e};
Physical Surface("x1") = Surface In BoundingBox {10 - e, -e, -e, 10 + e, 10 + e, 1 + e};
Physical Surface("y0") = Surface In BoundingBox {-e, -e, -e, 10 + e, e, 1 + e};
Physical Surface("y1") = Surface In BoundingBox {-e, 10 - e, -e, 10 + e, 10 + e, 1 + e};
Physical Surface("z0") = Surface In BoundingBox {-e, -e, -e, 10 + e, 10 + e, e};
Physical Surface("z1") = Surface In BoundingBox {-e, -e, 1 - e, 10 + e, 10 + e, 1 + e};

// A bar of square section, 1 m x 1 m, that is bent to an eighth of a circle: its axis starts at the origin along x and
// curves to -y with a radius of 100 m, in the xy plane.
SetFactory("OpenCASCADE");
Rectangle(1) = {-0.5, -0.5, 0, 1, 1};
Rotate {{0, 1, 0}, {0, 0, 0}, Pi/2} {Surface{1};}
Extrude {{0, 0, 1}, {0, -100, 0}, -Pi/4} {Surface{1};}
x = 100*Sin(Pi/4);
y = -100*(1 - Cos(Pi/4));
Physical Volume("arc") = {1};
Physical Surface("root") = Surface In BoundingBox {-0.01, -1, -1, 0.01, 1, 1};
Physical Surface("tip") = Surface In BoundingBox {x - 0.51, y - 0.51, -1, x + 0.51, y + 0.51, 1};

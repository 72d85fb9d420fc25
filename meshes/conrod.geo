// A connecting rod with two bored eyes and a tapered I-section shank, in mm (length_unit: mm).
// x along the rod from the big eye's centre to the small one's, z along the bores.
SetFactory("OpenCASCADE");

length = 200;                                                 // between the bores' centres
big_bore = 24;    big_outer = 34;     big_half_width = 13;    // radii and half width of the big eye
small_bore = 11;  small_outer = 17.5; small_half_width = 11;  // dimensions of the small eye
big_y = 21;       big_z = 9.5;                                // half depth and half flange width of the shank at x = 0
small_y = 11.5;   small_z = 7;                                // and at x = length

// A block between x0 and x1 with half depth from y0 to y1, its lower face from za0 to za1, its upper one from zb0 to zb1.
Macro TaperedBlock
  p = newp;
  Point(p)     = {x0, -y0, za0}; Point(p + 1) = {x0, y0, za0}; Point(p + 2) = {x0, y0, zb0}; Point(p + 3) = {x0, -y0, zb0};
  Point(p + 4) = {x1, -y1, za1}; Point(p + 5) = {x1, y1, za1}; Point(p + 6) = {x1, y1, zb1}; Point(p + 7) = {x1, -y1, zb1};
  l = newl;
  For i In {0:3}
    Line(l + i) = {p + i, p + (i + 1) % 4};
    Line(l + 4 + i) = {p + 4 + i, p + 4 + (i + 1) % 4};
    Line(l + 8 + i) = {p + i, p + 4 + i};
  EndFor
  s = news;
  Curve Loop(s) = {l:l + 3};         Plane Surface(s) = {s};
  Curve Loop(s + 1) = {l + 4:l + 7}; Plane Surface(s + 1) = {s + 1};
  For i In {0:3}
    Curve Loop(s + 2 + i) = {l + i, l + 8 + (i + 1) % 4, -(l + 4 + i), -(l + 8 + i)};
    Plane Surface(s + 2 + i) = {s + 2 + i};
  EndFor
  Surface Loop(s) = {s:s + 5};
  block = newv;
  Volume(block) = {s};
Return

// Shank and eyes. The big eye is turned so that the seam of its outer cylinder lies away from the fillets.
x0 = 0; y0 = big_y; za0 = -big_z; zb0 = big_z;
x1 = length; y1 = small_y; za1 = -small_z; zb1 = small_z;
Call TaperedBlock;
shank = block;
big = newv;
Cylinder(big) = {0, 0, -big_half_width, 0, 0, 2 * big_half_width, big_outer};
Rotate{ {0, 0, 1}, {0, 0, 0}, Pi }{ Volume{big}; }
small = newv;
Cylinder(small) = {length, 0, -small_half_width, 0, 0, 2 * small_half_width, small_outer};
body() = BooleanUnion{ Volume{shank}; Delete; }{ Volume{big, small}; Delete; };

// Fillets between the shank and the eyes: along its flat faces, and along its narrow sides.
flat() = Curve In BoundingBox {20, -22, -9.99, 34.5, 22, -8.5};
flat() += Curve In BoundingBox {20, -22, 8.5, 34.5, 22, 9.99};
flat() += Curve In BoundingBox {182, -13, -7.5, 190, 13, -7};
flat() += Curve In BoundingBox {182, -13, 7, 190, 13, 7.5};
side() = Curve In BoundingBox {20, -22, -9.99, 34.5, -19, 9.99};
side() += Curve In BoundingBox {20, 19, -9.99, 34.5, 22, 9.99};
side() += Curve In BoundingBox {182, -13, -7.5, 190, -11, 7.5};
side() += Curve In BoundingBox {182, 11, -7.5, 190, 13, 7.5};
body() = Fillet{ body(0) }{ flat(), side() }{ 3, 3, 3, 3, 5, 5, 5, 5 };

// Two pockets make the I: a block with rounded corners and floor edges, and its mirror image.
x0 = 45; y0 = big_y + (small_y - big_y) * x0 / length - 4.5; za0 = 2.75; zb0 = 14;
x1 = 171; y1 = big_y + (small_y - big_y) * x1 / length - 3.2; za1 = 2.25; zb1 = 14;
Call TaperedBlock;
corner() = Curve In BoundingBox {x0 - .1, -y0 - .1, za0 - .1, x0 + .1, -y0 + .1, zb0 + .1};
corner() += Curve In BoundingBox {x0 - .1, y0 - .1, za0 - .1, x0 + .1, y0 + .1, zb0 + .1};
corner() += Curve In BoundingBox {x1 - .1, -y1 - .1, za1 - .1, x1 + .1, -y1 + .1, zb1 + .1};
corner() += Curve In BoundingBox {x1 - .1, y1 - .1, za1 - .1, x1 + .1, y1 + .1, zb1 + .1};
floor() = Curve In BoundingBox {x0 - .1, -y0 - .1, za1 - .1, x1 + .1, y0 + .1, za0 + .1};
pocket() = Fillet{ block }{ corner(), floor() }{ 5, 5, 5, 5, 2, 2, 2, 2 };
mirrored() = Symmetry{ 0, 0, 1, 0 }{ Duplicata{ Volume{pocket(0)}; } };

// Bores.
bore = newv;
Cylinder(bore) = {0, 0, -2 * big_half_width, 0, 0, 4 * big_half_width, big_bore};
Cylinder(bore + 1) = {length, 0, -2 * big_half_width, 0, 0, 4 * big_half_width, small_bore};
rod() = BooleanDifference{ Volume{body(0)}; Delete; }{ Volume{pocket(0), mirrored(0), bore, bore + 1}; Delete; };

Physical Volume("rod") = {rod(0)};
e = 0.1;
Physical Surface("bore_big") = Surface In BoundingBox {-big_bore - e, -big_bore - e, -big_half_width - e,
                                                       big_bore + e, big_bore + e, big_half_width + e};
Physical Surface("bore_small") = Surface In BoundingBox {length - small_bore - e, -small_bore - e, -small_half_width - e,
                                                         length + small_bore + e, small_bore + e, small_half_width + e};

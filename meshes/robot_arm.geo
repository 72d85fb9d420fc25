// The two links of a robot arm, in mm: plates with bosses, bores and a slot, drawn stretched along x in their places. y is the
// direction of the bores. The forearm lies in front of the upper arm.
SetFactory("OpenCASCADE");

// A plate from `left` over `length`, `high` and `wide`, its middle at y = `side`; a boss and a bore at either end; a slot.
Macro Link
  v = newv;
  Box(v) = {left, side - wide / 2, -high / 2, length, wide, high};
  Cylinder(v + 1) = {left, side - wide / 2, 0, 0, wide, 0, boss};
  Cylinder(v + 2) = {left + length, side - wide / 2, 0, 0, wide, 0, boss};
  plate() = BooleanUnion{ Volume{v}; Delete; }{ Volume{v + 1, v + 2}; Delete; };
  c = newv;
  Cylinder(c) = {left, side - wide, 0, 0, 2 * wide, 0, bore};
  Cylinder(c + 1) = {left + length, side - wide, 0, 0, 2 * wide, 0, bore};
  Box(c + 2) = {left + margin, side - wide, -slot, length - 2 * margin, 2 * wide, 2 * slot};
  Cylinder(c + 3) = {left + margin, side - wide, 0, 0, 2 * wide, 0, slot};
  Cylinder(c + 4) = {left + length - margin, side - wide, 0, 0, 2 * wide, 0, slot};
  link() = BooleanDifference{ Volume{plate()}; Delete; }{ Volume{c:c + 4}; Delete; };
Return

left = 0;   side = 0;  length = 600; high = 80; wide = 50; boss = 60; bore = 25; margin = 130; slot = 24;
Call Link;
left = 600; side = 50; length = 500; high = 60; wide = 40; boss = 45; bore = 18; margin = 105; slot = 17;
Call Link;

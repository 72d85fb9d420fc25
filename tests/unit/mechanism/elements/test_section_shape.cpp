// Shapes of cross sections: constants and stresses against closed forms, finer grids, and equilibrium.
#include <cmath>
#include <functional>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/elements/saint_venant.hpp"
#include "mechanism/elements/section_shape.hpp"

using namespace bielle::mechanism;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const double pi = 3.141592653589793;

std::unique_ptr<SectionShape> shape(const std::string& name, const std::string& dimensions) {
  return make_section_shape(name, read_shape_dimensions(name, bielle::YamlValue::parse(dimensions, "shape.yaml")));
}

/// Resultants (V_y, V_z, torque about the shear centre) of the shear stresses of unit V_y, V_z, torque: the identity.
/// @param integrate  over the section's area
Matrix3 resultants(const SectionShape& s,
                   const std::function<void(const std::function<void(double, Vector2)>&)>& integrate) {
  Matrix3 sum = Matrix3::Zero();
  integrate([&](double dA, const Vector2& p) {
    const Eigen::Matrix<double, 2, 3> tau = s.shear_stress(p);
    const Vector2 arm = p - s.constants().shear_centre;
    sum.topRows<2>() += dA * tau;
    sum.row(2) += dA * (arm.x() * tau.row(1) - arm.y() * tau.row(0));
  });
  return sum;
}

using Sum = std::function<void(double, Vector2)>;

/// Midpoint rule over the points of a box that the shape contains. Sides of the walls are multiples of the cells.
std::function<void(const Sum&)> over_cells(const SectionShape& s, const Vector2& low, const Vector2& high,
                                           double cell) {
  return [&s, low, high, cell](const Sum& add) {
    for (double y = low.x() + cell / 2; y < high.x(); y += cell)
      for (double z = low.y() + cell / 2; z < high.y(); z += cell)
        if (s.contains({y, z})) add(cell * cell, {y, z});
  };
}

/// The same rectangles on the program's grid and on one sixteen times as fine at the corners.
void check_against_finer_grid(const std::vector<SectionRectangle>& rectangles) {
  const SaintVenant usual(rectangles), fine(rectangles, {1.0 / 512, 1.3});
  const double size = std::sqrt(usual.area());
  CHECK(usual.J() > fine.J());
  CHECK_THAT(usual.J(), WithinRel(fine.J(), 2e-4));
  CHECK((usual.shear_compliance() - fine.shear_compliance()).cwiseAbs().maxCoeff() <
        2e-4 * fine.shear_compliance().cwiseAbs().maxCoeff());
  CHECK((usual.shear_centre() - fine.shear_centre()).norm() < 1e-4 * size);
}

}  // namespace

TEST_CASE("finite elements on a rectangle give Saint-Venant's torsion constant and shear factors") {
  for (double a : {1.0, 3.0, 10.0}) {
    const SaintVenant s({{0, a, 0, 1}});
    CHECK_THAT(s.J(), WithinRel(rectangle_constants(a, 1).J, 1.5e-4));
    CHECK_THAT(s.shear_compliance()(0, 0), WithinRel(1.2 / a, 2e-4));
    CHECK_THAT(s.shear_compliance()(1, 1), WithinRel(1.2 / a, 2e-4));
    CHECK(s.shear_centre().norm() < 1e-12);
    // Cut into two rectangles it is the same section.
    CHECK_THAT(SaintVenant({{0, a / 2, 0, 1}, {a / 2, a, 0, 1}}).J(), WithinRel(s.J(), 1e-4));
  }
}

TEST_CASE("the grid of sections made of walls is fine enough for an error of 2e-4") {
  check_against_finer_grid({{-50, 50, 0, 8}, {-2.5, 2.5, 8, 192}, {-50, 50, 192, 200}});  // i
  check_against_finer_grid({{-2.5, 2.5, 0, 92}, {-50, 50, 92, 100}});                     // t
  check_against_finer_grid({{0, 100, 0, 10}, {0, 10, 10, 60}});                           // l
  check_against_finer_grid({{0, 4, 0, 1}, {0, 4, 3, 4}, {0, 1, 1, 3}, {3, 4, 1, 3}});     // thick box
  check_against_finer_grid({{-50, 50, 0, 1}, {-.5, .5, 1, 199}, {-50, 50, 199, 200}});    // thin i
}

TEST_CASE("thin walls have the constants of the theory of thin walls") {
  // Walls of 1/100 of the height: what that theory neglects is of the order of 1 %.
  const SectionConstants box = shape("box", "{width: 60, height: 100, thickness: [0.5, 1]}")->constants();
  const double b = 59.5, h = 99;  // between the middles of the walls
  CHECK_THAT(box.J, WithinRel(4 * b * b * h * h / (2 * b / 1 + 2 * h / 0.5), 1e-2));  // Bredt
  const SectionConstants i = shape("i", "{width: 60, height: 101, web: 0.8, flange: 1}")->constants();
  CHECK_THAT(i.J, WithinRel((2 * 60 + 99 * 0.512) / 3, 1e-2));
  CHECK_THAT(i.A, WithinRel(120 + 99 * 0.8, 1e-14));
  CHECK_THAT(i.I_y, WithinRel((60 * std::pow(101, 3) - 59.2 * std::pow(99, 3)) / 12, 1e-13));
  CHECK_THAT(i.I_z, WithinRel((2 * std::pow(60, 3) + 99 * std::pow(0.8, 3)) / 12, 1e-13));
  // The energy of the shear flow q = V S/I: flanges S = h' s/2, web S = b h'/2 + (h'^2/4 - z^2)/2 t_w, h' = 100.
  const double hm = 100, I = 2 * 60 * hm * hm / 4 + 0.8 * std::pow(hm, 3) / 12;
  const double flanges = 4 * hm * hm / 4 * std::pow(30, 3) / 3;
  const auto web = [&](double z) { return std::pow(60 * hm / 2 + (hm * hm / 4 - z * z) / 2 * 0.8, 2) / 0.8; };
  const double energy = (flanges + hm / 6 * (web(-hm / 2) + 4 * web(0) + web(hm / 2))) / (I * I);  // web: about Simpson
  CHECK_THAT(i.shear_area(1, 1), WithinRel(1 / energy, 2e-2));
  CHECK(std::abs(i.shear_area(0, 1)) < 1e-9 * i.A);

  // Shear centres: of a t and an l where the middles of the walls meet; of an i of unequal flanges by their I_z.
  const SectionConstants t = shape("t", "{width: 60, height: 100, web: 1, flange: 1}")->constants();
  const double t_centroid = (99 * 49.5 + 60 * 99.5) / 159;
  CHECK_THAT(t.shear_centre.y(), WithinAbs(99.5 - t_centroid, 0.3));
  CHECK_THAT(t.shear_centre.x(), WithinAbs(0, 1e-9));
  const SectionConstants l = shape("l", "{width: 60, height: 100, thickness: 1}")->constants();
  const Vector2 l_centroid((60 * 30 + 99 * 0.5) / 159, (60 * 0.5 + 99 * 50.5) / 159);
  CHECK((l.shear_centre - (Vector2(0.5, 0.5) - l_centroid)).norm() < 0.3);
  const SectionConstants unequal = shape("i", "{width: [60, 40], height: 100, web: 1, flange: 1}")->constants();
  const double centroid = (60 * 0.5 + 98 * 50 + 40 * 99.5) / 198;
  CHECK_THAT(unequal.shear_centre.y(), WithinAbs(0.5 + 99 * 64.0 / (216 + 64) - centroid, 0.5));
}

TEST_CASE("an l has its principal axes where its product of inertia puts them") {
  // Equal legs: at 45 degrees, I_y = I_z; closed forms of two rectangles.
  const SectionConstants k = shape("l", "{width: 10, height: 10, thickness: 2}")->constants();
  const double e = (20 * 5 + 16 * 1) / 36.0;
  CHECK_THAT(k.I_z, WithinRel(2 * 1000 / 12.0 + 20 * (5 - e) * (5 - e) + 8 * 8 / 12.0 + 16 * (1 - e) * (1 - e), 1e-13));
  CHECK_THAT(k.I_y, WithinRel(k.I_z, 1e-13));
  CHECK_THAT(k.I_yz, WithinRel(20 * (5 - e) * (1 - e) + 16 * (1 - e) * (6 - e), 1e-13));
  CHECK_THAT(k.shear_area(0, 0), WithinRel(k.shear_area(1, 1), 1e-9));
  CHECK_THAT(k.shear_centre.x(), WithinRel(k.shear_centre.y(), 1e-9));
}

TEST_CASE("shear stresses add up to the shear forces and the torque that make them") {
  const auto check = [](const Matrix3& sum, double length, double tolerance) {
    const Matrix3 scaled = Vector3(1, 1, 1 / length).asDiagonal() * sum * Vector3(1, 1, length).asDiagonal();
    CAPTURE(scaled);
    CHECK((scaled - Matrix3::Identity()).cwiseAbs().maxCoeff() < tolerance);
  };
  const auto rectangle = shape("rectangle", "[2, 5]");
  check(resultants(*rectangle, over_cells(*rectangle, {-1, -2.5}, {1, 2.5}, 0.05)), 2, 2e-3);
  const auto flat = shape("rectangle", "[5, 2]");
  check(resultants(*flat, over_cells(*flat, {-2.5, -1}, {2.5, 1}, 0.05)), 2, 2e-3);
  for (const char* radii : {"[2, 1.2]", "[2, 0.001]"}) {
    const auto tube = shape("tube", radii);
    check(resultants(*tube,
                     [&](const Sum& add) {
                       const double ri = radii[4] == '1' ? 1.2 : 0.001, part = (2 - ri) / 200;
                       for (int i = 0; i < 200; ++i)
                         for (int j = 0; j < 64; ++j) {
                           const double r = ri + (i + 0.5) * part, phi = (j + 0.5) * pi / 32;
                           add(r * part * pi / 32, r * Vector2(std::cos(phi), std::sin(phi)));
                         }
                     }),
          2, 1e-4);
  }
  // The midpoint rule misses the peaks in the re-entrant corners.
  const auto l = shape("l", "{width: 5, height: 4, thickness: 1}");
  const Vector2 corner(-(5 * 2.5 + 3 * 0.5) / 8, -(5 * 0.5 + 3 * 2.5) / 8);
  check(resultants(*l, over_cells(*l, corner, corner + Vector2(5, 4), 0.05)), 2, 5e-3);
  const auto box = shape("box", "{width: 4, height: 5, thickness: [1, 0.5]}");
  check(resultants(*box, over_cells(*box, {-2, -2.5}, {2, 2.5}, 0.05)), 2, 5e-3);
}

TEST_CASE("stresses of shapes have their known largest values") {
  const auto at = [](const SectionShape& s, double y, double z) { return s.stress({y, z}, {0, 0}); };
  // Rectangle: bending M z/I, shear 3/2 V/A in the middle, torsion in the middle of the longer sides: T/(k a c^2),
  // k = 0.2082 for a square and 0.2459 for 2:1 (Timoshenko and Goodier, art. 109).
  const auto square = shape("rectangle", "[1, 1]");
  CHECK_THAT(at(*square, 0, 0)(1, 1), WithinRel(1.5, 1e-14));
  CHECK_THAT(at(*square, 0, 0.5)(0, 4), WithinRel(6.0, 1e-14));
  CHECK_THAT(at(*square, 0.5, 0)(0, 5), WithinRel(-6.0, 1e-14));
  CHECK_THAT(at(*square, 0, 0.5)(1, 3), WithinRel(-1 / 0.2082, 1e-3));
  CHECK_THAT(at(*square, 0.5, 0)(2, 3), WithinRel(1 / 0.2082, 1e-3));
  CHECK_THAT(at(*square, -0.5, 0)(2, 3), WithinRel(-1 / 0.2082, 1e-3));
  CHECK_THAT(at(*square, 0.5, 0.5).bottomRows<2>().cwiseAbs().maxCoeff(), WithinAbs(0, 1e-3));
  CHECK_THAT(at(*shape("rectangle", "[2, 1]"), 0, 0.5)(1, 3), WithinRel(-1 / (0.2459 * 2), 1e-3));
  CHECK_THAT(at(*shape("rectangle", "[1, 2]"), 0.5, 0)(2, 3), WithinRel(1 / (0.2459 * 2), 1e-3));
  // Circle without lateral contraction: 3/2 V/A in the middle; T r/J.
  const auto circle = shape("circle", "2");
  CHECK_THAT(at(*circle, 0, 0)(2, 2), WithinRel(1.5 / (4 * pi), 1e-14));
  CHECK_THAT(at(*circle, 0, 2)(1, 3), WithinRel(-2 / (8 * pi), 1e-14));
  CHECK_THAT(at(*circle, 0, 2)(2, 2), WithinAbs(0, 1e-15));
  // A thin tube: 2 V/A at the neutral axis.
  CHECK_THAT(at(*shape("tube", "[1, 0.999]"), 0.9995, 0)(2, 2), WithinRel(2 / (pi * (1 - 0.999 * 0.999)), 1e-3));
  // Thin walls: V S/(I t) in the middle of an i's web; Bredt's T/(2 A_m t) in a box.
  const auto i = shape("i", "{width: 60, height: 101, web: 0.8, flange: 1}");
  const double S = 60 * 50 + 0.8 * 49.5 * 49.5 / 2;
  CHECK_THAT(at(*i, 0, 0)(2, 2), WithinRel(S / i->constants().I_y / 0.8, 1e-2));
  const auto box = shape("box", "{width: 60, height: 100, thickness: [0.5, 1]}");
  CHECK_THAT(at(*box, 29.75, 0)(2, 3), WithinRel(1 / (2 * 59.5 * 99 * 0.5), 2e-2));
  CHECK_THAT(at(*box, 0, 49.5)(1, 3), WithinRel(-1 / (2 * 59.5 * 99 * 1), 2e-2));
}

TEST_CASE("the bending stress of an l follows its principal axes, and offsets move the axes of resultants") {
  const auto l = shape("l", "{width: 10, height: 10, thickness: 2}");
  const SectionConstants& k = l->constants();
  // Unsymmetric bending by M_y: sigma = M_y (I_z z - I_yz y)/(I_y I_z - I_yz^2).
  CHECK_THAT(l->stress({-2.5, 3}, {0, 0})(0, 4),
             WithinRel((k.I_z * 3 - k.I_yz * -2.5) / (k.I_y * k.I_z - k.I_yz * k.I_yz), 1e-13));
  const auto square = shape("rectangle", "[1, 2]");
  const Eigen::Matrix<double, 3, 6> beside = square->stress({0.5, 1}, {0.3, -0.2}),
                                    centred = square->stress({0.5, 1}, {0, 0});
  // Forces at the node line have the moment -o x n about the centroid o = (0, 0.3, -0.2).
  CHECK_THAT(beside(0, 0), WithinRel(centred(0, 0) + 0.2 * centred(0, 4) + 0.3 * centred(0, 5), 1e-13));
  CHECK((beside.col(1) - (centred.col(1) - 0.2 * centred.col(3))).norm() < 1e-13);
  CHECK((beside.col(2) - (centred.col(2) - 0.3 * centred.col(3))).norm() < 1e-13);
}

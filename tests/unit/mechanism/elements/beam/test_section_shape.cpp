// Shapes of cross sections: constants and stresses against closed forms, finer grids, and equilibrium.
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/beam/wall_taper.hpp"

using namespace bielle::mechanism;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using std::numbers::pi;

namespace {

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

/// Returns the midpoint rule over the points of a box that the shape contains. Sides of the walls are multiples of the
/// cells.
std::function<void(const Sum&)> over_cells(const SectionShape& s, const Vector2& low, const Vector2& high,
                                           double cell) {
  return [&s, low, high, cell](const Sum& add) {
    for (double y = low.x() + cell / 2; y < high.x(); y += cell)
      for (double z = low.y() + cell / 2; z < high.y(); z += cell)
        if (s.contains({y, z})) add(cell * cell, {y, z});
  };
}

Eigen::Matrix<double, 3, 6> stress(const SectionShape& s, const Vector2& point, const Vector2& offset = {0, 0}) {
  return unit_stress(s.constants(), point, offset, s.shear_stress(point));
}

/// The same rectangles are computed on the program's grid and on one that is sixteen times as fine at the corners.
void check_against_finer_grid(const std::vector<SectionRectangle>& rectangles) {
  const RectangleArea area(rectangles);
  const SaintVenant usual(area), fine(area, {1.0 / 512, 1.3});
  const double size = std::sqrt(area.area);
  CHECK(usual.J() > fine.J());
  CHECK_THAT(usual.J(), WithinRel(fine.J(), 2e-4));
  CHECK((usual.shear_compliance() - fine.shear_compliance()).cwiseAbs().maxCoeff() <
        2e-4 * fine.shear_compliance().cwiseAbs().maxCoeff());
  CHECK((usual.shear_centre() - fine.shear_centre()).norm() < 1e-4 * size);
}

}  // namespace

TEST_CASE("finite elements on a rectangle give Saint-Venant's torsion constant and shear factors") {
  for (double a : {1.0, 3.0, 10.0}) {
    const SaintVenant s(RectangleArea({{0, a, 0, 1}}));
    CHECK_THAT(s.J(), WithinRel(rectangle_constants(a, 1).J, 1.5e-4));
    CHECK_THAT(s.shear_compliance()(0, 0), WithinRel(1.2 / a, 2e-4));
    CHECK_THAT(s.shear_compliance()(1, 1), WithinRel(1.2 / a, 2e-4));
    CHECK(s.shear_centre().norm() < 1e-12);
    // The section remains the same if it is cut into two rectangles.
    CHECK_THAT(SaintVenant(RectangleArea({{0, a / 2, 0, 1}, {a / 2, a, 0, 1}})).J(), WithinRel(s.J(), 1e-4));
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
  // The walls are 1/100 of the height: the terms that the theory neglects are about 1 %.
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

TEST_CASE("thin walls go over into the theory of thin walls down to the thinnest that are accepted") {
  // The terms that the theory neglects are of the order of t/h: the deviation over t/h is the same at every thickness.
  const double b = 0.6, h = 1;                                       // between the middles of the walls
  const auto integral = [](const auto& f, double from, double to) {  // Gauss's rule is exact for a quartic; so is
                                                                     // Simpson's with two halves
    double sum = 0;
    constexpr int parts = 512;
    for (int k = 0; k < parts; ++k) {
      const double a = from + (to - from) * k / parts, c = from + (to - from) * (k + 1) / parts;
      sum += (c - a) / 6 * (f(a) + 4 * f(0.5 * (a + c)) + f(c));
    }
    return sum;
  };
  const auto deviations = [&](double t) {
    const std::string size = fmt::format("width: {:.17g}, height: {:.17g}", b, h + t);
    const SectionConstants i = shape("i", fmt::format("{{{}, web: {}, flange: {}}}", size, t, t))->constants();
    const SectionConstants box =
        shape("box", fmt::format("{{width: {:.17g}, height: {:.17g}, thickness: {}}}", b + t, h + t, t))->constants();
    const SectionConstants channel =
        shape("l", fmt::format("{{width: {:.17g}, height: {:.17g}, thickness: {}}}", h, h, t))->constants();
    // Shear flows of unit V: q = S/I, energy int q^2/t.
    const double I_i = t * (2 * b * h * h / 4 + h * h * h / 12), I_box = t * (2 * b * h * h / 4 + 2 * h * h * h / 12),
                 Iz_i = 2 * t * b * b * b / 12;
    const double flanges_i = 4 * integral([&](double s) { return std::pow(h / 2 * s * t, 2) / t; }, 0, b / 2);
    const double web_i =
        integral([&](double z) { return std::pow(b * t * h / 2 + (h * h / 4 - z * z) / 2 * t, 2) / t; }, -h / 2, h / 2);
    const double web_box = integral(
        [&](double z) { return 2 * std::pow(b * t * h / 4 + (h * h / 4 - z * z) / 2 * t, 2) / t; }, -h / 2, h / 2);
    const double across_i =
        integral([&](double y) { return 2 * std::pow((b * b / 4 - y * y) / 2 * t, 2) / t; }, -b / 2, b / 2);
    Eigen::VectorXd relative(8);
    relative << i.J / ((2 * b + h) * t * t * t / 3), box.J / (4 * b * b * h * h / (2 * (b + h) / t)),  // Bredt
        channel.J / (2 * h * t * t * t / 3), i.shear_area(1, 1) * (flanges_i + web_i) / (I_i * I_i),
        i.shear_area(0, 0) * across_i / (Iz_i * Iz_i), box.shear_area(1, 1) * (flanges_i + web_box) / (I_box * I_box),
        i.A / ((2 * b + h) * t), box.A / (2 * (b + h) * t);
    return Eigen::VectorXd(relative.array() - 1);
  };
  const double first = 1e-2;
  const Eigen::VectorXd slope = deviations(first) / first;
  CAPTURE(slope.transpose());
  CHECK(slope.cwiseAbs().maxCoeff() < 1.2);
  for (const double t : {1e-3, 3e-4, 1e-4, 3e-5, 1.0001 * SaintVenant::thinnest_part}) {
    const Eigen::VectorXd deviation = deviations(t);
    CAPTURE(t, deviation.transpose());
    // The shear areas converge with the grid as well: 2e-5 of the error of the finite elements is left.
    CHECK((deviation.array().abs() < 1.2 * t + 2e-5).all());
  }
}

TEST_CASE("stresses in the thinnest walls are those of the theory of thin walls") {
  const double t = 2e-5;
  const auto i = shape("i", fmt::format("{{width: 0.6, height: {:.17g}, web: {}, flange: {}}}", 1 + t, t, t));
  const SectionConstants& k = i->constants();
  // The torsional stress is T t/J on both faces of the web; the shear stress V S/(I t) is in its middle.
  CHECK_THAT(stress(*i, {t / 2, 0.1})(2, 3), WithinRel(t / k.J, 1e-3));
  CHECK_THAT(stress(*i, {-t / 2, -0.2})(2, 3), WithinRel(-t / k.J, 1e-3));
  CHECK_THAT(stress(*i, {0, 0})(2, 2), WithinRel((0.6 * t * 0.5 + t * 0.125) / k.I_y / t, 1e-3));
  const auto box = shape("box", fmt::format("{{width: {:.17g}, height: {:.17g}, thickness: {}}}", 0.6 + t, 1 + t, t));
  CHECK_THAT(stress(*box, {0.3, 0.1})(2, 3), WithinRel(1 / (2 * 0.6 * t), 1e-3));
}

TEST_CASE("walls that are too thin for the finite elements are refused with the way out") {
  for (const auto& [name, dimensions] :
       {std::pair{"i", "{width: 1, height: 1, web: 9e-6, flange: 0.1}"},
        {"i", "{width: 0.5, height: 1, web: 0.1, flange: [9e-6, 0.1]}"},
        {"t", "{width: 1, height: 1, web: 0.999995, flange: 0.1}"},  // the part that projects next to the web
        {"l", "{width: 1, height: 2, thickness: 1e-5}"},
        {"box", "{width: 1, height: 1, thickness: 1e-6}"},
        {"box", "{width: 1, height: 1, thickness: 0.499999}"}})  // the hollow
    CHECK_THROWS_WITH(shape(name, dimensions),
                      Catch::Contains("shape.yaml:1:") && Catch::Contains("thinnest part") && Catch::Contains("`EA`"));
  CHECK_NOTHROW(shape("i", "{width: 1, height: 1, web: 1.1e-5, flange: 1.1e-5}"));
}

TEST_CASE("sections along a taper of walls are those of solutions at the place, from a few solutions") {
  const auto check = [](const std::string& name, const std::string& from, const std::string& to, int most) {
    const auto dimensions = [&](const std::string& text) {
      return read_shape_dimensions(name, bielle::YamlValue::parse(text, "shape.yaml"));
    };
    const VectorX start = dimensions(from), end = dimensions(to);
    // The points are inside the walls, away from the corners: the web's middle and a flange of the i, and likewise of
    // the others.
    const Vector2 p0 = shape(name, from)->constants().shear_centre, p1 = shape(name, to)->constants().shear_centre;
    const bool corner = name == "l" || name == "t";  // the shear centre lies in the corner of the walls, inside
    VectorX points_start = VectorX::Zero(2), points_end = VectorX::Zero(2);
    if (corner) {
      points_start << 0.5 * p0.x(), 0.99 * p0.y();
      points_end << 0.5 * p1.x(), 0.99 * p1.y();
    }
    const bool inside = shape_contains(name, start, points_start) && shape_contains(name, end, points_end) &&
                        shape_contains(name, 0.5 * (start + end), 0.5 * (points_start + points_end));
    if (!inside) points_start = points_end = VectorX();
    const WallTaper taper(name, start, end, points_start, points_end);
    CAPTURE(name, from, to, taper.solutions());
    CHECK(taper.solutions() <= most);
    for (const double s : {0.0, 0.07, 0.31, 0.5, 0.68, 0.93, 1.0}) {
      const auto exact = make_section_shape(name, (1 - s) * start + s * end);
      const SectionConstants k = taper.at(s).constants, e = exact->constants();
      CAPTURE(s);
      CHECK_THAT(k.A, WithinRel(e.A, 1e-14));
      CHECK_THAT(k.I_y, WithinRel(e.I_y, 1e-13));
      CHECK_THAT(k.I_yz, WithinAbs(e.I_yz, 1e-13 * e.I_y));
      CHECK_THAT(k.J, WithinRel(e.J, 2e-4));  // the error of the finite elements, whose grid changes along the taper
      CHECK((k.shear_area - e.shear_area).norm() < 2e-4 * e.shear_area.norm());
      CHECK((k.shear_centre - e.shear_centre).norm() < 2e-4 * std::sqrt((e.I_y + e.I_z) / e.A));
      if (!inside) continue;
      const UnitShearStress tau = exact->shear_stress((1 - s) * points_start + s * points_end);
      CHECK((taper.at(s).shear_stress.front() - tau).norm() < 2e-3 * tau.norm());
    }
  };
  check("i", "{width: 60, height: 100, web: 0.8, flange: 1}", "{width: 40, height: 50, web: 0.8, flange: 1}", 9);
  check("i", "{width: [60, 40], height: 100, web: 8, flange: 10}", "{width: [20, 30], height: 40, web: 4, flange: 3}",
        17);
  check("t", "{width: 60, height: 100, web: 5, flange: 5}", "{width: 40, height: 40, web: 8, flange: 3}", 17);
  check("l", "{width: 60, height: 100, thickness: [5, 8]}", "{width: 40, height: 40, thickness: 5}", 17);
  check("box", "{width: 60, height: 100, thickness: 0.5}", "{width: 20, height: 30, thickness: 0.25}", 17);
  // The box is almost hollow at one end and almost full at the other, so that more solutions are needed.
  check("box", "{width: 60, height: 100, thickness: 0.01}", "{width: 20, height: 30, thickness: 9.99}", 33);
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

TEST_CASE("pairs of wall thicknesses belong to the walls that the manual says") {
  // l: first the leg along y; box: first the walls across y (the upright ones); i: first what is below.
  const SectionConstants l = shape("l", "{width: 5, height: 4, thickness: [1, 0.5]}")->constants();
  CHECK_THAT(l.A, WithinRel(5 * 1 + 3 * 0.5, 1e-14));
  const double z = (5 * 0.5 + 1.5 * 2.5) / 6.5;
  CHECK_THAT(l.I_y, WithinRel(5 / 12.0 + 5 * std::pow(z - 0.5, 2) + 0.5 * 27 / 12 + 1.5 * std::pow(z - 2.5, 2), 1e-13));
  const SectionConstants box = shape("box", "{width: 4, height: 5, thickness: [1, 0.5]}")->constants();
  CHECK_THAT(box.I_y, WithinRel((4 * 125 - 2 * 64) / 12.0, 1e-13));
  const auto i = shape("i", "{width: [4, 2], height: 5, web: 0.5, flange: [1, 0.5]}");
  const double middle = (4 * 0.5 + 3.5 * 0.5 * 2.75 + 1 * 4.75) / (4 + 1.75 + 1);
  CHECK(i->contains({2, 0.5 - middle}));
  CHECK(!i->contains({1.5, 4.75 - middle}));
}

TEST_CASE("stresses of unit resultants about the node line add up to these, off the centroid as well") {
  const auto l = shape("l", "{width: 5, height: 4, thickness: 1}");
  const Vector2 corner(-(5 * 2.5 + 3 * 0.5) / 8, -(5 * 0.5 + 3 * 2.5) / 8), offset(3, -2);
  Matrix6 sum = Matrix6::Zero();
  over_cells(*l, corner, corner + Vector2(5, 4), 0.05)([&](double dA, const Vector2& p) {
    const Eigen::Matrix<double, 3, 6> sigma = stress(*l, p, offset);
    const Vector2 arm = p + offset;
    sum.topRows<3>() += dA * sigma;
    sum.row(3) += dA * (arm.x() * sigma.row(2) - arm.y() * sigma.row(1));
    sum.row(4) += dA * arm.y() * sigma.row(0);
    sum.row(5) -= dA * arm.x() * sigma.row(0);
  });
  CAPTURE(sum);
  // The midpoint rule misses the peaks in the re-entrant corner.
  CHECK((sum - Matrix6::Identity()).cwiseAbs().maxCoeff() < 2e-2);
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
  const auto at = [](const SectionShape& s, double y, double z) { return stress(s, {y, z}); };
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
  CHECK_THAT(stress(*l, {-2.5, 3})(0, 4),
             WithinRel((k.I_z * 3 - k.I_yz * -2.5) / (k.I_y * k.I_z - k.I_yz * k.I_yz), 1e-13));
  const auto square = shape("rectangle", "[1, 2]");
  const Eigen::Matrix<double, 3, 6> beside = stress(*square, {0.5, 1}, {0.3, -0.2}),
                                    centred = stress(*square, {0.5, 1});
  // Forces at the node line have the moment -o x n about the centroid o = (0, 0.3, -0.2).
  CHECK_THAT(beside(0, 0), WithinRel(centred(0, 0) + 0.2 * centred(0, 4) + 0.3 * centred(0, 5), 1e-13));
  CHECK((beside.col(1) - (centred.col(1) - 0.2 * centred.col(3))).norm() < 1e-13);
  CHECK((beside.col(2) - (centred.col(2) - 0.3 * centred.col(3))).norm() < 1e-13);
}

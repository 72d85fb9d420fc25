#include "mechanism/elements/beam/section_shape.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <fmt/format.h>

#include "mechanism/reading/read_numbers.hpp"

namespace bielle::mechanism {

using std::numbers::pi;

SectionConstants rectangle_constants(double width_y, double height_z) {
  const double a = std::max(width_y, height_z), c = std::min(width_y, height_z);
  double sum = 0;
  // Terms decrease like n^-5: beyond n = 2001 the rest is below 1e-15 of the first.
  for (int n = 2001; n >= 1; n -= 2) sum += std::tanh(n * pi * a / (2 * c)) / std::pow(n, 5);
  SectionConstants k;
  k.A = a * c;
  k.I_y = width_y * std::pow(height_z, 3) / 12;
  k.I_z = height_z * std::pow(width_y, 3) / 12;
  k.J = a * c * c * c * (1.0 / 3 - 64 / std::pow(pi, 5) * (c / a) * sum);
  k.shear_area = 5.0 / 6 * k.A * Matrix2::Identity();
  return k;
}

SectionConstants tube_constants(double outer_radius, double inner_radius) {
  const double ro2 = outer_radius * outer_radius, ri2 = inner_radius * inner_radius, m2 = ri2 / ro2;
  SectionConstants k;
  k.A = pi * (ro2 - ri2);
  k.I_y = k.I_z = k.A * (ro2 + ri2) / 4;
  k.J = 2 * k.I_y;
  k.shear_area = 6 * (1 + m2) * (1 + m2) / (7 + 34 * m2 + 7 * m2 * m2) * k.A * Matrix2::Identity();
  return k;
}

// With kappa = I^-1 (M_y, M_z) per E about the centroid:  sigma = N/A + kappa_y z - kappa_z y,
//   (M_y, M_z) = [I_y -I_yz; -I_yz I_z] kappa,   M_c = M - o x n,   torque about the shear centre (M - (o + s) x n)_x.
Eigen::Matrix<double, 3, 6> unit_stress(const SectionConstants& k, const Vector2& point, const Vector2& o,
                                        const UnitShearStress& shear_stress) {
  Matrix2 I;
  I << k.I_y, -k.I_yz, -k.I_yz, k.I_z;
  Eigen::Matrix<double, 2, 6> bending = Eigen::Matrix<double, 2, 6>::Zero();  // (M_y, M_z) about the centroid
  bending.col(0) << -o.y(), o.x();
  bending.rightCols<2>().setIdentity();
  Eigen::Matrix<double, 3, 6> shear = Eigen::Matrix<double, 3, 6>::Zero();  // V_y, V_z, torque about the shear centre
  const Vector2 s = o + k.shear_centre;
  shear(0, 1) = shear(1, 2) = shear(2, 3) = 1;
  shear(2, 1) = s.y();
  shear(2, 2) = -s.x();
  Eigen::Matrix<double, 3, 6> map;
  map.row(0) = Eigen::RowVector2d(point.y(), -point.x()) * I.inverse() * bending;
  map(0, 0) += 1 / k.A;
  map.bottomRows<2>() = shear_stress * shear;
  return map;
}

namespace {

/// Points outside by less than this, relative to the size, count as on the boundary.
constexpr double slack = 1e-9;

class Rectangle : public SectionShape {
 public:
  explicit Rectangle(const VectorX& d) : SectionShape(rectangle_constants(d[0], d[1])), b_(d[0]), h_(d[1]) {}

  bool contains(const Vector2& p) const override {
    return std::abs(p.x()) <= (0.5 + slack) * b_ && std::abs(p.y()) <= (0.5 + slack) * h_;
  }

  // Torsion by Prandtl's function phi, tau = (phi_z, -phi_y), with u along the longer side a and w along the shorter
  // side c:
  //   phi = c^2/4 - w^2 - (8 c^2/pi^3) sum_{n odd} (-1)^((n-1)/2)/n^3 cosh(n pi u/c)/cosh(n pi a/(2c)) cos(n pi w/c)
  UnitShearStress shear_stress(const Vector2& p) const override {
    const bool upright = h_ > b_;
    const double a = upright ? h_ : b_, c = upright ? b_ : h_;
    const double u = std::abs(upright ? p.y() : p.x()), w = upright ? p.x() : p.y();
    double phi_u = 0, phi_w = -2 * w;
    int sign = 1;
    for (int n = 1; n <= 20001; n += 2, sign = -sign) {
      const double k = n * pi / c, low = std::exp(-2 * k * u),
                   decay = std::exp(k * (u - a / 2)) / (1 + std::exp(-k * a));
      if (decay < 1e-18) break;
      const double amplitude = sign * 8 * c / (pi * pi * n * n) * decay;
      phi_u -= amplitude * (1 - low) * std::cos(k * w);
      phi_w += amplitude * (1 + low) * std::sin(k * w);
    }
    if ((upright ? p.y() : p.x()) < 0) phi_u = -phi_u;
    const SectionConstants& k = constants();
    UnitShearStress tau = UnitShearStress::Zero();
    tau(0, 0) = 1.5 / k.A * (1 - 4 * p.x() * p.x() / (b_ * b_));
    tau(1, 1) = 1.5 / k.A * (1 - 4 * p.y() * p.y() / (h_ * h_));
    tau.col(2) = Vector2(upright ? phi_u : phi_w, upright ? -phi_w : -phi_u) / k.J;
    return tau;
  }

 private:
  double b_, h_;
};

class Tube : public SectionShape {
 public:
  Tube(double outer, double inner) : SectionShape(tube_constants(outer, inner)), ro_(outer), ri_(inner) {}

  bool contains(const Vector2& p) const override {
    return p.norm() <= (1 + slack) * ro_ && p.norm() >= (1 - slack) * ri_;
  }

  // Phi = -(1/I) (r^3/8 + A r + B/r) cos phi with Phi_r = 0 at both radii: B = -3/8 ri^2 ro^2, A = -3/8 (ri^2 + ro^2);
  // in y and z, along the force e:  Phi = -(1/I) g(r^2) e.x,  g = r^2/8 + A + B/r^2.
  UnitShearStress shear_stress(const Vector2& p) const override {
    const double r2 = p.squaredNorm(), A = -0.375 * (ri_ * ri_ + ro_ * ro_), B = -0.375 * ri_ * ri_ * ro_ * ro_;
    const double hole = ri_ > 0 ? B / r2 : 0, g = r2 / 8 + A + hole;
    const double slope = 0.125 - (ri_ > 0 ? hole / r2 : 0);  // dg/d(r^2)
    UnitShearStress tau;
    tau.leftCols<2>() = -(g * Matrix2::Identity() + 2 * slope * p * p.transpose()) / constants().I_y;
    tau.col(2) = Vector2(-p.y(), p.x()) / constants().J;
    return tau;
  }

 private:
  double ro_, ri_;
};

class Walls : public SectionShape {
 public:
  explicit Walls(const RectangleArea& area) : Walls(area, SaintVenant(area)) {}
  bool contains(const Vector2& p) const override { return area_.contains(p); }
  UnitShearStress shear_stress(const Vector2& p) const override { return solution_.shear_stress(p); }

 private:
  Walls(const RectangleArea& area, SaintVenant solution)
      : SectionShape(wall_constants(area, solution)), area_(area), solution_(std::move(solution)) {}
  RectangleArea area_;
  SaintVenant solution_;
};

/// Returns the rectangles of i [width below, above, height, web, flange below, above], t [width, height, web, flange],
/// l [width, height, thickness of the leg along y, along z], box [width, height, thickness of the walls across y,
/// across z].
std::vector<SectionRectangle> walls(const std::string& shape, const VectorX& d) {
  if (shape == "i")
    return {{-d[0] / 2, d[0] / 2, 0, d[4]},
            {-d[3] / 2, d[3] / 2, d[4], d[2] - d[5]},
            {-d[1] / 2, d[1] / 2, d[2] - d[5], d[2]}};
  if (shape == "t") return {{-d[2] / 2, d[2] / 2, 0, d[1] - d[3]}, {-d[0] / 2, d[0] / 2, d[1] - d[3], d[1]}};
  if (shape == "l") return {{0, d[0], 0, d[2]}, {0, d[3], d[2], d[1]}};
  return {{0, d[0], 0, d[3]},
          {0, d[0], d[1] - d[3], d[1]},
          {0, d[2], d[3], d[1] - d[3]},
          {d[0] - d[2], d[0], d[3], d[1] - d[3]}};
}

/// Reads a number for both, or a pair.
Vector2 one_or_two(const YamlValue& value, const std::string& pair) {
  if (value.is_scalar()) return Vector2::Constant(value.number());
  return read_numbers(value, 2, "a number or a pair " + pair);
}

VectorX read_walls(const std::string& shape, const YamlValue& value) {
  VectorX d(6);
  const double height = value.at("height").number();
  const auto check = [&](const char* key, bool fits, const char* why) {
    if (!fits) value.at(key).fail(why);
  };
  if (shape == "i") {
    const Vector2 width = one_or_two(value.at("width"), "[below, above]"),
                  flange = one_or_two(value.at("flange"), "[below, above]");
    const double web = value.at("web").number();
    d << width, height, web, flange;
    check("web", d[3] < width.minCoeff(), "the web must be thinner than the flanges are wide");
    check("flange", flange.sum() < height, "the flanges must leave room for a web within the height");
    return d;
  }
  if (shape == "t") {
    const double width = value.at("width").number(), web = value.at("web").number(),
                 flange = value.at("flange").number();
    d << width, height, web, flange, 0, 0;
    check("web", d[2] < d[0], "the web must be thinner than the flange is wide");
    check("flange", d[3] < height, "the flange must leave room for a web within the height");
    return d.head<4>();
  }
  const Vector2 thickness = one_or_two(
      value.at("thickness"), shape == "l" ? "[leg along y, leg along z]" : "[walls across y, walls across z]");
  const double width = value.at("width").number();
  d << width, height, thickness, 0, 0;
  if (shape == "l")
    check("thickness", thickness[0] < height && thickness[1] < d[0],
          "the legs must be thinner than the section is wide and high");
  else
    check("thickness", 2 * thickness[0] < d[0] && 2 * thickness[1] < height, "the walls must leave a hollow inside");
  return d.head<4>();
}

/// Throws if a wall, or a part that projects from one, is too thin for the finite elements.
void check_thin_parts(const YamlValue& value, const RectangleArea& area) {
  const double part = area.thinnest_part();
  if (part < SaintVenant::thinnest_part)
    value.fail(
        fmt::format("its thinnest part (a wall, or a part that projects from one) is {:.2g} of the section's size, "
                    "and below {:.0e} its torsion and shear cannot be computed: give the section by its "
                    "constants `EA`, `GAy`, ...",
                    part, SaintVenant::thinnest_part));
}

}  // namespace

const std::vector<std::string>& section_shape_names() {
  static const std::vector<std::string> names = {"rectangle", "circle", "tube", "i", "t", "l", "box"};
  return names;
}

namespace {

/// Permitted lengths [m]: fourth powers of such lengths can be represented.
constexpr double least_size = 1e-12, most_size = 1e6;

[[noreturn]] void refuse_size(const YamlValue& value, double size) {
  value.fail(
      fmt::format("expected lengths in metres from {:.0e} to {:.0e}, found {:.6g}", least_size, most_size, size));
}

VectorX read_sizes(const std::string& shape, const YamlValue& value) {
  if (shape == "rectangle") return read_numbers(value, 2, "[width_y, height_z]");
  if (shape == "circle") return VectorX::Constant(1, value.number());
  if (shape == "tube") {
    const VectorX radii = read_numbers(value, 2, "[outer radius, inner radius]");
    if (radii[1] >= radii[0]) value.fail("the inner radius must be smaller than the outer one");
    return radii;
  }
  return read_walls(shape, value);
}

}  // namespace

VectorX read_shape_dimensions(const std::string& shape, const YamlValue& value) {
  VectorX dimensions = read_sizes(shape, value);
  if (dimensions.maxCoeff() > most_size) refuse_size(value, dimensions.maxCoeff());
  if (is_made_of_walls(shape)) check_thin_parts(value, wall_area(shape, dimensions));
  for (const double size : dimensions)
    // A zero marks a dimension that the shape does not have.
    if (size != 0 && size < least_size) refuse_size(value, size);
  return dimensions;
}

bool shape_contains(const std::string& shape, const VectorX& d, const Vector2& point) {
  return is_made_of_walls(shape) ? wall_area(shape, d).contains(point) : make_section_shape(shape, d)->contains(point);
}

Vector2 shape_reach(const std::string& shape, const VectorX& d) {
  if (shape == "rectangle") return d.head<2>() / 2;
  if (!is_made_of_walls(shape)) return Vector2::Constant(d[0]);
  Vector2 reach = Vector2::Zero();
  for (const SectionRectangle& wall : wall_area(shape, d).rectangles)
    reach = reach.cwiseMax(Vector2(std::max(-wall.y0, wall.y1), std::max(-wall.z0, wall.z1)));
  return reach;
}

double shear_of_twist(const std::string& shape, const VectorX& d, const SectionConstants& k) {
  if (is_made_of_walls(shape)) return std::sqrt(2 * k.J / k.A);
  if (shape != "rectangle") return d[0];
  const Vector2 middle_of_long_side = d[0] > d[1] ? Vector2(0, d[1] / 2) : Vector2(d[0] / 2, 0);
  return k.J * Rectangle(d).shear_stress(middle_of_long_side).col(2).norm();
}

bool is_made_of_walls(const std::string& shape) {
  return shape == "i" || shape == "t" || shape == "l" || shape == "box";
}

RectangleArea wall_area(const std::string& shape, const VectorX& dimensions) {
  return RectangleArea(walls(shape, dimensions));
}

SectionConstants wall_constants(const RectangleArea& area, const SaintVenant& s) {
  return {area.area, area.I(1, 1), area.I(0, 0), area.I(0, 1), s.J(), s.shear_compliance().inverse(), s.shear_centre()};
}

std::unique_ptr<SectionShape> make_section_shape(const std::string& shape, const VectorX& d) {
  if (shape == "rectangle") return std::make_unique<Rectangle>(d);
  if (shape == "circle") return std::make_unique<Tube>(d[0], 0);
  if (shape == "tube") return std::make_unique<Tube>(d[0], d[1]);
  return std::make_unique<Walls>(wall_area(shape, d));
}

}  // namespace bielle::mechanism

// Rigid bodies and point masses in the mechanism file, and the checks that a mass distribution must pass.
#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "mechanism/elements/rigid_body.hpp"

namespace bielle::mechanism {
namespace {

Matrix3 symmetric(double xx, double yy, double zz, double xy, double xz, double yz) {
  Matrix3 J;
  J << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return J;
}

/// Three principal values, six entries of the symmetric tensor, or 3x3.
Matrix3 inertia_entries(const YamlValue& value) {
  const std::string expected =
      "expected the inertia tensor about the centre of mass as [xx, yy, zz], [xx, yy, zz, xy, xz, yz] or three rows of "
      "three";
  if (!value.is_sequence()) value.fail(expected);
  if (value.size() == 6) {
    const Eigen::VectorXd e = value.vector();
    return symmetric(e[0], e[1], e[2], e[3], e[4], e[5]);
  }
  if (value.size() != 3) value.fail(expected);
  if (!value.at(std::size_t{0}).is_sequence()) {
    const Vector3 e = value.vector3();
    return symmetric(e[0], e[1], e[2], 0, 0, 0);
  }
  const Matrix3 J = value.matrix(3, 3);
  if (!(J - J.transpose()).isZero(1e-9 * J.cwiseAbs().maxCoeff())) value.fail("an inertia tensor is symmetric");
  return 0.5 * (J + J.transpose());
}

/// A distribution of positive mass has principal moments > 0 of which none exceeds the sum of the two others. Moments
/// of thin plates and rods lie on that bound and are rounded in input files, hence the margin.
Matrix3 read_inertia(const YamlValue& value) {
  const Matrix3 J = inertia_entries(value);
  const Vector3 p = Eigen::SelfAdjointEigenSolver<Matrix3>(J, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string found = fmt::format("its principal moments are {:.6g}, {:.6g} and {:.6g} kg m^2", p[0], p[1], p[2]);
  if (!(p[0] > 0)) value.fail("the inertia tensor must be positive definite; " + found);
  if (p[2] > (p[0] + p[1]) * (1 + 1e-3))
    value.fail("no body has this inertia: the largest principal moment exceeds the sum of the two others; " + found +
               ". Is the tensor about the centre of mass, and are the products of inertia entries of the tensor?");
  return J;
}

Vector3 lengths3(const YamlValue& value, const std::string& expected) {
  if (!value.is_sequence() || value.size() != 3) value.fail(expected);
  for (const YamlValue& item : value.items()) item.positive_number();
  return value.vector3();
}

/// A homogeneous solid about its centre: `box: [a, b, c]` edges along x y z, `sphere: r`, `cylinder: [r, length]` and
/// `tube: [outer, inner, length]` about z.
MassProperties read_solid(const YamlValue& solid) {
  const std::vector<std::string> shapes = {"box", "sphere", "cylinder", "tube"};
  std::vector<std::string> keys = shapes;
  keys.emplace_back("density");
  solid.check_keys(keys, "a solid");
  const auto given = std::count_if(shapes.begin(), shapes.end(), [&](const std::string& s) { return solid.has(s); });
  if (given != 1) solid.fail("expected exactly one of 'box', 'sphere', 'cylinder', 'tube'");
  const double density = solid.at("density").positive_number();
  MassProperties p;
  const auto tube = [&](double outer, double inner, double length) {
    p.mass = density * std::numbers::pi * (outer * outer - inner * inner) * length;
    const double polar = 0.5 * p.mass * (outer * outer + inner * inner);
    const double across = 0.5 * polar + p.mass * length * length / 12;
    p.inertia = symmetric(across, across, polar, 0, 0, 0);
  };
  if (const auto box = solid.find("box")) {
    const Vector3 e = lengths3(*box, "expected three edges [a, b, c]");
    p.mass = density * e.prod();
    const Vector3 s = p.mass / 12 * e.cwiseAbs2();
    p.inertia = symmetric(s.y() + s.z(), s.x() + s.z(), s.x() + s.y(), 0, 0, 0);
  } else if (const auto sphere = solid.find("sphere")) {
    const double r = sphere->positive_number();
    p.mass = density * 4 / 3 * std::numbers::pi * r * r * r;
    p.inertia = 0.4 * p.mass * r * r * Matrix3::Identity();
  } else if (const auto cylinder = solid.find("cylinder")) {
    if (!cylinder->is_sequence() || cylinder->size() != 2) cylinder->fail("expected [radius, length]");
    tube(cylinder->at(std::size_t{0}).positive_number(), 0, cylinder->at(std::size_t{1}).positive_number());
  } else {
    const YamlValue value = solid.at("tube");
    const Vector3 e = lengths3(value, "expected [outer radius, inner radius, length]");
    if (e[1] >= e[0]) value.fail("the inner radius must be smaller than the outer one");
    tube(e[0], e[1], e[2]);
  }
  return p;
}

/// Further nodes that the body carries: they follow its node and must not be held or carried otherwise.
void carry(const YamlValue& also, int carrier, const std::string& body, Model& model) {
  for (const YamlValue& item : also.items()) {
    const int index = model.node_named_by(item);
    Node& node = model.node(index);
    if (index == carrier) item.fail(fmt::format("'{}' is the body's own node; `also` lists further nodes", node.name));
    if (node.carrier)
      item.fail(fmt::format("node '{}' is carried by node '{}' already", node.name, model.node(*node.carrier).name));
    const bool held =
        std::any_of(node.freedom.begin(), node.freedom.end(), [](Freedom f) { return f != Freedom::free; });
    if (held) item.fail(fmt::format("node '{}' is fixed or moved, so '{}' cannot carry it", node.name, body));
    if (!node.velocity.isZero() || !node.angular_velocity.isZero())
      item.fail(fmt::format("node '{}' is given a velocity, but moves with node '{}': give that one the velocity",
                            node.name, model.node(carrier).name));
    for (std::optional<int> above = model.node(carrier).carrier; above; above = model.node(*above).carrier)
      if (*above == index)
        item.fail(fmt::format("node '{}' carries '{}' already: bodies cannot carry each other in a circle", node.name,
                              model.node(carrier).name));
    node.carrier = carrier;
  }
}

}  // namespace

void read_rigid_body(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"type", "node", "mass", "centre", "inertia", "solid", "also"}, "a rigid_body");
  const int node = model.node_named_by(entry.at("node"));
  MassProperties p;
  if (const auto solid = entry.find("solid")) {
    for (const char* key : {"mass", "inertia"})
      if (const auto other = entry.find(key)) other->fail("give either `solid` or `mass` and `inertia`");
    p = read_solid(*solid);
  } else {
    p.mass = entry.at("mass").positive_number();
    p.inertia = read_inertia(entry.at("inertia"));
  }
  if (const auto centre = entry.find("centre")) p.centre = centre->vector3();
  if (const auto also = entry.find("also")) carry(*also, node, name, model);
  model.add(std::make_unique<RigidBody>("rigid_body", name, node, p), "elements/" + name);
}

void read_point_mass(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"type", "node", "mass"}, "a point_mass");
  MassProperties p;
  p.mass = entry.at("mass").positive_number();
  model.add(std::make_unique<RigidBody>("point_mass", name, model.node_named_by(entry.at("node")), p),
            "elements/" + name);
}

}  // namespace bielle::mechanism

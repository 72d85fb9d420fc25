// Bodies and requests for the tests of the reduction.
#pragma once

#include "reduce/reduction/fixed_interface_body.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"

namespace bielle::test {

inline reduce::Material steel() { return reduce::Material::isotropic(210e9, 0.3, 7800); }

/// Returns the solid of a mesh of steel.
inline reduce::Solid steel_solid(const reduce::Mesh& mesh) {
  return make_solid(mesh, {{"steel", steel()}}, {{"all", "steel"}});
}

inline reduce::InterfaceRequest interface(const std::string& name, const std::string& group, reduce::Tie tie) {
  reduce::InterfaceRequest request;
  request.name = name;
  request.group = group;
  request.tie = tie;
  request.subject = "interfaces." + name;
  return request;
}

/// Returns a steel body with interfaces "a" on x0 and "b" on x1.
inline reduce::ReductionOptions steel_body(reduce::Tie a, reduce::Tie b, int modes = 0) {
  reduce::ReductionOptions options;
  options.name = "box";
  options.materials = {{"steel", steel()}};
  options.regions = {{"all", "steel"}};
  options.interfaces = {interface("a", "x0", a), interface("b", "x1", b)};
  options.modes.count = modes;
  return options;
}

/// Returns a point that follows the mean of a surface.
inline reduce::PointRequest point_on(const std::string& name, const std::string& group) {
  reduce::PointRequest request;
  request.name = name;
  request.group = group;
  request.subject = "points." + name;
  return request;
}

/// Returns a point at a place in the mesh.
inline reduce::PointRequest point_at(const std::string& name, const Eigen::Vector3d& place) {
  reduce::PointRequest request = point_on(name, "");
  request.position = place;
  return request;
}

/// Returns a short twisted block. It has no symmetry that could hide an error, and is well conditioned.
inline reduce::Mesh twisted_block() {
  return box_mesh({{0.4, 0.1, 0.15}, {5, 2, 2}}, [](const Eigen::Vector3d& x) {
    const double angle = 1.5 * x.x();
    const Eigen::Vector3d r(0, x.y() - 0.05, x.z() - 0.03);
    return Eigen::Vector3d(x.x() + 0.1 * x.y(), std::cos(angle) * r.y() - std::sin(angle) * r.z(),
                           std::sin(angle) * r.y() + std::cos(angle) * r.z() + 0.2 * x.x() * x.x());
  });
}

inline reduce::FixedInterfaceBody held_body(const reduce::Solid& solid, const reduce::Ties& ties) {
  reduce::HeldFreedoms freedoms(solid, ties);
  const auto matrices = reduce::assembled_matrices(solid, freedoms.interior(), 2);
  return {std::move(freedoms), solid, *matrices, ties, 2};
}

inline Superelement reduced(const reduce::Mesh& mesh, const reduce::ReductionOptions& options,
                            reduce::ReductionReport* report = nullptr) {
  Progress quiet(true);
  return reduce::reduce_body(mesh, options, quiet, 2, report);
}

}  // namespace bielle::test

// Straight and curved bars of solid elements, reduced, and the geometrically exact beam of the same stiffness.
//
// Square section 1 x 1, E = 1e7, nu = 0, along x from the origin; curved ones turn to -y on a circle of radius 100.
// Rigid ties at the ends stiffen a piece against shear and torsion by a few per cent. That is an effect of the mesh and
// not of large deformation: the beam of comparison gets the section, EA, GA, GJ, EI, whose flexibility is nearest to
// that of the reduced piece.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/list_of_numbers.hpp"

namespace bielle::test {

using mechanism::Matrix3;
using mechanism::Matrix6;
using mechanism::Vector3;

/// Point and direction of the axis at a distance s from its start. @param radius  of the circle; 0: straight
struct BarAxis {
  double radius = 0;
  double angle(double s) const { return radius > 0 ? s / radius : 0; }
  Vector3 point(double s) const {
    const double a = angle(s);
    return radius > 0 ? Vector3(radius * std::sin(a), -radius * (1 - std::cos(a)), 0) : Vector3(s, 0, 0);
  }
  Matrix3 rotation(double s) const { return mechanism::exp_so3(Vector3(0, 0, -angle(s))); }
};

struct SolidBar {
  BarAxis axis;
  double length = 16;
  int modes = 12;
  int elements = 24;  ///< along the bar

  Superelement reduced() const {
    const Box box{{length, 1, 1}, {elements, 2, 2}};
    const reduce::Mesh mesh = box_mesh(box, [&](const Vector3& X) -> Vector3 {
      return axis.point(X.x()) + axis.rotation(X.x()) * Vector3(0, X.y() - 0.5, X.z() - 0.5);
    });
    reduce::ReductionOptions options;
    options.name = "bar";
    options.materials = {{"m", reduce::Material::isotropic(1e7, 0, 1000)}};
    options.regions = {{"all", "m"}};
    options.modes.count = modes;
    for (const auto& [name, group, s] : {std::tuple{"root", "x0", 0.0}, {"tip", "x1", length}}) {
      reduce::InterfaceRequest request;
      request.name = name;
      request.group = group;
      request.tie = reduce::Tie::rigid;
      request.position = axis.point(s);
      options.interfaces.push_back(request);
    }
    Progress quiet(true);
    return reduce::reduce_body(mesh, options, quiet, 2);
  }

  /// Returns the flexibility of the tip, root clamped, body axes, by unit compliances 1/EA, 1/GA, 1/GJ, 1/EI of the
  /// section.
  std::array<Matrix6, 4> flexibilities() const {
    std::array<Matrix6, 4> result;
    for (Matrix6& F : result) F.setZero();
    constexpr int points = 400;
    for (int k = 0; k < points; ++k) {
      const double s = length * (k + 0.5) / points;
      Matrix6 T = Matrix6::Zero();  // resultants at s from the load on the tip
      const Matrix3 Rt = axis.rotation(s).transpose();
      T.topLeftCorner<3, 3>() = T.bottomRightCorner<3, 3>() = Rt;
      T.bottomLeftCorner<3, 3>() = Rt * mechanism::skew(axis.point(length) - axis.point(s));
      for (int row = 0; row < 6; ++row)
        result[std::array{0, 1, 1, 2, 3, 3}[static_cast<std::size_t>(row)]] +=
            length / points * T.row(row).transpose() * T.row(row);
    }
    return result;
  }

  /// "{EA: .., ..}" of the section nearest to a reduced bar.
  std::string fitted_section(const Superelement& body) const {
    const Matrix6 flexibility = Matrix6(body.stiffness.block<6, 6>(6, 6)).inverse();
    const mechanism::Vector6 scale = flexibility.diagonal().cwiseSqrt().cwiseInverse();
    const auto column = [&](const Matrix6& F) -> Eigen::VectorXd {
      return Matrix6(scale.asDiagonal() * F * scale.asDiagonal()).reshaped();
    };
    Eigen::MatrixXd columns(36, 4);
    const auto units = flexibilities();
    for (int i = 0; i < 4; ++i) columns.col(i) = column(units[static_cast<std::size_t>(i)]);
    const Eigen::Vector4d c = columns.colPivHouseholderQr().solve(column(flexibility));
    return fmt::format("{{EA: {:.17g}, GAy: {:.17g}, GAz: {:.17g}, GJ: {:.17g}, EIy: {:.17g}, EIz: {:.17g}}}", 1 / c[0],
                       1 / c[1], 1 / c[1], 1 / c[2], 1 / c[3], 1 / c[3]);
  }
};

/// Returns the nodes n0 (held) to n<pieces> along an axis, with the same superelement between each two of them.
inline std::string chain_of_pieces(const SolidBar& piece, int pieces, const std::string& file) {
  std::string nodes = "nodes:\n", elements = "elements:\n";
  for (int k = 0; k <= pieces; ++k)
    nodes += fmt::format("  n{}: {{position: {}{}}}\n", k, list(piece.axis.point(k * piece.length)),
                         k == 0 ? ", fixed: true" : "");
  for (int k = 0; k < pieces; ++k)
    elements += fmt::format(
        "  e{}: {{type: superelement, file: {}, position: {}, rotation_vector: [0, 0, {:.17g}], nodes: {{root: n{}, "
        "tip: "
        "n{}}}}}\n",
        k, file, list(piece.axis.point(k * piece.length)), -piece.axis.angle(k * piece.length), k, k + 1);
  return nodes + elements;
}

/// Returns the whole as a beam from n0 (held) to tip.
inline std::string exact_beam(const BarAxis& axis, double length, const std::string& section, int elements) {
  return fmt::format(
      "nodes: {{n0: {{fixed: true}}, tip: {{position: {}}}}}\n"
      "elements: {{b: {{type: beam, nodes: [n0, tip]{}, orientation: [0, 1, 0], elements: {}, section: {}}}}}\n",
      list(axis.point(length)), axis.radius > 0 ? fmt::format(", arc_centre: [0, {:.17g}, 0]", -axis.radius) : "",
      elements, section);
}

inline std::string tip_load(const std::string& node, const Vector3& force, const Vector3& moment) {
  return fmt::format("loads: {{p: {{node: {}, force: {}, moment: {}}}}}\n", node, list(force), list(moment));
}

}  // namespace bielle::test

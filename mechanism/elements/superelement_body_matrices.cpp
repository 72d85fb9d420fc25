#include "mechanism/elements/superelement_body_matrices.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

void check_size(const Superelement& body, const char* what, const MatrixX& matrix) {
  if (matrix.rows() != body.size() || matrix.cols() != body.size())
    throw InputError(fmt::format("superelement '{}': its {} is {} x {}, expected {} x {}", body.name, what,
                                 matrix.rows(), matrix.cols(), body.size(), body.size()));
}

void check_sizes(const Superelement& body) {
  Eigen::Index kept = 0;
  for (const Interface& interface : body.interfaces)
    kept += std::count(interface.kept.begin(), interface.kept.end(), true);
  if (kept != body.interface_directions())
    throw InputError(fmt::format("superelement '{}': its interfaces keep {} directions, but its stiffness has {}",
                                 body.name, kept, body.interface_directions()));
  check_size(body, "stiffness", body.stiffness);
  check_size(body, "mass", body.mass);
  check_size(body, "damping", body.damping);
  for (const MatrixX& S : body.inertia_components) check_size(body, "inertia components", S);
  for (const MatrixX& K : body.spin_stiffness)
    if (K.size() > 0) check_size(body, "spin stiffness", K);
  for (const MatrixX& K : body.load_stiffness) check_size(body, "load stiffness", K);
  if (!body.load_stiffness.empty() && static_cast<Eigen::Index>(body.load_stiffness.size()) != kept)
    throw InputError(fmt::format("superelement '{}': it has {} load stiffnesses for {} interface directions", body.name,
                                 body.load_stiffness.size(), kept));
  for (const auto& [name, pattern] : body.loads)
    for (const auto& force : pattern.force)
      if (force.cols() != body.size())
        throw InputError(fmt::format("superelement '{}': load '{}' has {} columns, expected {}", body.name, name,
                                     force.cols(), body.size()));
}

}  // namespace

SuperelementMatrices::SuperelementMatrices(const Superelement& body, const std::vector<Vector3>& reference_positions,
                                           const std::vector<Matrix3>& reference_rotations)
    : modes(static_cast<int>(body.modes())) {
  check_sizes(body);
  int row = 0;
  for (std::size_t k = 0; k < body.interfaces.size(); ++k) {
    const Interface& interface = body.interfaces[k];
    const auto& kept = interface.kept;
    BodyPoint point;
    point.X = reference_positions[k];
    point.R_ref = reference_rotations[k];
    point.rotation = InterfaceRotation(interface.rotation, {kept[3], kept[4], kept[5]});
    point.keeps_position = kept[0] && kept[1] && kept[2];
    point.u = row;
    row += 3;
    if (point.rotation.kind() != InterfaceRotation::Kind::none) {
      point.theta = row;
      row += 3;
    }
    for (int d = 0; d < 6; ++d)
      if (kept[static_cast<std::size_t>(d)])
        directions.push_back({d < 3 ? point.u : point.theta, interface.rotation.col(d % 3)});
    points.push_back(std::move(point));
  }
  const int n = row + modes;
  U.setZero(n, 6);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const BodyPoint& point = points[k];
    U.block<3, 3>(point.u, 0).setIdentity();
    U.block<3, 3>(point.u, 3) = -skew(body.interfaces[k].position);
    if (point.theta >= 0) U.block<3, 3>(point.theta, 3).setIdentity();
  }
  const MatrixX P = file_rows(n);
  const auto padded = [&](const MatrixX& X) -> MatrixX { return P.transpose() * X * P; };
  const auto symmetric = [](const MatrixX& X) -> MatrixX { return 0.5 * (X + X.transpose()); };
  K = symmetric(padded(body.stiffness));
  C = symmetric(padded(body.damping));
  M = symmetric(padded(body.mass));
  A = M * U;

  std::array<MatrixX, 6> S;
  for (std::size_t i = 0; i < 6; ++i) S[i] = padded(body.inertia_components[i]);
  const MatrixX& S_23 = S[3];
  const MatrixX& S_13 = S[4];
  const MatrixX& S_12 = S[5];
  G = {S_23.transpose() - S_23, S_13 - S_13.transpose(), S_12.transpose() - S_12};
  for (std::size_t k = 0; k < 3; ++k) GU[k] = G[k] * U;
  const MatrixX sum = S[0] + S[1] + S[2];
  for (std::size_t i = 0; i < 6; ++i) {
    H[i] = symmetric(i < 3 ? MatrixX(sum - S[i]) : MatrixX(-S[i]));
    if (body.spin_stiffness[i].size() > 0) H[i] -= symmetric(padded(body.spin_stiffness[i]));
  }
  for (const MatrixX& stiffness : body.load_stiffness) load_stiffness.push_back(symmetric(padded(stiffness)));
  for (const auto& [name, load] : body.loads) {
    Pattern pattern(n, 9);
    for (int k = 0; k < 3; ++k)
      pattern.middleCols<3>(3 * k) = P.transpose() * load.force[static_cast<std::size_t>(k)].transpose();
    pattern_names.push_back(name);
    patterns.push_back(std::move(pattern));
  }

  const Matrix6 rigid = U.transpose() * A;
  if (Eigen::LLT<Matrix6>(rigid).info() != Eigen::Success)
    throw InputError(fmt::format("superelement '{}': its mass matrix gives no positive mass and inertia", body.name));
  mass = rigid.topLeftCorner<3, 3>().trace() / 3;
  centre = skew_vector(rigid.bottomLeftCorner<3, 3>()) / mass;
}

MatrixX SuperelementMatrices::file_rows(int n) const {
  const auto kept = static_cast<Eigen::Index>(directions.size());
  MatrixX P = MatrixX::Zero(kept + modes, n);
  for (Eigen::Index j = 0; j < kept; ++j) {
    const Direction& direction = directions[static_cast<std::size_t>(j)];
    P.block<1, 3>(j, direction.row) = direction.axis.transpose();
  }
  P.bottomRightCorner(modes, modes).setIdentity();
  return P;
}

void SuperelementMatrices::to_file(const Eigen::Ref<const VectorX>& q, Eigen::Ref<VectorX> q_file) const {
  for (std::size_t j = 0; j < directions.size(); ++j)
    q_file[static_cast<Eigen::Index>(j)] = directions[j].axis.dot(q.segment<3>(directions[j].row));
  q_file.tail(modes) = q.tail(modes);
}

}  // namespace bielle::mechanism

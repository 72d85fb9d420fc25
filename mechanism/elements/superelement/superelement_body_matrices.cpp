#include "mechanism/elements/superelement/superelement_body_matrices.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/symmetric_factors.hpp"

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
    throw InputError(fmt::format("superelement '{}': its interfaces keep {}, but its stiffness has {}", body.name,
                                 counted(kept, "direction"), body.interface_directions()));
  check_size(body, "stiffness", body.stiffness);
  check_size(body, "mass", body.mass);
  check_size(body, "damping", body.damping);
  for (const MatrixX& S : body.inertia_components) check_size(body, "inertia components", S);
  for (const MatrixX& K : body.spin_stiffness)
    if (K.size() > 0) check_size(body, "spin stiffness", K);
  for (const MatrixX& K : body.load_stiffness) check_size(body, "load stiffness", K);
  if (!body.load_stiffness.empty() && static_cast<Eigen::Index>(body.load_stiffness.size()) != kept)
    throw InputError(fmt::format("superelement '{}': it has {} for {}", body.name,
                                 counted(body.load_stiffness.size(), "load stiffness", "load stiffnesses"),
                                 counted(kept, "interface direction")));
  for (const auto& [name, pattern] : body.loads)
    for (const auto& force : pattern.force)
      if (force.cols() != body.size())
        throw InputError(fmt::format("superelement '{}': load '{}' has {}, expected {}", body.name, name,
                                     counted(force.cols(), "column"), body.size()));
}

MatrixX symmetric(const MatrixX& X) { return 0.5 * (X + X.transpose()); }

}  // namespace

SuperelementMatrices::SuperelementMatrices(const Superelement& body) : modes(static_cast<int>(body.modes())) {
  check_sizes(body);
  const int rows = add_points(body), n = rows + modes;
  U.setZero(n, 6);
  for (const BodyPoint& point : points) {
    U.block<3, 3>(point.u, 0).setIdentity();
    U.block<3, 3>(point.u, 3) = -skew(point.X);
    if (point.theta >= 0) U.block<3, 3>(point.theta, 3).setIdentity();
  }
  const MatrixX P = file_rows(n);
  kept = congruent(MatrixX::Identity(P.rows(), P.rows()), P).topLeftCorner(rows, rows);
  K = symmetric(congruent(body.stiffness, P));
  C = symmetric(congruent(body.damping, P));
  M = symmetric(congruent(body.mass, P));
  MU.setZero(n, 6);
  add_product(MU, M, U);
  rigid.setZero();
  add_transposed_product(rigid, U, MU);
  if (!is_positive_definite(rigid))
    throw InputError(fmt::format("superelement '{}': its mass matrix gives no positive mass and inertia", body.name));
  mass = rigid.topLeftCorner<3, 3>().trace() / 3;
  centre = skew_vector(rigid.bottomLeftCorner<3, 3>()) / mass;
  inertia = rigid.bottomRightCorner<3, 3>() + mass * skew(centre) * skew(centre);

  gyration = std::sqrt(inertia.trace() / mass);
  mean_turning = solve_symmetric(rigid, MU.transpose()).bottomRows<3>();
  set_inertia(body, P);
  set_stacked();
  set_load_stiffness(body, P);
  if (body.strains.size() > 0) strains = columns_in_rows(body.strains);
  for (const auto& [name, load] : body.loads) {
    Pattern pattern(n, 9);
    pattern.setZero();
    for (int k = 0; k < 3; ++k)
      add_transposed_product(pattern.middleCols<3>(3 * k), P, load.force[static_cast<std::size_t>(k)].transpose());
    pattern_names.push_back(name);
    patterns.push_back(std::move(pattern));
  }
}

int SuperelementMatrices::add_points(const Superelement& body) {
  int row = 0;
  for (const Interface& interface : body.interfaces) {
    const auto& kept_directions = interface.kept;
    BodyPoint point;
    point.X = interface.position;
    point.rotation =
        InterfaceRotation(interface.rotation, {kept_directions[3], kept_directions[4], kept_directions[5]});
    point.keeps_position = kept_directions[0] && kept_directions[1] && kept_directions[2];
    point.u = row;
    row += 3;
    if (point.rotation.kind() != InterfaceRotation::Kind::none) {
      point.theta = row;
      row += 3;
    }
    for (int d = 0; d < 6; ++d)
      if (kept_directions[static_cast<std::size_t>(d)])
        directions.push_back({d < 3 ? point.u : point.theta, interface.rotation.col(d % 3)});
    points.push_back(std::move(point));
  }
  return row;
}

void SuperelementMatrices::set_load_stiffness(const Superelement& body, const MatrixX& P) {
  interface_scale.setOnes(interface_rows());
  for (const BodyPoint& point : points)
    if (point.theta >= 0) interface_scale.segment<3>(point.theta).setConstant(gyration);
  if (body.load_stiffness.empty()) return;
  const Eigen::Index n = size(), b = interface_rows(), m = modes;
  load_stiffness.setZero(n * b, n);
  load_stiffness_forms.setZero(n * (n + 1) / 2, b);
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const MatrixX stiffness = symmetric(congruent(body.load_stiffness[j], P));
    for (int i = 0; i < 3; ++i) {
      const Eigen::Index row = directions[j].row + i;
      const double part = directions[j].axis[i];
      load_stiffness.middleRows(row * b, b) += part * stiffness.topRows(b);
      load_stiffness.middleRows(b * b + row * m, m) += part * stiffness.bottomRows(m);
      Eigen::Index next = 0;
      for (Eigen::Index k = 0; k < n; next += n - k, ++k) {
        load_stiffness_forms(next, row) += part * stiffness(k, k);
        load_stiffness_forms.col(row).segment(next + 1, n - k - 1) += 2 * part * stiffness.col(k).tail(n - k - 1);
      }
    }
  }
}

void SuperelementMatrices::set_stacked() {
  const Eigen::Index n = size();
  std::vector<const MatrixX*> all = {&K};
  for (const MatrixX& each : H) all.push_back(&each);
  if (stiffened_by_spin())
    for (const MatrixX& each : spin) all.push_back(&each);
  for (const MatrixX& each : G) all.push_back(&each);
  stacked.resize(n * static_cast<Eigen::Index>(all.size()), n);
  for (std::size_t k = 0; k < all.size(); ++k) stacked.middleRows(static_cast<Eigen::Index>(k) * n, n) = *all[k];
  in_a_row.resize(n, 4 * n);
  in_a_row << M, G[0], G[1], G[2];
  rigid_columns.resize(n, 27);
  rigid_columns << MU, mean_turning.transpose(), GU[0], GU[1], GU[2];
}

namespace {

Eigen::Map<VectorX> as_vector(MatrixX& matrix) { return {matrix.data(), matrix.size()}; }

}  // namespace

void SuperelementMatrices::multiply_load_stiffness(const VectorX& x, PrestressGradient& product) const {
  multiply_load_stiffness_by_modes(x.tail(modes), product);
  add_load_stiffness_interfaces(x.head(interface_rows()), product.interfaces);
  add_load_stiffness_modes(x.head(interface_rows()), product.modes);
}

void SuperelementMatrices::multiply_load_stiffness_by_modes(const Eigen::Ref<const VectorX>& x,
                                                            PrestressGradient& product) const {
  const Eigen::Index b = interface_rows();
  product.interfaces.setZero(b, b);
  product.modes.setZero(modes, b);
  add_product(as_vector(product.interfaces), load_stiffness.topRightCorner(b * b, modes), x);
  add_product(as_vector(product.modes), load_stiffness.bottomRightCorner(modes * b, modes), x);
}

void SuperelementMatrices::add_load_stiffness_interfaces(const Eigen::Ref<const VectorX>& x,
                                                         MatrixX& interfaces) const {
  const Eigen::Index b = interface_rows();
  add_product(as_vector(interfaces), load_stiffness.topLeftCorner(b * b, b), x);
}

void SuperelementMatrices::add_load_stiffness_modes(const Eigen::Ref<const VectorX>& x, MatrixX& into) const {
  const Eigen::Index b = interface_rows();
  add_product(as_vector(into), load_stiffness.bottomLeftCorner(modes * b, b), x);
}

void SuperelementMatrices::add_load_stiffness_forms(const VectorX& x, VectorX& products,
                                                    Eigen::Ref<VectorX> forms) const {
  const Eigen::Index n = size();
  products.resize(load_stiffness_forms.rows());
  Eigen::Index next = 0;
  for (Eigen::Index k = 0; k < n; next += n - k, ++k) products.segment(next, n - k) = x[k] * x.tail(n - k);
  add_transposed_product(forms, load_stiffness_forms, products);
}

void SuperelementMatrices::add_load_stiffness(const Eigen::Ref<const VectorX>& weights, MatrixX& X) const {
  const Eigen::Index b = interface_rows();
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    const double* column = load_stiffness.col(j).data();
    X.col(j).head(b).noalias() += Eigen::Map<const MatrixX>(column, b, b) * weights;
    X.col(j).tail(modes).noalias() += Eigen::Map<const MatrixX>(column + b * b, modes, b) * weights;
  }
}

void SuperelementMatrices::set_inertia(const Superelement& body, const MatrixX& P) {
  std::array<MatrixX, 6> S;
  for (std::size_t i = 0; i < 6; ++i) S[i] = congruent(body.inertia_components[i], P);
  const MatrixX& S_23 = S[3];
  const MatrixX& S_13 = S[4];
  const MatrixX& S_12 = S[5];
  G = {S_23.transpose() - S_23, S_13 - S_13.transpose(), S_12.transpose() - S_12};
  for (std::size_t k = 0; k < 3; ++k) {
    GU[k].setZero(size(), 6);
    add_product(GU[k], G[k], U);
  }
  const MatrixX sum = S[0] + S[1] + S[2];
  for (std::size_t i = 0; i < 6; ++i) {
    H[i] = symmetric(i < 3 ? MatrixX(sum - S[i]) : MatrixX(-S[i]));
    if (body.spin_stiffness[i].size() > 0) spin[i] = symmetric(congruent(body.spin_stiffness[i], P));
  }
}

MatrixX SuperelementMatrices::file_rows(int n) const {
  const auto count = static_cast<Eigen::Index>(directions.size());
  MatrixX P = MatrixX::Zero(count + modes, n);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Direction& direction = directions[static_cast<std::size_t>(j)];
    P.block<1, 3>(j, direction.row) = direction.axis.transpose();
  }
  P.bottomRightCorner(modes, modes).setIdentity();
  return P;
}

MatrixX SuperelementMatrices::columns_in_rows(const MatrixX& file_matrix) const {
  return file_matrix * file_rows(size());
}

MatrixX SuperelementMatrices::in_rows(const MatrixX& file_matrix) const {
  const MatrixX P = file_rows(size());
  return symmetric(congruent(file_matrix, P));
}

void SuperelementMatrices::to_file(const Eigen::Ref<const VectorX>& q, Eigen::Ref<VectorX> q_file) const {
  for (std::size_t j = 0; j < directions.size(); ++j)
    q_file[static_cast<Eigen::Index>(j)] = directions[j].axis.dot(q.segment<3>(directions[j].row));
  q_file.tail(modes) = q.tail(modes);
}

}  // namespace bielle::mechanism

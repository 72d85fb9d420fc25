#include "tests/support/beam_superelement.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle::test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Rows = Eigen::Matrix<double, 3, 12>;

constexpr std::array<double, 4> gauss_points = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                                0.8611363115940526};
constexpr std::array<double, 4> gauss_weights = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                                 0.3478548451374538};

/// Returns the displacement (order 0) or its derivative along the element of the given order, element axes, at z in
/// 0..1.
Rows shape_functions(double z, double L, int order) {
  std::array<double, 4> H;  // v1, theta1, v2, theta2
  if (order == 0) {
    H = {1 - 3 * z * z + 2 * z * z * z, L * (z - 2 * z * z + z * z * z), 3 * z * z - 2 * z * z * z,
         L * (z * z * z - z * z)};
  } else if (order == 1) {
    H = {(-6 * z + 6 * z * z) / L, 1 - 4 * z + 3 * z * z, (6 * z - 6 * z * z) / L, 3 * z * z - 2 * z};
  } else {
    H = {(-6 + 12 * z) / (L * L), (-4 + 6 * z) / L, (6 - 12 * z) / (L * L), (6 * z - 2) / L};
  }
  Rows N = Rows::Zero();
  N(0, 0) = order == 0 ? 1 - z : (order == 1 ? -1 / L : 0);
  N(0, 6) = order == 0 ? z : (order == 1 ? 1 / L : 0);
  N(1, 1) = H[0];
  N(1, 5) = H[1];
  N(1, 7) = H[2];
  N(1, 11) = H[3];
  N(2, 2) = H[0];
  N(2, 4) = -H[1];
  N(2, 8) = H[2];
  N(2, 10) = -H[3];
  return N;
}

/// The unreduced chain.
struct Full {
  MatrixXd K, M, rotary, F;  // F: displacement of the mass points
  Eigen::Matrix3Xd points;
  VectorXd masses;
  MatrixXd rigid;
  std::vector<Eigen::Matrix<double, 12, 12>> turn;  // element axes <- body axes
  std::vector<double> length;

  explicit Full(const BeamChain& chain) {
    const auto elements = static_cast<Eigen::Index>(chain.nodes.size()) - 1;
    const Eigen::Index size = 6 * (elements + 1), gauss = 4 * elements;
    const BeamProperties& p = chain.properties;
    K.setZero(size, size);
    rotary.setZero(size, size);
    F.setZero(3 * gauss, size);
    points.resize(3, gauss);
    masses.resize(gauss);
    for (Eigen::Index e = 0; e < elements; ++e) {
      const Vector3d a = chain.nodes[static_cast<std::size_t>(e)], b = chain.nodes[static_cast<std::size_t>(e) + 1];
      const double L = (b - a).norm();
      Matrix3d axes;
      axes.col(0) = (b - a) / L;
      axes.col(2) = axes.col(0).cross(chain.y_direction).normalized();
      axes.col(1) = axes.col(2).cross(axes.col(0));
      Eigen::Matrix<double, 12, 12> Q = Eigen::Matrix<double, 12, 12>::Zero();
      for (int i = 0; i < 4; ++i) Q.block<3, 3>(3 * i, 3 * i) = axes.transpose();
      turn.push_back(Q);
      length.push_back(L);
      Eigen::Matrix<double, 12, 12> k = Eigen::Matrix<double, 12, 12>::Zero(), j = k;
      for (std::size_t g = 0; g < 4; ++g) {
        const double z = (1 + gauss_points[g]) / 2, w = gauss_weights[g] / 2 * L;
        const Rows d1 = shape_functions(z, L, 1), d2 = shape_functions(z, L, 2), N = shape_functions(z, L, 0);
        k += w * (p.EA * d1.row(0).transpose() * d1.row(0) + p.EIz * d2.row(1).transpose() * d2.row(1) +
                  p.EIy * d2.row(2).transpose() * d2.row(2));
        const Eigen::Index point = 4 * e + static_cast<Eigen::Index>(g);
        points.col(point) = a + z * (b - a);
        masses[point] = w * p.mass_per_length;
        F.block(3 * point, 6 * e, 3, 12) = axes * N * Q;
      }
      for (int i : {3, 9})
        for (int l : {3, 9}) {
          k(i, l) += (i == l ? 1 : -1) * p.GJ / L;
          j(i, l) += (i == l ? 2 : 1) * p.rotary_inertia * L / 6;
        }
      K.block(6 * e, 6 * e, 12, 12) += Q.transpose() * k * Q;
      rotary.block(6 * e, 6 * e, 12, 12) += Q.transpose() * j * Q;
    }
    const VectorXd weights = masses.transpose().replicate(3, 1).reshaped();
    M = transposed_product(F, weights.asDiagonal() * F) + rotary;
    rigid.setZero(size, 6);
    for (Eigen::Index n = 0; n <= elements; ++n) {
      const Vector3d X = chain.nodes[static_cast<std::size_t>(n)];
      Matrix3d skew;
      skew << 0, -X.z(), X.y(), X.z(), 0, -X.x(), -X.y(), X.x(), 0;
      rigid.block<3, 3>(6 * n, 0).setIdentity();
      rigid.block<3, 3>(6 * n, 3) = -skew;
      rigid.block<3, 3>(6 * n + 3, 3).setIdentity();
    }
  }

  /// Returns the geometric stiffness under the section forces that `load` raises in the free body, balanced by
  /// rigid-body inertia.
  MatrixXd prestress(const BeamChain& chain, const VectorXd& load) const {
    const MatrixXd MU = product(M, rigid);
    const VectorXd balanced = load - MU * solve_symmetric(transposed_product(rigid, MU), rigid.transpose() * load);
    const Eigen::Index size = K.rows();
    VectorXd u = VectorXd::Zero(size);
    u.tail(size - 6) = solve_symmetric(K.bottomRightCorner(size - 6, size - 6), balanced.tail(size - 6));
    MatrixXd geometric = MatrixXd::Zero(size, size);
    for (std::size_t e = 0; e < turn.size(); ++e) {
      const auto first = static_cast<Eigen::Index>(6 * e);
      const Eigen::Matrix<double, 12, 1> ends = turn[e] * u.segment<12>(first);
      Eigen::Matrix<double, 12, 12> k = Eigen::Matrix<double, 12, 12>::Zero();
      for (std::size_t g = 0; g < 4; ++g)
        k += gauss_weights[g] / 2 * length[e] *
             second_variation(chain.properties, (1 + gauss_points[g]) / 2, length[e], ends);
      geometric.block<12, 12>(first, first) += turn[e].transpose() * (k + k.transpose()) * turn[e];
    }
    return geometric;
  }

  /// Returns n.Gamma_2 + m.kappa_2 at z as a form in the ends' displacements, element axes, where n and m belong to
  /// other displacements of the ends.
  static Eigen::Matrix<double, 12, 12> second_variation(const BeamProperties& p, double z, double L,
                                                        const Eigen::Matrix<double, 12, 1>& ends) {
    const Rows d1 = shape_functions(z, L, 1), d2 = shape_functions(z, L, 2);
    const Rows d3 = (shape_functions(1, L, 2) - shape_functions(0, L, 2)) / L;  // linear in z
    Rows theta = Rows::Zero(), theta_rate = Rows::Zero();
    theta(0, 3) = 1 - z;
    theta(0, 9) = z;
    theta_rate(0, 9) = 1 / L;
    theta_rate(0, 3) = -1 / L;
    theta.row(1) = -d1.row(2);
    theta.row(2) = d1.row(1);
    theta_rate.row(1) = -d2.row(2);
    theta_rate.row(2) = d2.row(1);
    // m' + e_1 x n = 0
    const Vector3d m(p.GJ * theta_rate.row(0).dot(ends), p.EIy * theta_rate.row(1).dot(ends),
                     p.EIz * theta_rate.row(2).dot(ends));
    const Vector3d n(p.EA * d1.row(0).dot(ends), -p.EIz * d3.row(1).dot(ends), -p.EIy * d3.row(2).dot(ends));
    const auto cross = [](const Vector3d& v) {
      Matrix3d s;
      s << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
      return s;
    };
    return theta.transpose() * cross(n) * d1 + 0.5 * (theta.transpose() * n) * theta.row(0) -
           0.5 * n.x() * theta.transpose() * theta + 0.5 * theta.transpose() * cross(m) * theta_rate;
  }

  /// Returns the loads of the centrifugal field of the pair k, l: half of the terms of Om_k Om_l when k differs from l.
  VectorXd centrifugal(int k, int l) const {
    VectorXd acceleration(3 * points.cols());
    for (Eigen::Index g = 0; g < points.cols(); ++g) {
      const Vector3d X = points.col(g);
      Vector3d a = (k == l ? 1 : 0) * X;
      a -= 0.5 * (X[l] * Vector3d::Unit(k) + X[k] * Vector3d::Unit(l));
      acceleration.segment<3>(3 * g) = masses[g] * a;
    }
    return F.transpose() * acceleration;
  }
};

}  // namespace

BeamSuperelement BeamChain::reduced() const {
  const Full full(*this);
  const Eigen::Index size = full.K.rows();
  // Unknowns at interfaces turn to the interface's axes: x_body = turn x.
  MatrixXd turn = MatrixXd::Identity(size, size);
  std::vector<Eigen::Index> boundary, internal;
  std::vector<bool> is_boundary(static_cast<std::size_t>(size), false);
  for (const BeamInterface& interface : interfaces)
    for (Eigen::Index d = 0; d < 6; ++d) {
      if (d % 3 == 0) turn.block<3, 3>(6 * interface.node + d, 6 * interface.node + d) = interface.rotation;
      if (!interface.kept[static_cast<std::size_t>(d)]) continue;
      boundary.push_back(6 * interface.node + d);
      is_boundary[static_cast<std::size_t>(boundary.back())] = true;
    }
  for (Eigen::Index i = 0; i < size; ++i)
    if (!is_boundary[static_cast<std::size_t>(i)]) internal.push_back(i);
  const MatrixXd K = congruent(full.K, turn), M = congruent(full.M, turn);
  const MatrixXd K_ii = K(internal, internal);
  const SymmetricEigenpairs eigen = symmetric_eigenpairs(K_ii, M(internal, internal)).value();
  const auto nb = static_cast<Eigen::Index>(boundary.size()), n = nb + modes;
  MatrixXd basis = MatrixXd::Zero(size, n);
  basis(boundary, Eigen::seqN(0, nb)) = MatrixXd::Identity(nb, nb);
  basis(internal, Eigen::seqN(0, nb)) = -solve_symmetric(K_ii, K(internal, boundary));
  basis(internal, Eigen::seqN(nb, modes)) = eigen.vectors.leftCols(modes);

  BeamSuperelement result;
  result.basis = product(turn, basis);
  const MatrixXd& T = result.basis;
  const auto symmetric = [](const MatrixXd& X) -> MatrixXd { return 0.5 * (X + X.transpose()); };
  const auto reduce = [&](const MatrixXd& X) { return symmetric(congruent(X, T)); };
  result.full_stiffness = full.K;
  result.full_mass = full.M;
  result.points = full.points;
  result.masses = full.masses;
  result.field = product(full.F, T);
  result.rotary = reduce(full.rotary);

  Superelement& body = result.body;
  body.name = "beam";
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    body.interfaces.push_back({std::string(1, static_cast<char>('a' + i)),
                               nodes[static_cast<std::size_t>(interfaces[i].node)], interfaces[i].rotation,
                               interfaces[i].kept});
  body.frequencies = eigen.values.head(modes).cwiseSqrt() / (2 * M_PI);
  body.stiffness = reduce(full.K);
  body.stiffness.rightCols(modes).setZero();
  body.stiffness.bottomRows(modes).setZero();
  body.stiffness.bottomRightCorner(modes, modes).diagonal() = eigen.values.head(modes);
  body.mass = reduce(full.M);
  body.damping = damping * body.stiffness;
  for (const BeamLoad& load : loads)
    for (int k = 0; k < 3; ++k) {
      auto& force = body.loads[load.pattern].force[static_cast<std::size_t>(k)];
      if (force.size() == 0) force.setZero(3, n);
      force += load.force[k] * T.middleRows<3>(6 * load.node);
    }
  const std::array<std::pair<int, int>, 6> pairs = {{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto [k, l] = pairs[i];
    const auto rows = [&](int c) { return result.field(Eigen::seqN(c, result.masses.size(), 3), Eigen::all); };
    body.inertia_components[i] = transposed_product(rows(k), result.masses.asDiagonal() * MatrixXd(rows(l)));
    if (k == l) body.inertia_components[i] = symmetric(body.inertia_components[i]);
    if (prestress) body.spin_stiffness[i] = reduce(full.prestress(*this, full.centrifugal(k, l)));
  }
  if (prestress)
    for (Eigen::Index j : boundary) body.load_stiffness.push_back(reduce(full.prestress(*this, turn.col(j))));
  const Eigen::Matrix<double, 6, 6> rigid = full.rigid.transpose() * full.M * full.rigid;
  body.total_mass = rigid(0, 0);
  body.centre = Vector3d(rigid(5, 1), rigid(3, 2), rigid(4, 0)) / body.total_mass;
  Matrix3d lever;
  lever << 0, -body.centre.z(), body.centre.y(), body.centre.z(), 0, -body.centre.x(), -body.centre.y(),
      body.centre.x(), 0;
  body.inertia = symmetric(rigid.bottomRightCorner<3, 3>()) + body.total_mass * lever * lever;
  body.effective_mass = MatrixXd::Zero(modes, 6);
  const auto chain_nodes = static_cast<Eigen::Index>(nodes.size());
  body.mode_turns.resize(3 * chain_nodes, modes);
  for (Eigen::Index k = 0; k < chain_nodes; ++k)
    body.mode_turns.middleRows<3>(3 * k) = T.middleRows<3>(6 * k + 3).rightCols(modes);
  return result;
}

void add_mesh(const BeamChain& chain, double distance, BeamSuperelement& reduced) {
  const auto nodes = static_cast<Eigen::Index>(chain.nodes.size());
  Superelement& body = reduced.body;
  body.mesh.points.resize(3, 4 * nodes);
  body.displacement_recovery.resize(12 * nodes, body.stiffness.cols());
  for (Eigen::Index k = 0; k < nodes; ++k)
    for (Eigen::Index i = 0; i < 4; ++i) {
      const Vector3d offset = distance * (i % 2 == 0 ? 1 : -1) * (i < 2 ? Vector3d::UnitY() : Vector3d::UnitZ());
      Matrix3d cross;
      cross << 0, -offset.z(), offset.y(), offset.z(), 0, -offset.x(), -offset.y(), offset.x(), 0;
      body.mesh.points.col(4 * k + i) = chain.nodes[static_cast<std::size_t>(k)] + offset;
      body.displacement_recovery.middleRows<3>(3 * (4 * k + i)) =
          reduced.basis.middleRows<3>(6 * k) - cross * reduced.basis.middleRows<3>(6 * k + 3);
    }
}

BeamChain straight_beam(const BeamProperties& properties, int modes) {
  BeamChain chain;
  for (int i = 0; i <= 20; ++i) chain.nodes.emplace_back(i / 20.0, 0, 0);
  chain.properties = properties;
  chain.interfaces = {{0}, {20}};
  chain.modes = modes;
  return chain;
}

BeamChain bent_chain() {
  BeamChain chain;
  for (int i = 0; i <= 12; ++i) {
    const double s = i / 12.0;
    chain.nodes.emplace_back(0.3 + s, 0.4 * s * s - 0.1, 0.25 * std::sin(3 * s));
  }
  chain.properties = {1.3, 40, 2.1, 1.7, 1.2, 0.02};
  const auto turned = [](double angle, const Vector3d& axis) {
    return Matrix3d(Eigen::AngleAxisd(angle, axis.normalized()));
  };
  chain.interfaces = {{0, {true, true, true, true, true, true}, turned(0.7, {1, 2, 3})},
                      {12, {true, true, true, true, true, true}, Matrix3d::Identity()},
                      {5, {true, true, true, true, true, true}, turned(-1.1, {0, 1, -1})}};
  chain.loads = {{"push", 3, {1, -2, 0.5}}, {"spread", 8, {0.3, 0.4, 1}}, {"spread", 10, {-1, 0.5, 0.2}}};
  chain.damping = 1e-2;
  chain.modes = 5;
  return chain;
}

std::vector<BeamChain> bent_chains() {
  std::vector<BeamChain> chains(5, bent_chain());
  chains[1].interfaces[1].kept = {true, true, true, false, false, false};
  chains[2].interfaces[1].kept = {true, true, true, true, true, false};
  chains[2].interfaces[2].kept = {true, true, true, false, true, false};
  chains[3].interfaces[2].kept = {false, true, true, true, false, true};
  for (BeamInterface& interface : chains[4].interfaces) interface.kept = {true, true, true, false, false, false};
  return chains;
}

}  // namespace bielle::test

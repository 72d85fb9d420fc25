#include "mechanism/solvers/linearised/mode_parts.hpp"

#include <cmath>

#include "mechanism/model/coupled_pairs.hpp"
#include "mechanism/model/slender_component.hpp"
#include "mechanism/solvers/linearised/variations.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
Variation variation_of(const System& system, const Mode& mode) {
  Variation variation{mode.u, mode.s * mode.u, {}};
  variation.rate.head(system.dofs()) = mode.w;
  return variation;
}

}  // namespace

NodeShapes node_shapes(const System& system, const State& state, const Mode& mode) {
  const auto count = static_cast<Eigen::Index>(state.nodes.size());
  NodeShapes shapes{Eigen::Matrix3Xcd::Zero(3, count), Eigen::Matrix3Xcd::Zero(3, count)};
  const Variation variation = variation_of(system, mode);
  for (Eigen::Index k = 0; k < count; ++k) {
    const NodeVariation node = node_variation(system, state, variation, static_cast<int>(k));
    shapes.displacement.col(k) = node.position.head<3>();
    shapes.rotation.col(k) = state.nodes[static_cast<std::size_t>(k)].R.cast<Complex>() * node.position.tail<3>();
  }
  return shapes;
}

Complex unit_factor(const System& system, const State& state, const Mode& mode) {
  const NodeShapes shapes = node_shapes(system, state, mode);
  const double length = model_extent(state);
  double size = 0, measure = 0;
  Complex largest = 0;
  const auto consider = [&](const Eigen::Matrix3Xcd& of_nodes, double weight) {
    for (const Complex value : of_nodes.reshaped())
      if (weight * std::abs(value) > measure * (1 + 1e-9)) {
        measure = weight * std::abs(value);
        largest = value;
      }
  };
  consider(shapes.displacement, 1);
  consider(shapes.rotation, length > 0 ? length : 1);
  size = std::abs(largest);
  if (size == 0)
    for (int i = system.kinematics().unknowns(); i < mode.u.size(); ++i)
      if (std::abs(mode.u[i]) > size * (1 + 1e-9)) {
        size = std::abs(mode.u[i]);
        largest = mode.u[i];
      }
  if (size == 0) return 1;
  return std::conj(largest) / (size * size);
}

namespace {

/// Variations of a member's own positions and rates in a mode.
struct MemberVariation {
  Eigen::VectorXcd u, w;
};

MemberVariation member_variation(const System& system, const Slots& slots, const Mode& mode,
                                 const std::vector<NodeVariation>& nodes) {
  const Eigen::Index positions = slots.first_order_row();
  MemberVariation local{Eigen::VectorXcd(positions), Eigen::VectorXcd(positions)};
  for (std::size_t k = 0; k < slots.nodes.size(); ++k) {
    const NodeVariation& node = nodes[static_cast<std::size_t>(slots.nodes[k])];
    local.u.segment<6>(6 * static_cast<Eigen::Index>(k)) = node.position;
    local.w.segment<6>(6 * static_cast<Eigen::Index>(k)) = node.rate;
  }
  const int amplitude = system.kinematics().unknowns() + slots.amplitude_begin;
  local.u.tail(slots.amplitudes) = mode.u.segment(amplitude, slots.amplitudes);
  local.w.tail(slots.amplitudes) = mode.w.segment(amplitude, slots.amplitudes);
  return local;
}

double mean_energy(const MatrixX& A, const Eigen::VectorXcd& x) {
  const VectorX real = x.real(), imag = x.imag();
  return 0.25 * (real.dot(A * real) + imag.dot(A * imag));
}

double mean_energy_of_rotations(const MatrixX& M, const Eigen::VectorXcd& w, Eigen::Index nodes) {
  double sum = 0;
  for (Eigen::Index k = 0; k < nodes; ++k)
    sum += mean_energy(M.block<3, 3>(6 * k + 3, 6 * k + 3), w.segment<3>(6 * k + 3));
  return sum;
}

/// Adds the strain energies of a slender member, averaged over a period.
void add_strain_energies(const SlenderComponent& component, const LocalState& state, const Eigen::VectorXcd& u,
                         Eigen::Index member, Eigen::Index mode, MemberEnergies& energies) {
  for (const VectorX& part : {VectorX(u.real()), VectorX(u.imag())}) {
    const StrainEnergies strain = component.strain_energies(state, part);
    energies.extension(member, mode) += 0.5 * strain.extension;
    energies.torsion(member, mode) += 0.5 * strain.torsion;
    energies.bending_y(member, mode) += 0.5 * strain.bending_y;
    energies.bending_z(member, mode) += 0.5 * strain.bending_z;
  }
}

/// Adds up the potential energies of pairs of a member's nodes, in each mode.
class PairEnergies final : public PairDerivatives {
 public:
  /// @param u  variations of the member's positions in each mode
  explicit PairEnergies(const std::vector<Eigen::VectorXcd>& u)
      : u_(u), sums_(VectorX::Zero(static_cast<Eigen::Index>(u.size()))) {}
  const VectorX& sums() const { return sums_; }
  void add(int a, int b, const Vector12& /*r*/, const Matrix12& K, const Matrix12& /*C*/) override {
    Eigen::VectorXcd both(12);
    for (std::size_t k = 0; k < u_.size(); ++k) {
      both << u_[k].segment<6>(6 * a), u_[k].segment<6>(6 * b);
      sums_[static_cast<Eigen::Index>(k)] += mean_energy(K, both);
    }
  }

 private:
  const std::vector<Eigen::VectorXcd>& u_;
  VectorX sums_;
};

}  // namespace

MemberEnergies::MemberEnergies(Eigen::Index members, Eigen::Index modes) {
  kinetic = potential = turning = extension = torsion = bending_y = bending_z = MatrixX::Zero(members, modes);
}

MemberEnergies& MemberEnergies::operator+=(const MemberEnergies& other) {
  kinetic += other.kinetic;
  potential += other.potential;
  turning += other.turning;
  extension += other.extension;
  torsion += other.torsion;
  bending_y += other.bending_y;
  bending_z += other.bending_z;
  return *this;
}

MemberEnergies member_energies(const System& system, const Environment& environment, const State& state,
                               const std::vector<Mode>& modes) {
  const auto& members = system.model().members();
  const auto rows = static_cast<Eigen::Index>(members.size()), columns = static_cast<Eigen::Index>(modes.size());
  MemberEnergies energies(rows, columns);
  std::vector<std::vector<NodeVariation>> nodes;
  for (const Mode& mode : modes) {
    std::vector<NodeVariation>& of_mode = nodes.emplace_back();
    const Variation variation = variation_of(system, mode);
    for (int k = 0; k < static_cast<int>(state.nodes.size()); ++k)
      of_mode.push_back(node_variation(system, state, variation, k));
  }
  for (Eigen::Index m = 0; m < rows; ++m) {
    const Component& component = *members[static_cast<std::size_t>(m)].component;
    const Slots& slots = system.slots()[static_cast<std::size_t>(m)];
    const auto* slender = dynamic_cast<const SlenderComponent*>(&component);
    const int size = slots.size(), positions = slots.first_order_row();
    Declaration declaration;
    component.declare(declaration);
    if (declaration.passive || positions == 0 || !system.is_active(state, static_cast<std::size_t>(m))) continue;
    const bool constrains = slots.multipliers > 0;
    if (!declaration.stiffness && !declaration.mass && !constrains) continue;
    if (const auto* pairs = dynamic_cast<const CoupledPairs*>(&component)) {
      std::vector<Eigen::VectorXcd> u;
      for (std::size_t k = 0; k < modes.size(); ++k) {
        u.push_back(member_variation(system, slots, modes[k], nodes[k]).u);
        if (modes[k].kind == ModeKind::rigid) u.back().setZero();
      }
      PairEnergies sum(u);
      pairs->add_pair_tangents(LocalState(state, slots, environment), sum);
      energies.potential.row(m) = sum.sums().transpose();
      continue;
    }
    MatrixX K = MatrixX::Zero(size, size), C = MatrixX::Zero(size, size), M = MatrixX::Zero(size, size);
    LocalTangent tangent{LocalMatrix(K),      LocalMatrix(C),  LocalMatrix(M), declaration.stiffness || constrains,
                         declaration.damping, declaration.mass};
    component.add_tangent(LocalState(state, slots, environment), tangent);
    K = K.topLeftCorner(positions, positions).eval();
    M = M.topLeftCorner(positions, positions).eval();
    for (Eigen::Index k = 0; k < columns; ++k) {
      const auto j = static_cast<std::size_t>(k);
      const MemberVariation local = member_variation(system, slots, modes[j], nodes[j]);
      const bool rigid = modes[j].kind == ModeKind::rigid;
      const Eigen::VectorXcd& rate = rigid ? local.u : local.w;
      energies.kinetic(m, k) = mean_energy(M, rate);
      energies.turning(m, k) = mean_energy_of_rotations(M, rate, static_cast<Eigen::Index>(slots.nodes.size()));
      if (rigid) continue;
      energies.potential(m, k) = mean_energy(K, local.u);
      if (slender) add_strain_energies(*slender, LocalState(state, slots, environment), local.u, m, k, energies);
    }
  }
  return energies;
}

}  // namespace bielle::mechanism

#include "mechanism/solvers/linearised/periodic_orbit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/linearised/harmonic_equations.hpp"
#include "mechanism/solvers/linearised/loose_motions.hpp"
#include "mechanism/solvers/linearised/orbit_equations.hpp"
#include "mechanism/solvers/linearised/residual_sizes.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// The residual of each harmonic, in columns.
struct HarmonicResidual {
  MatrixX forces, gaps;  ///< (unknowns, 2 h + 1), (constraints, 2 h + 1)
  double size = 0;       ///< largest entry relative to the forces that act, or to the sizes of constraints
};

class OrbitSearch {
 public:
  OrbitSearch(const System& system, const Environment& environment, const State& state, const TurningPart& part,
              double rate)
      : system_(system),
        environment_(environment),
        state_(state),
        part_(part),
        rate_(rate),
        length_(model_length(state)),
        gap_sizes_(constraint_sizes(system, environment, state)) {}

  std::optional<PeriodicOrbit> find() {
    constexpr int most = 64, most_begun = 16;
    constexpr double alternates = 1e-9;
    PeriodicDeviation orbit;
    orbit.rate = rate_;
    bool followed = false;
    for (int h = 2; h <= most; h += std::max(2, h / 8 * 2)) {
      equations_.reset();
      equations_ = std::make_unique<const OrbitEquations>(
          system_, environment_, part_, azimuths_over_turn(system_, environment_, state_, part_, 2 * h + 6));
      operator_.reset();
      if (orbit.q.size() == 0) {
        orbit.q.resize(equations_->unknowns(), 0);
        orbit.l.resize(equations_->constraints(), 0);
        orbit.extend(h);
        calc_sizes(orbit);
        const HarmonicResidual first = residual(orbit);
        if (first.size <= alternates) return std::nullopt;
        followed = follow(first, orbit);
      } else {
        orbit.extend(h);
        PeriodicDeviation trial = orbit;
        if (followed && converge(nullptr, 1, trial)) {
          orbit = trial;
        } else {
          orbit.q.setZero();
          orbit.l.setZero();
          followed = follow(residual(orbit), orbit);
        }
      }
      // A motion with a large amplitude can only be found with several harmonics.
      if (!followed && h >= most_begun) throw_none(why_not());
      if (followed && resolved(orbit)) return whole(std::move(orbit));
    }
    throw_none(fmt::format("{} harmonics of the rotation are not enough for it", most));
  }

 private:
  [[noreturn]] void throw_none(const std::string& reason) const {
    throw ComputationError(fmt::format(
        "no periodic motion at {:.6g} rad/s was found in which gravity across the axis and unbalance shake the "
        "mechanism: {}",
        rate_, reason));
  }

  /// Increases the alternating forces to their full size. @returns whether the motion was found
  bool follow(const HarmonicResidual& first, PeriodicDeviation& orbit) {
    constexpr double least = 1.0 / 256;
    double step = 1;
    made_ = 0;
    while (made_ < 1) {
      const double end = std::min(1.0, made_ + step);
      PeriodicDeviation trial = orbit;
      operator_.reset();
      if (converge(&first, end, trial)) {
        orbit = trial;
        made_ = end;
        step *= 2;
        continue;
      }
      step /= 2;
      if (step < least) return false;
    }
    return true;
  }

  std::string why_not() const {
    const std::string followed = fmt::format("Newton's method follows it up to {:.3g} of these forces", made_);
    return free_ ? followed +
                       "; nothing holds the rate of the joint: if damping or friction slows the part down, a "
                       "drive with a `rate` holds it"
                 : followed +
                       "; there may be none: blades that fall over tumble or repeat their motion after several turns, "
                       "as a `dynamic` analysis shows";
  }

  /// Sets the forces relative to which residuals are small: the largest over a turn, and rounding of the stiffness.
  void calc_sizes(const PeriodicDeviation& orbit) {
    ResidualScale scale;
    for (int k = 0; k < equations_->count(); ++k) {
      ResidualScale here;
      equations_->residual(k, orbit, &here);
      for (std::size_t i = 0; i < kind_count; ++i) scale.largest[i] = std::max(scale.largest[i], here.largest[i]);
    }
    constexpr double share = 1e-9;
    sizes_ = residual_sizes(system_, equations_->mean(0).equations.K, scale, length_, share);
  }

  HarmonicResidual residual(const PeriodicDeviation& orbit) const {
    const int n = equations_->unknowns(), m = equations_->constraints(), functions = 2 * orbit.harmonics + 1;
    HarmonicResidual result{MatrixX::Zero(n, functions), MatrixX::Zero(m, functions), 0};
    for (int k = 0; k < equations_->count(); ++k) {
      const VectorX r = equations_->residual(k, orbit) / equations_->count();
      for (int p = 0; p < functions; ++p) {
        const double e = PeriodicEquations::function(p, equations_->azimuth(k));
        result.forces.col(p) += e * r.head(n);
        result.gaps.col(p) += e * r.tail(m);
      }
    }
    measure(result);
    return result;
  }

  void measure(HarmonicResidual& r) const {
    r.size = 0;
    for (Eigen::Index i = 0; i < r.forces.rows(); ++i)
      if (sizes_[i] > 0) r.size = std::max(r.size, r.forces.row(i).cwiseAbs().maxCoeff() / sizes_[i]);
    for (Eigen::Index i = 0; i < r.gaps.rows(); ++i)
      r.size = std::max(r.size, r.gaps.row(i).cwiseAbs().maxCoeff() /
                                    gap_sizes_[equations_->mean(0).equations.multiplier[static_cast<std::size_t>(i)]]);
    if (!r.forces.allFinite() || !r.gaps.allFinite()) r.size = INFINITY;
  }

  /// Applies Newton's method; the factors are kept as long as the residual decreases rapidly.
  /// @param first  residual of the mean state @param part  fraction of it that acts
  bool converge(const HarmonicResidual* first, double part, PeriodicDeviation& orbit) {
    constexpr int most = 25, most_worse = 3;
    constexpr double exact = 1e-12, balanced = 1e-8, rapid = 0.1, far = 10;
    double before = INFINITY, begin = INFINITY;
    int worse = 0;
    for (int iteration = 0; iteration < most; ++iteration) {
      HarmonicResidual r;
      try {
        r = residual(orbit);
      } catch (const ComputationError&) {
        return false;  // a distant iterate at which a component cannot be evaluated
      }
      if (first && part < 1) {
        r.forces -= (1 - part) * first->forces;
        r.gaps -= (1 - part) * first->gaps;
        measure(r);
      }
      if (!std::isfinite(r.size)) return false;
      if (iteration == 0) begin = r.size;
      if (r.size <= exact || (r.size <= balanced && r.size > 0.5 * before)) return true;
      // An iteration whose residual increases repeatedly may end at another motion than the one that grows with the
      // forces.
      if (r.size > before && ++worse > most_worse) return false;
      if (r.size > far * begin) return false;
      if (!operator_ || r.size > rapid * before) {
        if (!factorise(orbit)) return false;
      }
      before = r.size;
      if (!take_step(r, orbit)) return false;
    }
    return false;
  }

  bool factorise(const PeriodicDeviation& orbit) {
    std::vector<LinearisedEquations> azimuths;
    for (int k = 0; k < equations_->count(); ++k) {
      azimuths.push_back(equations_->linearised(k, orbit).equations);
      hold(azimuths.back());
    }
    periodic_ = std::make_unique<const PeriodicEquations>(azimuths, rate_, length_);
    harmonics_ = periodic_->of_harmonics(orbit.harmonics);
    operator_ = std::make_unique<ShiftedOperator>(harmonics_, 0, std::move(operator_));
    return operator_->regular();
  }

  /// Holds indifferent motions. A shift in time is one of them, unless a drive prescribes the angle itself.
  void hold(LinearisedEquations& e) {
    constexpr double little = 1e-6;
    hold_loose(rate_, e);
    free_ = true;
    for (int k = 0; k < e.constraints(); ++k) {
      if (!part_.drives_joint(e.multiplier[static_cast<std::size_t>(k)])) continue;
      free_ = false;
      held_ = held_ || e.nonholonomic[static_cast<std::size_t>(k)] == 0;
    }
    std::vector<Eigen::Triplet<double>> chosen;
    for (int k = 0; k < e.constraints(); ++k)
      if (e.nonholonomic[static_cast<std::size_t>(k)] != 0) chosen.emplace_back(k, k, little * std::abs(rate_));
    LinearisedEquations::Sparse rows(e.constraints(), e.constraints());
    rows.setFromTriplets(chosen.begin(), chosen.end());
    e.S += LinearisedEquations::Sparse(rows * e.B);
  }

  bool take_step(const HarmonicResidual& r, PeriodicDeviation& orbit) const {
    const int n = equations_->unknowns(), m = equations_->constraints(), h = orbit.harmonics, functions = 2 * h + 1;
    VectorX right(functions * (n + m));
    for (int p = 0; p < functions; ++p) {
      for (int i = 0; i < n; ++i) right[periodic_->index(p, i, h)] = -r.forces(i, p);
      right.segment(functions * n + p * m, m) = -r.gaps.col(p);
    }
    const VectorX found = operator_->solve(right.cast<std::complex<double>>()).real();
    if (!found.allFinite()) return false;
    MatrixX step(n, functions);
    for (int p = 0; p < functions; ++p) {
      for (int i = 0; i < n; ++i) step(i, p) = found[periodic_->index(p, i, h)];
      orbit.l.col(p) += found.segment(functions * n + p * m, m);
    }
    turn_nodes(orbit, step);
    orbit.q += step;
    return true;
  }

  /// Replaces increments of rotations in the axes of the mean motion by those of rotation vectors.
  void turn_nodes(const PeriodicDeviation& orbit, MatrixX& step) const {
    const auto functions = step.cols();
    MatrixX e(functions, equations_->count());
    for (int k = 0; k < equations_->count(); ++k)
      for (int p = 0; p < static_cast<int>(functions); ++p)
        e(p, k) = PeriodicEquations::function(p, equations_->azimuth(k));
    for (int node = 0; node < static_cast<int>(state_.nodes.size()); ++node) {
      const NodeFreedom& freedom = system_.kinematics().freedom(node);
      if (freedom.rotations != 3 || system_.kinematics().carry(node)) continue;
      const int at = freedom.begin + freedom.count - 3;
      const MatrixX Theta = orbit.q.middleRows(at, 3) * e, turned = step.middleRows(at, 3) * e;
      MatrixX change(3, equations_->count());
      for (int k = 0; k < equations_->count(); ++k)
        change.col(k) =
            log_so3(Matrix3(exp_so3(Vector3(turned.col(k))) * exp_so3(Vector3(Theta.col(k))))) - Vector3(Theta.col(k));
      step.middleRows(at, 3) = change * e.transpose() / equations_->count();
    }
  }

  /// Adds the shift in time and the size of the deviation.
  PeriodicOrbit whole(PeriodicDeviation deviation) const {
    const int functions = 2 * deviation.harmonics + 1;
    PeriodicOrbit orbit;
    if (!held_) orbit.shift = MatrixX::Zero(equations_->unknowns(), functions);
    for (int k = 0; k < equations_->count(); ++k) {
      const VectorX here = equations_->rates(k, deviation) / equations_->count();
      for (int p = 0; p < static_cast<int>(orbit.shift.cols()); ++p)
        orbit.shift.col(p) += PeriodicEquations::function(p, equations_->azimuth(k)) * here;
      const std::vector<NodeState> nodes = equations_->state(k, deviation).nodes;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const NodeState& mean = equations_->mean(k).state.nodes[i];
        orbit.rotation = std::max(orbit.rotation, log_so3(Matrix3(mean.R.transpose() * nodes[i].R)).norm());
        const double distance = (nodes[i].x - mean.x).norm();
        if (distance <= orbit.displacement) continue;
        orbit.displacement = distance;
        orbit.moved = static_cast<int>(i);
      }
    }
    orbit.deviation = std::move(deviation);
    return orbit;
  }

  /// Tells whether the last two harmonics are negligible.
  bool resolved(const PeriodicDeviation& orbit) const {
    // A part that turns freely has a double zero exponent, which an error splits by the square root of its size.
    const double negligible = free_ ? 1e-12 : 1e-10, share = free_ ? 1e-10 : 1e-8;
    std::array<double, kind_count> largest{}, last{};
    const int h = orbit.harmonics;
    for (int i = 0; i < equations_->unknowns(); ++i) {
      const VectorX sizes = orbit.sizes(i);
      const auto kind = static_cast<std::size_t>(system_.kind(i));
      largest[kind] = std::max(largest[kind], sizes.maxCoeff());
      last[kind] = std::max(last[kind], sizes.tail(2).maxCoeff());
    }
    const double of_lengths[] = {length_, 1};  // translations, rotations
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      if (last[kind] > std::max(share * largest[kind], kind < 2 ? negligible * of_lengths[kind] : 0)) return false;
    return h > 0;
  }

  const System& system_;
  const Environment& environment_;
  const State& state_;
  const TurningPart& part_;
  double rate_, length_;
  double made_ = 0;  ///< fraction of the alternating forces up to which the motion was last followed
  VectorX gap_sizes_;
  VectorX sizes_;                     ///< forces relative to which residuals are small
  bool free_ = false, held_ = false;  ///< whether no drive acts on the joint; whether a drive prescribes its angle
  std::unique_ptr<const OrbitEquations> equations_;
  std::unique_ptr<const PeriodicEquations> periodic_;
  LinearisedEquations harmonics_;
  std::unique_ptr<ShiftedOperator> operator_;
};

}  // namespace

std::optional<PeriodicOrbit> find_periodic_orbit(const System& system, const Environment& environment,
                                                 const State& state, const TurningPart& part, double rate) {
  return OrbitSearch(system, environment, state, part, rate).find();
}

}  // namespace bielle::mechanism

// Force law of several measures m of the relative position of two nodes (up to six, in m and rad):
//
//     N = N_0 + K m + D mdot + n(m) + K_f(w) m + D_f(w) mdot + sum over branches K_b (m - z_b),
//     zdot_b = (m - z_b)/tau_b,
//
// The forces and moments N resist growth, K and D have positive semidefinite symmetric parts, and n are curves, each of
// one measure. K_f and D_f are the coefficients of a film over a speed w, a formula of the state. A branch is a spring
// K_b and a damper tau_b K_b in series (Maxwell), and z_b is the elongation of its damper, a first-order unknown. Its
// force is K_b m initially, zero finally, and K_b i w tau/(1 + i w tau) in a vibration of circular frequency w. At rest
// (statics) all branches are relaxed. Energies:  V = N_0 . m + m . K m/2 + integral of n dm + sum (m - z_b) . K_b (m -
// z_b)/2, dissipation  mdot . D mdot + sum (m - z_b) . K_b (m - z_b)/tau_b. An antisymmetric part K_a of K (a rotating
// fluid or shaft with internal damping) has no potential: its power, -mdot . K_a m, counts as input. So does that of
// all of K_f, which changes with the speed; that of D_f is dissipated.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/laws/film_coefficients.hpp"
#include "mechanism/laws/force_curve.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

struct MaxwellBranch {
  Matrix6 K = Matrix6::Zero();
  double time = 0;  ///< relaxation time tau [s]
};

/// Coefficients over a speed that a formula of t and measures gives.
struct SpeedFilm {
  FilmCoefficients coefficients;
  StateFormula speed;  ///< [rad/s]
  double speed_at(const LocalState& state) const;
};

class ElasticLaw {
 public:
  static constexpr std::size_t most = 6;
  using Measures = std::array<PairMeasure, most>;
  /// @param names  names of the measures @param turning  whether each is in rad
  explicit ElasticLaw(std::vector<std::string> names, std::vector<bool> turning);
  std::size_t size() const { return names_.size(); }
  const std::string& measure_name(std::size_t k) const { return names_[k]; }
  bool is_turn(std::size_t k) const { return turning_[k]; }

  Matrix6 K = Matrix6::Zero(), D = Matrix6::Zero();  ///< entries beyond `size` are zero
  Vector6 preload = Vector6::Zero();                 ///< N_0
  std::array<std::optional<ForceCurve>, most> curves;
  std::optional<SpeedFilm> film;
  void add(MaxwellBranch branch);
  const std::vector<MaxwellBranch>& branches() const { return branches_; }

  /// Declares stiffness, damping, kinks and first-order unknowns.
  void declare(Declaration& declaration) const;
  bool has_damping() const { return film || !D.isZero(0); }

  /// Computes N at a state of the component that owns the law. @param m  the measures; gradients are only read if rates
  /// matter
  Vector6 force(const LocalState& state, const Measures& m) const;
  /// N with its derivatives.
  struct Slopes {
    Vector6 N;
    Eigen::Matrix<double, 6, 12> by_position, by_rate;  ///< by positions and velocities of the two nodes
    MatrixX by_unknown;                                 ///< by the first-order unknowns, six rows
    Vector6 by_speed;                                   ///< by the speed of the film, which the others omit
  };
  /// @param m  measures with second derivatives
  Slopes slopes(const LocalState& state, const Measures& m) const;
  // Adds the forces to a component whose first twelve local rows are those of the two nodes.
  void add_residual(const LocalState& state, const Measures& m, Eigen::Ref<VectorX> r) const;
  /// @param m  measures with second derivatives
  void add_tangent(const LocalState& state, const Measures& m, LocalTangent& tangent) const;
  /// Adds the derivatives of the film's speed, times a factor, to a gradient over the local layout.
  void add_by_speed(const LocalState& state, double factor, MeasureGradient& gradient) const;
  void add_energy(const LocalState& state, const Measures& m, Energy& energy) const;
  /// Describes the law in words.
  std::vector<std::string> describe() const;

 private:
  struct Unknown {
    std::size_t branch;
    Eigen::Index direction;
  };
  /// Adds the derivatives through the film's speed. @param column  derivatives of the first twelve rows by the speed
  void add_speed_tangent(const LocalState& state, const Vector12& column, LocalTangent& tangent) const;
  Vector6 values(const Measures& m) const;
  Vector6 rates(const LocalState& state, const Measures& m) const;
  Eigen::Matrix<double, 6, 12> gradients(const Measures& m) const;
  /// Returns m - z of a branch.
  Vector6 stretch(std::size_t branch, const LocalState& state, const Vector6& e) const;
  std::vector<std::string> names_;
  std::vector<bool> turning_;
  std::vector<MaxwellBranch> branches_;
  std::vector<Unknown> unknowns_;  ///< one for each direction in which a branch has a stiffness
};

}  // namespace bielle::mechanism

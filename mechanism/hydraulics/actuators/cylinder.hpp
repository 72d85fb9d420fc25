// Hydraulic cylinder between two points of two nodes: the pressures in the chambers of a circuit push or pull its ends.
//
// With the distance l of the points, chambers k of the volume V_k(l) (chamber_space.hpp) and the pressures p_k, the
// force
//     F = sum (p_k - p_a) dV_k/dl - F_f(ldot) + F_s(l, ldot)
// pushes the points apart: chamber 1 extends the cylinder, dV_1/dl = A_1, chamber 2 retracts it, dV_2/dl = -A_2; the
// ambient pressure acts on the rod. F_f is the friction of the seals (laws/friction_law.hpp with N = 1), F_s that of
// the stops at the ends of the stroke: k x + d xdot while it pushes, with the distance x beyond the end, like stops in
// joints. The chamber volumes belong to the volumes of fluid into which the chambers open.
//
// Start pressures that are not given follow from the load: the initial acceleration of the cylinder's length is zero,
// and the chamber with the smaller force is at the tank's pressure.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/hydraulics/actuators/chamber_space.hpp"
#include "mechanism/hydraulics/circuit/ports.hpp"
#include "mechanism/hydraulics/circuit/volume.hpp"
#include "mechanism/laws/friction_law.hpp"
#include "mechanism/measures/pair_measure.hpp"

namespace bielle::mechanism {

class Cylinder final : public Component {
 public:
  struct Geometry {
    int node_a, node_b;
    Vector3 at_a, at_b;         ///< attachment points [m], in the axes of their nodes
    double shortest, longest;   ///< smallest and largest length of the stroke [m]
    double stop_stiffness = 0;  ///< [N/m]; 0: no stops
    double stop_damping = 0;    ///< [N s/m]
    std::optional<FrictionLaw> friction;
  };
  Cylinder(std::string name, Geometry geometry, double fluid_ambient);
  /// Adds a chamber that opens into a place with a volume, or with a given pressure.
  void add_chamber(const PressureNode& place, ChamberSpace space);
  /// Computes the start pressures from the load; each chamber must be a volume of its own.
  void balance(double tank_pressure) { tank_ = tank_pressure; }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const override;
  void begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  /// Outputs: `pressure` (of the chambers), `flow`, `length`, `rate`, `force`, `friction_force`, `stop_force`.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  std::unique_ptr<StepRecorder> make_step_recorder() const override;
  const Geometry& geometry() const { return geometry_; }
  /// The names are length, length.rate, force, pressure_1, pressure_2.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  /// Returns the distance of the points with its derivatives over the twelve unknowns of the nodes.
  PairMeasure length(const LocalState& state) const;

 private:
  friend class CylinderMeasure;
  enum { memory_side, memory_length };  ///< side of a stop; length, after that of the stop
  struct Chamber {
    ChamberSpace space;
  };
  struct Stop {
    double side = 0;  ///< +1 at the long end, -1 at the short one
    double way = 0;   ///< distance x beyond the end [m]
    double push = 0;  ///< magnitude of F_s [N]
  };
  bool waits(const LocalState& state) const;
  Stop stop(const LocalState& state, double l, double rate) const;
  double chamber_pressure(const LocalState& state, std::size_t k) const {
    return ports_.pressure(state, static_cast<int>(k));
  }
  /// The parts of F [N] and its derivatives.
  struct Push {
    double fluid = 0, friction = 0, stop = 0;
    double by_length = 0, by_rate = 0;
    double total() const { return fluid + friction + stop; }
  };
  Push push(const LocalState& state, double l, double rate) const;
  int space_row(const LocalState& state, std::size_t k) const;  ///< -1: none

  Geometry geometry_;
  double ambient_;
  std::vector<Chamber> chambers_;
  std::vector<const Volume*> volumes_;  ///< volume of each chamber; nullptr if the pressure is given
  Ports ports_;
  References references_;
  std::optional<double> tank_;
};

}  // namespace bielle::mechanism

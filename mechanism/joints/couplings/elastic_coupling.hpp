// Coordinates of joints coupled by a spring and a damper, with play: shafts between gears, teeth, belts, spindles.
//
// The deformation is e = sum_k f_k c_k (coordinate_coupling.hpp). Without backlash, F = k e + d edot. With the backlash
// b, from flank to flank, the coupling transmits no force while |e| < b/2; beyond, the flanks push each other by
// F = +-max(0, k p + d pdot), p = |e| - b/2: the law of stops at -b/2 and b/2 (laws/stop_law.hpp), so that one flank
// alone is in contact at any time.
#pragma once

#include "mechanism/joints/couplings/coordinate_coupling.hpp"
#include "mechanism/laws/stop_law.hpp"
#include "mechanism/model/open_contact.hpp"

namespace bielle::mechanism {

class ElasticCoupling final : public CoordinateCoupling, public OpenContact {
 public:
  struct Law {
    double stiffness;  ///< k > 0 [N m/rad], or [N/m] if e is a displacement
    double damping;    ///< d [N m s/rad] or [N s/m]
    double backlash;   ///< b [rad] or [m]
  };
  ElasticCoupling(std::string type, std::string name, const Law& law);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  /// Outputs: `force`, and `deformation`: e.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  /// The names are "deformation" and "force" (F).
  std::vector<std::string> measure_names() const override { return {"deformation", "force"}; }
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  std::string what_is_open(const LocalState& state) const override;

  /// Computes e or F with its derivatives over the local layout. @param gradient  zero on entry
  double calc_measure(bool force, const LocalState& state, MeasureGradient& gradient) const;
  const JointCoordinate& unit_of_sum() const { return unit(); }

 private:
  struct Force {
    double F = 0;
    bool acts = false;  ///< whether F changes with e
  };
  bool plays() const { return stops_.upper > 0; }
  CoordinateRate deformation(const LocalState& state) const;
  StopLaw::Contact contact(const LocalState& state, const CoordinateRate& e) const;
  Force force_of(const LocalState& state, const CoordinateRate& e) const;
  double force(const LocalState& state) const override { return force_of(state, deformation(state)).F; }
  /// Computes e with its gradients over the local layout: by positions g and h (of its rate).
  /// @param g,h  resized and zeroed by this function
  CoordinateRate calc_sum(const LocalState& state, VectorX& g, VectorX& h) const;
  StopLaw stops_;
};

}  // namespace bielle::mechanism

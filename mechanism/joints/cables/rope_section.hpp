// A rope, belt or chain between two places that grip it, or on which it slips with friction, over pulleys on which it
// slides without friction.
//
// The tension is constant along a section. With the lengths l of its spans (rope_span.hpp), the wraps theta of the
// touched pulleys of radius rho in between (rope_course.hpp), and the angles alpha + gamma by which its ends are wound,
//     L = sum of l + sum of rho theta,   E = L + rho_0 (alpha_0 + gamma_0) - rho_n (alpha_n + gamma_n) - (initially)
// are its length and its elongation. The slip s on the place at its end adds s to the elongation, and the slip on the
// place at its beginning adds -s (rope_slip.hpp). The tension is
//     T = max(0, EA (E + tau Edot)/(L - E)) while E > 0, and 0 otherwise;   L - E: unloaded length of that piece.
// Steps end when the rope leaves a pulley or touches it: the memory contains the touched ones. Drums wind and unwind
// rope, so that the section's stiffness EA/(L - E) changes with its length. The unloaded length of the rope that is
// wound equals the arc, without elastic creep. With the strain energy w = T^2/(2 EA) per unloaded length, the energy of
// the section therefore changes by -w d(L - E)/dt in addition to T Edot; this is counted as input (positive when rope
// is wound). Rope that slips over a place transfers the power T sdot from the section before it to the section after
// it, which is counted as input; the friction at the place balances this power and that of w (rope_friction.hpp). A
// belt is a chain of sections of one span each. A rope has no mass and cannot push: steps end when it becomes slack or
// taut.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/joints/cables/rope_course.hpp"
#include "mechanism/joints/cables/rope_slip.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct RopeMaterial {
  double EA;              ///< [N]
  double damping = 0;     ///< tau: time constant of its Kelvin-Voigt damping [s]
  double pretension = 0;  ///< initial tension [N]
};

/// The places that a rope passes, in order.
struct RopePath {
  std::vector<int> nodes;
  std::vector<std::string> names;
  std::vector<Pulley> pulleys;
  std::vector<Frame> drawn;  ///< initial frames of the nodes
  std::vector<int> turns;    ///< additional turns on each node
};

class RopeSection final : public Component {
 public:
  enum End : std::size_t { first_end, last_end };
  /// The slip at each end; nullptr: the rope is gripped there.
  using EndSlips = std::array<const RopeSlip*, 2>;
  /// @param path  at least two places
  /// @throws std::domain_error if pulleys overlap
  RopeSection(std::string type, std::string name, RopePath path, const RopeMaterial& material, EndSlips slips = {});

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  /// Outputs: `tension` [N], `elongation` [m], `length` [m].
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  std::string remark() const override;
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  /// The whole section at a state, along the increments of its nodes.
  struct Stretch {
    double E = 0, E_rate = 0, L = 0, tension = 0;
    double natural = 0;        ///< L - E: unloaded length of the piece [m]
    double strain_energy = 0;  ///< w = EA (E/(L - E))^2/2 while E > 0 [J/m]
    double pull = 0;           ///< EA (E + tau Edot)/(L - E): the tension of a section that could push as well [N]
    VectorX E_gradient, L_gradient;
    MatrixX E_second;                    ///< set by order 2 alone
    bool stretched = false;              ///< whether E > 0 on the present branch
    bool taut = false;                   ///< and under tension
    std::array<CoordinateRate, 2> ends;  ///< alpha + gamma there, relative to the initial value [rad]
    std::array<VectorX, 2> end_gradients;
    std::vector<RopePlace> places;
    std::vector<double> wrap_rates;  ///< for each place [rad/s]
  };
  /// @param order  2 with second derivatives, which `calc_pull_gradient` needs
  void calc_stretch(const LocalState& state, Stretch& stretch, int order = 1) const;
  /// Computes the derivatives of `pull` over the whole local layout. @param stretch  of order 2  @param gradient
  /// resized by this function
  void calc_pull_gradient(const LocalState& state, const Stretch& stretch, MeasureGradient& gradient) const;
  /// Adds the derivatives of `natural` over the whole local layout.
  void add_natural_gradient(const LocalState& state, const Stretch& stretch, double factor,
                            Eigen::Ref<VectorX> gradient) const;
  /// Returns the state of the slip at an end on which the rope slips.
  LocalState slip_at(const LocalState& state, End end) const { return state.of(slip_references_[end]); }
  int slip_row(const Slots& slots, End end) const { return slots.reference_row(slip_references_[end]); }
  /// Returns the row of the unknown that `RopeSlip::change` names.
  int change_row(const LocalState& state, End end) const {
    return slip_row(state.slots(), end) + RopeSlip::change(slip_at(state, end)).unknown;
  }
  const RopeMaterial& material() const { return material_; }
  const RopePath& path() const { return path_; }
  /// Returns the initial value of alpha + gamma at an end.
  double drawn_end(End end) const { return drawn_ends_[end]; }
  double drawn_length() const { return drawn_length_; }  ///< [m]

 private:
  // Memory: the time of the last accepted step, whether the rope is taut; then angle and rate of both ends; then sense,
  // wrap and its rate for each place between them.
  enum : Eigen::Index { time_memory, taut_memory, ends_memory, places_memory = 6 };
  static Eigen::Index memory_of(int place) { return places_memory + 3 * (place - 1); }
  void get_poses(const LocalState& state, std::vector<Frame>& at) const;
  void get_places(const LocalState& state, std::vector<RopePlace>& places) const;
  void remember_places(const std::vector<RopePlace>& places, Eigen::Ref<VectorX> memory) const;
  void calc_along(const LocalState& state, Stretch& stretch, int order = 1) const;
  bool is_stretched(const LocalState& state, double E) const;
  template <class Act>
  void for_each_slip(const LocalState& state, const Act& act) const;
  template <int order>
  CoordinateRate add_span(const LocalState& state, const RopeCourse& course, std::size_t s,
                          const CoordinateRate& arriving, Stretch& stretch) const;
  double count_wrap(const LocalState& state, int place, double radius, const CoordinateRate& leaving,
                    const CoordinateRate& arriving, Stretch& stretch) const;
  void check_way(const LocalState& state, int i, int j, double least) const;

  RopePath path_;
  RopeCourses courses_;
  RopeMaterial material_;
  References references_;                          ///< the slips at its ends
  std::array<int, 2> slip_references_ = {-1, -1};  ///< number of the slip among them; -1: none
  std::vector<RopePlace> drawn_places_;
  std::vector<int> watched_;            ///< places that the rope may leave
  std::array<double, 2> drawn_ends_{};  ///< initial alpha + gamma at both ends
  double E_drawn_ = 0;                  ///< elongation by the pretension
  double drawn_length_ = 0;
};

const KeyTable& belt_keys();
const KeyTable& cable_keys();
/// Reads `belt: {nodes, radii, axis, EA, pretension, damping, friction}`, a closed rope that every pulley grips unless
/// it slips.
void read_belt(const std::string& name, const YamlValue& entry, Model& model);
/// Reads `cable: {nodes, radii, axis, at, grips, friction, turns, EA, pretension, damping}`, a rope from the first node
/// to the last.
void read_cable(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism

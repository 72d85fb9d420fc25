// Contact between shapes that are fixed on nodes: they repel each other if they touch.
//
// One component contains all pairs of a group of shapes. Each pair is a penalty contact (pair_force.hpp); only pairs
// whose bounding spheres overlap are evaluated (near_pairs.hpp), and only pairs that are near have entries in the
// tangent (CoupledPairs). With a `restitution`, the damping of a pair follows from its
// approach speed at the beginning of contact: steps end at this event (the event function is the smallest gap of the
// separated pairs), and the damping is kept in the memory until the pair separates. With a `damping`, steps do not end
// at the beginning of contact: the forces are continuous.
//
// A shape that is thinner than its displacement in a step might pass through another shape undetected. A trial state in
// which this happens, along the straight line from the position at the step's start, is rejected: the step is
// shortened. A trial state is also rejected if shapes that touch at either end of the step move by more than half their
// thickness. The outward direction is undetermined if the penetration is deeper than the skins of both shapes, or if a
// shape has passed the middle of the other: the run then ends. It also ends if the middle of a shape has passed a
// plane.
//
// Memory: [time and middles of the shapes at the last accepted step | with a restitution: damping of each pair, -1
// while apart | with bristles: x and R of the nodes; the number of bristles, and pair,
// touch, deflection and place of each, by pairs].
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/contacts/near_pairs.hpp"
#include "mechanism/contacts/pair_force.hpp"
#include "mechanism/model/coupled_pairs.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/open_contact.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Contact final : public Component, public CoupledPairs, public OpenContact {
 public:
  /// @param pairs  numbers of the shapes that may touch, the smaller first
  Contact(std::string name, std::vector<ContactShape> shapes, std::vector<std::pair<int, int>> pairs, SurfaceLaw law);

  /// Finds the pair with the deepest initial penetration. Returns a clause for the message, empty if nothing
  /// penetrates, and the depth relative to the size.
  /// @throws InputError if the direction of the penetration is undetermined
  std::pair<std::string, double> drawn_into_each_other(const Model& model) const;
  void set_remark(std::string remark) { remark_ = std::move(remark); }

  /// The pair of shapes with the smallest gap; -1: none. With `apart_only`, only pairs that do not touch according to
  /// the memory are considered.
  struct NearestPair {
    int pair;
    PairForce::Nearest found;
  };
  NearestPair nearest_of_all(const LocalState& state, bool apart_only = false) const;
  /// Calls act(pair, force on its second shape) for each pair that touches.
  template <class Act>
  void for_each_touching(const LocalState& state, const Act& act) const {
    std::vector<int> near;
    find_near(state, near);
    for (const int pair : near)
      if (const PairForce::Result result = acting(state, pair); result.depth > 0) act(pair, result.force);
  }
  /// Computes the derivatives of a pair's residual by positions and by rates of its two nodes.
  void calc_tangent_of(const LocalState& state, int pair, Matrix12& K, Matrix12& C) const {
    force_of(state, pair).calc_tangent(law_of(state), damping(state, pair), bristles(state, pair), K, C);
  }
  std::array<int, 2> nodes_of(int pair) const {
    const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
    return {local_node(a), local_node(b)};
  }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_near_nodes(const LocalState& state, std::vector<std::pair<int, int>>& near) const override;
  void add_pair_tangents(const LocalState& state, PairDerivatives& sum) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  std::string remark() const override { return remark_; }
  /// gap, touching, force; and force.x, y, z if each shape is always the first of its pairs, or always the second.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  std::string what_is_open(const LocalState& state) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  bool knows_memory(const LocalState& state) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;

 private:
  bool remembers_touches() const { return law_.normal.restitution > 0; }
  int local_node(int shape) const { return local_node_[static_cast<std::size_t>(shape)]; }
  const ContactShape& shape(int k) const { return shapes_[static_cast<std::size_t>(k)]; }
  PairForce force_of(const LocalState& state, int pair) const;
  template <class Act>
  auto of_pair(const LocalState& state, int pair, const Act& act) const;
  PairForce::Result acting(const LocalState& state, int pair) const;
  PairForce::Nearest nearest(const LocalState& state, int pair) const;
  double damping(const LocalState& state, int pair) const;
  bool has_bristles() const { return law_.friction && law_.friction->model == FrictionLaw::Model::lugre; }
  /// Returns the law of the surfaces; in statics the law without friction, because nothing slides and bristles keep
  /// their values.
  const SurfaceLaw& law_of(const LocalState& state) const { return state.environment().statics ? frictionless_ : law_; }
  /// Returns the bristles of a pair at the last accepted step. The reference is valid until the next call in the same
  /// thread.
  const Bristles& bristles(const LocalState& state, int pair) const;
  void remember_bristles(const LocalState& state, const std::vector<int>& near, Eigen::Ref<VectorX> memory) const;
  Eigen::Index dampings_begin() const { return 1 + 3 * static_cast<Eigen::Index>(shapes_.size()); }
  Eigen::Index bristles_begin() const {
    return dampings_begin() + (remembers_touches() ? static_cast<Eigen::Index>(pairs_.size()) : 0);
  }
  Eigen::Index bristle_count() const { return bristles_begin() + 12 * static_cast<Eigen::Index>(nodes_.size()); }
  static constexpr Eigen::Index bristle_entry = 8;  ///< pair, Touch::id, z, place
  Vector3 middle(const LocalState& state, int shape) const;
  const std::vector<NearPairs::Bound>& bounds(const LocalState& state) const;
  void find_near(const LocalState& state, std::vector<int>& pairs) const;
  void check_depth(const LocalState& state, int pair, const PairForce::Nearest& found) const;
  bool has_turned_over(const LocalState& state, int pair, const PairForce::Nearest& found) const;
  void remember(const LocalState& state, Eigen::Ref<VectorX> memory) const;
  void check_passage(const LocalState& state) const;
  void check_passage_of(const LocalState& state, int pair, const Vector3& way, double turn) const;
  void check_passage_of_surface(const LocalState& state, int pair, const Vector3& way) const;
  /// Nearest places with the second shape of the pair moved back by `way`.
  PairForce::Nearest nearest_before(const LocalState& state, int pair, const Vector3& way) const;
  [[noreturn]] void fail_passage(const LocalState& state, int pair, const Vector3& way) const;
  bool has_surface(int a, int b) const;  ///< whether one shape is a triangulated surface and the other is not a plane
  double passage(int a, int b) const;    ///< twice the distance that a pair may move in a step without a check [m]
  double height_of_middle(const LocalState& state, int plane, int other) const;
  std::string shape_name(int k) const;
  std::string pair_name(int pair) const;

  std::vector<ContactShape> shapes_;
  std::vector<std::pair<int, int>> pairs_;
  SurfaceLaw law_, frictionless_;
  Eigen::Index most_bristles_ = 0;
  std::vector<int> nodes_, local_node_;
  NearPairs near_pairs_;
  bool divided_ = true;  ///< whether no shape is the first of one pair and the second of another
  double thinnest_ = 0;  ///< smallest passage of a pair [m]
  std::string remark_;
};

const KeyTable& contact_keys();
/// Reads `{shapes: [..] | between: [[..], [..]], stiffness, exponent, restitution | damping, friction: {..}}`.
void read_contact(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism

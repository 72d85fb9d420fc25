#include "mechanism/elements/superelement/superelement_body.hpp"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "mechanism/elements/superelement/frame_conditions.hpp"
#include "mechanism/elements/superelement/known_state.hpp"
#include "mechanism/elements/superelement/recovery/stress_peaks.hpp"
#include "mechanism/elements/superelement/stress_completeness.hpp"
#include "mechanism/elements/superelement/superelement_body_tangent.hpp"
#include "mechanism/elements/superelement/validity.hpp"
#include "mechanism/model/step_recorder_list.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

struct SuperelementBody::Workspace {
  SuperelementMotion motion;
  SuperelementTangent tangent;
  std::vector<AttachedPoint> points;
  FrameBlock frames;
  KnownState state;  ///< state of `motion` and `points`
  /// Parts of `motion` that are known at this state; `motion` stands for accelerations and points.
  struct {
    bool positions = false, products = false, velocities = false, mean_turning = false, motion = false, loads = false,
         forces = false;
  } known;

  /// Forgets the parts that depend on numbers in which a state differs from the one before.
  void forget(KnownState::Change change) {
    using enum KnownState::Change;
    if (change == none) return;
    known.motion = known.loads = known.forces = false;
    if (change == others) return;
    known.velocities = known.mean_turning = false;
    if (change == velocities) return;
    known.positions = known.products = false;
  }
};

/// One workspace for each thread that evaluates the body concurrently. They are kept, so that memory is allocated only
/// once.
class SuperelementBody::Workspaces {
 public:
  std::unique_ptr<Workspace> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<Workspace>();
    auto workspace = std::move(idle_.back());
    idle_.pop_back();
    return workspace;
  }
  void give_back(std::unique_ptr<Workspace> workspace) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(workspace));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> idle_;
};

class SuperelementBody::Loan {
 public:
  explicit Loan(Workspaces& workspaces) : workspaces_(workspaces), workspace_(workspaces.take()) {}
  Loan(Loan&&) = default;
  ~Loan() {
    if (workspace_) workspaces_.give_back(std::move(workspace_));
  }
  Workspace* operator->() const { return workspace_.get(); }

 private:
  Workspaces& workspaces_;
  std::unique_ptr<Workspace> workspace_;
};

namespace {

/// Returns the interfaces with their nodes of the mechanism.
std::vector<BodyPoint> placed_points(const SuperelementMatrices& matrices, const SuperelementPlacement& placement) {
  std::vector<BodyPoint> points = matrices.points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].X = placement.reference_positions[k];
    points[k].R_ref = placement.reference_rotations[k];
  }
  return points;
}

MatrixX6 frame_conditions(const SuperelementMatrices& matrices, const SuperelementPlacement& placement) {
  switch (placement.frame) {
    case BodyFrame::mean_axes:
      return mean_axes_conditions(matrices);
    case BodyFrame::carried:
      return carried_conditions(matrices, placement.frame_interface);
    case BodyFrame::mean:
      break;
  }
  return mean_conditions(matrices);
}

}  // namespace

SuperelementBody::~SuperelementBody() = default;

SuperelementBody::SuperelementBody(std::string name, const Superelement& superelement, SuperelementPlacement placement)
    : Component("superelement", std::move(name)),
      matrices_(placement.matrices ? std::move(placement.matrices)
                                   : std::make_shared<const SuperelementMatrices>(superelement)),
      frame_(placed_points(*matrices_, placement), frame_conditions(*matrices_, placement), matrices_->gyration),
      nodes_(std::move(placement.nodes)),
      workspaces_(std::make_unique<Workspaces>()) {
  for (SuperelementPlacement::Load& load : placement.loads) {
    const auto& names = matrices_->pattern_names;
    const auto found = std::find(names.begin(), names.end(), load.pattern);
    if (found == names.end())
      throw InputError(
          fmt::format("superelement '{}' has no load '{}'{}", superelement.name, load.pattern,
                      names.empty() ? std::string("; it has none at all") : did_you_mean(load.pattern, names)));
    loads_.push_back({static_cast<std::size_t>(found - names.begin()), std::move(load.factor), load.follows});
  }
  if (placement.damping.size() > 0) damping_ = matrices_->in_rows(placement.damping);
  file_ = placement.file;
  largest_error_ = placement.largest_error;
  attributes_ = {{"file", file_.path}, {"superelement", superelement.name}};
  if (file_.group != "/") attributes_.emplace_back("group", file_.group);
  for (const Interface& interface : superelement.interfaces) interfaces_.push_back(interface.name);
  frequencies_ = superelement.frequencies.head(superelement.fixed_boundary_modes());
  residual_vectors_ = superelement.residual_vectors;
  mode_turns_ = superelement.mode_turns;
  inertia_answer_ = superelement.inertia_answer;
  for (std::size_t k = 0; k < placement.node_names.size(); ++k)
    attributes_.emplace_back("interface " + superelement.interfaces[k].name, placement.node_names[k]);
}

void SuperelementBody::declare(Declaration& declaration) const {
  declaration.nodes = nodes_;
  for (const Point& point : points_) {
    declaration.nodes.push_back(point.node);
    for (int k = 0; k < 6; ++k)
      declaration.multipliers.push_back(
          {fmt::format("{} {} at point '{}'", k < 3 ? "force" : "moment", "xyz"[k % 3], point.name),
           k < 3 ? "N" : "N m"});
  }
  for (int k = 1; k <= matrices_->modes; ++k) declaration.amplitudes.push_back({fmt::format("mode {}", k), "m kg^0.5"});
  declaration.stiffness = declaration.damping = declaration.mass = true;
}

SuperelementBody::Loan SuperelementBody::evaluate_positions(const LocalState& state) const {
  Loan work(*workspaces_);
  work->forget(work->state.next(state));
  if (work->known.positions) return work;
  try {
    work->motion.set_positions(*matrices_, frame_, state);
  } catch (const ComputationError& error) {
    throw ComputationError(
        fmt::format("t = {:.6g} s: superelement '{}': {}. The cause is a step that is too long, nodes that no joint "
                    "holds, or a body far too soft for its loads (young in Pa?)",
                    state.time(), name(), error.what()));
  }
  work->known.positions = true;
  return work;
}

void SuperelementBody::complete_velocities(const Loan& work, const LocalState& state) const {
  if (work->known.velocities) return;
  work->motion.set_velocities(*matrices_, frame_, state);
  work->known.velocities = true;
}

void SuperelementBody::complete_products(const Loan& work) const {
  if (work->known.products) return;
  work->motion.set_products(*matrices_);
  work->known.products = true;
}

void SuperelementBody::complete_mean_turning(const Loan& work, const LocalState& state) const {
  if (work->known.mean_turning) return;
  complete_velocities(work, state);
  complete_products(work);
  work->motion.set_mean_turning(*matrices_);
  work->known.mean_turning = true;
}

void SuperelementBody::complete_loads(const Loan& work, const LocalState& state) const {
  if (work->known.loads) return;
  work->motion.loads.clear();
  for (const Load& load : loads_)
    work->motion.loads.push_back({&matrices_->patterns[load.pattern],
                                  state.environment().load_factor * load.factor(state.time()), load.follows});
  work->motion.set_loads(*matrices_);
  work->known.loads = true;
}

SuperelementBody::Loan SuperelementBody::evaluate_motion(const LocalState& state) const {
  Loan work = evaluate_positions(state);
  if (work->known.motion) return work;
  complete_velocities(work, state);
  work->motion.set_accelerations(*matrices_, frame_, state);
  work->points.clear();
  for (std::size_t i = 0; i < points_.size(); ++i)
    work->points.emplace_back(points_[i].place, work->motion, state.node(static_cast<int>(nodes_.size() + i)),
                              state.multiplier().segment<6>(6 * static_cast<Eigen::Index>(i)),
                              state.environment().gravity);
  work->known.motion = true;
  return work;
}

SuperelementBody::Loan SuperelementBody::evaluate(const LocalState& state) const {
  Loan work = evaluate_motion(state);
  if (work->known.forces) return work;
  complete_mean_turning(work, state);
  complete_loads(work, state);
  SuperelementMotion& motion = work->motion;
  if (!work->points.empty()) {
    motion.attached_force.setZero(matrices_->size());
    motion.attached_wrench.setZero();
  }
  for (const AttachedPoint& point : work->points) {
    motion.attached_force += point.body_force();
    motion.attached_wrench += point.wrench();
  }
  motion.set_forces(*matrices_, damping());
  work->known.forces = true;
  return work;
}

void SuperelementBody::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Loan work = evaluate(state);
  const SuperelementMotion& motion = work->motion;
  const Matrix3& R_0 = motion.geometry.frame.R;
  for (std::size_t k = 0; k < matrices_->points.size(); ++k) {
    const BodyPoint& point = matrices_->points[k];
    const auto row = static_cast<Eigen::Index>(6 * k);
    r.segment<3>(row) += R_0 * motion.node_force.segment<3>(point.u);
    if (point.theta >= 0)
      r.segment<3>(row + 3) +=
          state.node(static_cast<int>(k)).R.transpose() * (R_0 * motion.node_force.segment<3>(point.theta));
  }
  r.segment(state.slots().amplitude_row(), matrices_->modes) += motion.node_force.tail(matrices_->modes);
  for (std::size_t i = 0; i < work->points.size(); ++i) {
    const AttachedPoint& point = work->points[i];
    const auto node = static_cast<int>(nodes_.size() + i);
    r.segment<3>(6 * node) += R_0 * point.node_force().head<3>();
    r.segment<3>(6 * node + 3) += state.node(node).R.transpose() * (R_0 * point.node_force().tail<3>());
    r.segment<6>(state.slots().multiplier_row() + 6 * static_cast<Eigen::Index>(i)) += point.gap();
  }
}

void SuperelementBody::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                            Eigen::Ref<VectorX> acceleration) const {
  const Loan work = evaluate_motion(state);
  for (std::size_t i = 0; i < work->points.size(); ++i) {
    velocity.segment<6>(6 * static_cast<Eigen::Index>(i)) += work->points[i].gap_rate();
    acceleration.segment<6>(6 * static_cast<Eigen::Index>(i)) += work->points[i].gap_acceleration();
  }
}

void SuperelementBody::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const bool mass_alone = !tangent.wants_C && !tangent.wants_K;
  const Loan work = mass_alone ? evaluate_positions(state) : evaluate(state);
  complete_products(work);
  work->tangent.add(*matrices_, damping(), work->motion, state, work->points, tangent);
}

void SuperelementBody::add_energy(const LocalState& state, Energy& energy) const {
  const Loan work = evaluate_positions(state);
  complete_mean_turning(work, state);
  complete_loads(work, state);
  SuperelementMotion& motion = work->motion;
  const Frame& frame = motion.geometry.frame;
  const VectorX& eps = motion.coordinates.eps();
  energy.kinetic += motion.kinetic_energy(*matrices_);
  energy.elastic += motion.elastic_energy();
  const Vector3 moment = matrices_->mass * matrices_->centre + matrices_->MU.leftCols<3>().transpose() * eps;
  energy.gravity -= state.environment().gravity.dot(matrices_->mass * frame.x + frame.R * moment);
  energy.dissipation += motion.dissipation(damping());
  energy.input += motion.rigid_load.dot(motion.nu) + motion.load.dot(motion.eps_rate);
}

Eigen::Index SuperelementBody::coordinates() const {
  return static_cast<Eigen::Index>(matrices_->directions.size()) + matrices_->modes;
}

std::vector<OutputField> SuperelementBody::output_fields() const {
  std::vector<OutputField> outputs = {
      {"frame", {7}, "m, -", "body frame: position of the mesh's origin, unit quaternion w x y z (body -> inertial)"},
      {"coordinates",
       {static_cast<std::size_t>(coordinates())},
       "m, rad, m kg^0.5",
       "linear coordinates of the deformation, in the order of the superelement file"},
      {"interface_force",
       {matrices_->points.size(), 6},
       "N, N m",
       "force and moment that the mechanism exerts at each interface, body axes"}};
  const std::vector<OutputField>& recovered = recovered_.descriptions();
  outputs.insert(outputs.end(), recovered.begin(), recovered.end());
  return outputs;
}

const double* SuperelementBody::write_small_outputs(const LocalState& state, double* values) const {
  const Loan work = evaluate(state);
  const SuperelementMotion& motion = work->motion;
  const Frame& frame = motion.geometry.frame;
  Eigen::Map<VectorX>(values, 3) = frame.x;
  Eigen::Map<VectorX>(values + 3, 4) = quaternion_of(frame.R);
  values += 7;
  const double* q = values;
  matrices_->to_file(motion.coordinates.eps(), Eigen::Map<VectorX>(values, coordinates()));
  values += coordinates();
  for (const BodyPoint& point : matrices_->points) {
    Eigen::Map<Vector6> force(values);
    force.setZero();
    force.head<3>() = motion.node_force.segment<3>(point.u);
    if (point.theta >= 0) force.tail<3>() = motion.node_force.segment<3>(point.theta);
    values += 6;
  }
  return q;
}

void SuperelementBody::write_output(const LocalState& state, double* values) const {
  write_outputs({&state, 1}, {&values, 1});
}

void SuperelementBody::write_outputs(std::span<const LocalState> states, std::span<double* const> values) const {
  Loan work(*workspaces_);
  work->frames.reset(coordinates(), static_cast<int>(states.size()));
  for (std::size_t k = 0; k < states.size(); ++k)
    work->frames.set(static_cast<int>(k), write_small_outputs(states[k], values[k]));
  const std::size_t small = static_cast<std::size_t>(7 + coordinates()) + 6 * matrices_->points.size();
  recovered_.write(work->frames, values, small);
}

std::vector<std::string> SuperelementBody::field_names() const { return RecoveredField::names(); }

void SuperelementBody::record_field(const std::string& field) { recovered_.add_field(field, read_superelement(file_)); }

void SuperelementBody::record_quantity(const std::string& name) {
  recovered_.add_quantity(name, read_superelement(file_));
}

std::vector<std::string> SuperelementBody::point_field_names() const { return {"stress", "strain"}; }

void SuperelementBody::record_at(const std::string& field, const std::string& name, const MeshPlace& place) {
  recovered_.add_point(field, name, place, read_superelement(file_));
}

std::vector<std::string> SuperelementBody::peak_names() const { return StressPeaks::names(); }

void SuperelementBody::record_peaks(const std::vector<std::string>& quantities) {
  recovered_.load_stress(read_superelement(file_));
  peaks_ = quantities;
}

void SuperelementBody::read_deformation(const LocalState& state, BodyDeformation& deformation) const {
  const Loan work = evaluate_motion(state);
  complete_products(work);
  const SuperelementMotion& motion = work->motion;
  deformation.eps = motion.coordinates.eps();
  const Vector3 v_0 = motion.nu.head<3>(), Om = motion.nu.tail<3>(), Om_rate = motion.nu_rate.tail<3>();
  const Matrix3 gradient = skew(Om_rate) + skew(Om) * skew(Om);
  const Vector3 at_centre = motion.nu_rate.head<3>() + Om.cross(v_0) + gradient * matrices_->centre;
  for (int i = 0; i < 3; ++i) deformation.acceleration.segment<4>(4 * i) << at_centre[i], gradient.row(i).transpose();
  deformation.elastic = motion.elastic_energy();
}

std::unique_ptr<StepRecorder> SuperelementBody::make_step_recorder() const {
  std::vector<std::unique_ptr<StepRecorder>> all;
  auto reader = std::make_unique<DeformationReader>(
      [this](const LocalState& state, BodyDeformation& deformation) { read_deformation(state, deformation); });
  const std::shared_ptr<const BodyDeformation> now = reader->now();
  all.push_back(std::move(reader));
  all.push_back(std::make_unique<Validity>(
      name(), frame_.points(),
      ValidityMeasures{matrices_->gyration, mode_turns_, BodyStrain(*matrices_), largest_error_}, now));
  if (recovered_.has_stress() && inertia_answer_.whole.size() > 0)
    all.push_back(std::make_unique<StressCompleteness>(name(), inertia_answer_, now));
  if (!peaks_.empty())
    all.push_back(
        std::make_unique<StressPeaks>(name(), recovered_.stress(), peaks_, [this, now](const LocalState&, double* q) {
          matrices_->to_file(now->eps, Eigen::Map<VectorX>(q, coordinates()));
        }));
  return std::make_unique<StepRecorderList>(std::move(all));
}

std::vector<std::pair<std::string, std::string>> SuperelementBody::attributes() const {
  std::vector<std::pair<std::string, std::string>> all = attributes_;
  all.insert(all.end(), recovered_.facts().begin(), recovered_.facts().end());
  return all;
}

std::vector<TimeDependent::Formula> SuperelementBody::time_formulas() const {
  std::vector<Formula> formulas;
  for (const Load& load : loads_)
    if (!load.factor.is_constant())
      formulas.push_back({fmt::format("factor of load '{}'", matrices_->pattern_names[load.pattern]), ""});
  return formulas;
}

void SuperelementBody::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  std::size_t next = 0;
  for (const Load& load : loads_)
    if (!load.factor.is_constant()) values[next++] = load.factor(state.time());
}

void SuperelementBody::add_break_points(std::vector<double>& times) const {
  for (const Load& load : loads_)
    for (double time : load.factor.break_points()) times.push_back(time);
}

}  // namespace bielle::mechanism

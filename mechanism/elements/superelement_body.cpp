#include "mechanism/elements/superelement_body.hpp"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "mechanism/elements/superelement_body_tangent.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

struct SuperelementBody::Workspace {
  SuperelementMotion motion;
  SuperelementTangent tangent;
};

/// As many as threads have evaluated the body at once; kept, so that evaluations allocate nothing behind the first.
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

SuperelementBody::~SuperelementBody() = default;

SuperelementBody::SuperelementBody(std::string name, const Superelement& superelement, SuperelementPlacement placement)
    : Component("superelement", std::move(name)),
      matrices_(superelement, placement.reference_positions, placement.reference_rotations),
      frame_(matrices_.points, matrices_.A),
      nodes_(std::move(placement.nodes)),
      workspaces_(std::make_unique<Workspaces>()) {
  for (SuperelementPlacement::Load& load : placement.loads) {
    const auto& names = matrices_.pattern_names;
    const auto found = std::find(names.begin(), names.end(), load.pattern);
    if (found == names.end())
      throw InputError(
          fmt::format("superelement '{}' has no load '{}'{}", superelement.name, load.pattern,
                      names.empty() ? std::string("; it has none at all") : did_you_mean(load.pattern, names)));
    loads_.push_back({static_cast<std::size_t>(found - names.begin()), std::move(load.factor), load.follows});
  }
  file_ = placement.file;
  attributes_ = {{"file", placement.file}, {"superelement", superelement.name}};
  for (std::size_t k = 0; k < placement.node_names.size(); ++k)
    attributes_.emplace_back("interface " + superelement.interfaces[k].name, placement.node_names[k]);
}

void SuperelementBody::declare(Declaration& declaration) const {
  declaration.nodes = nodes_;
  for (int k = 1; k <= matrices_.modes; ++k) declaration.amplitudes.push_back({fmt::format("mode {}", k), "m kg^0.5"});
  if (!matrices_.load_stiffness.empty()) declaration.memory.assign(matrices_.directions.size(), 0.0);
  declaration.stiffness = declaration.damping = declaration.mass = true;
}

SuperelementBody::Loan SuperelementBody::evaluate(const LocalState& state) const {
  Loan work(*workspaces_);
  SuperelementMotion& motion = work->motion;
  try {
    motion.set_motion(frame_, state);
  } catch (const ComputationError& error) {
    throw ComputationError(fmt::format(
        "t = {:.6g} s: superelement '{}': {}. What drives them there is the cause: a step too long, nodes that "
        "no joint holds, or a body far too soft for its loads (young in Pa?)",
        state.time(), name(), error.what()));
  }
  motion.loads.clear();
  for (const Load& load : loads_)
    motion.loads.push_back(
        {&matrices_.patterns[load.pattern], state.environment().load_factor * load.factor(state.time()), load.follows});
  motion.set_forces(matrices_, state.memory());
  return work;
}

void SuperelementBody::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Loan work = evaluate(state);
  const SuperelementMotion& motion = work->motion;
  const Matrix3& R_0 = motion.geometry.frame.R;
  for (std::size_t k = 0; k < matrices_.points.size(); ++k) {
    const BodyPoint& point = matrices_.points[k];
    const auto row = static_cast<Eigen::Index>(6 * k);
    r.segment<3>(row) += R_0 * motion.node_force.segment<3>(point.u);
    if (point.theta >= 0)
      r.segment<3>(row + 3) +=
          state.node(static_cast<int>(k)).R.transpose() * (R_0 * motion.node_force.segment<3>(point.theta));
  }
  r.segment(state.slots().amplitude_row(), matrices_.modes) += motion.node_force.tail(matrices_.modes);
}

void SuperelementBody::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const Loan work = evaluate(state);
  work->tangent.add(matrices_, work->motion, state, tangent);
}

void SuperelementBody::add_energy(const LocalState& state, Energy& energy) const {
  const Loan work = evaluate(state);
  const SuperelementMotion& motion = work->motion;
  const CorotatedGeometry& geometry = motion.geometry;
  energy.kinetic += motion.kinetic_energy(matrices_);
  energy.elastic += 0.5 * geometry.q.dot(motion.elastic_force);
  // In the mean-axis frame the centre of mass does not move.
  energy.gravity -=
      matrices_.mass * state.environment().gravity.dot(geometry.frame.x + geometry.frame.R * matrices_.centre);
  energy.dissipation += motion.q_rate.dot(matrices_.C * motion.q_rate);
  energy.input += motion.rigid_load.dot(motion.nu) + motion.load.dot(motion.q_rate);
}

std::vector<OutputField> SuperelementBody::output_fields() const {
  const auto n = matrices_.directions.size() + static_cast<std::size_t>(matrices_.modes);
  std::vector<OutputField> outputs = {
      {"frame", {7}, "m, -", "body frame: position of the mesh's origin, unit quaternion w x y z (body -> inertial)"},
      {"coordinates", {n}, "m, rad, m kg^0.5", "local coordinates, in the order of the superelement file"},
      {"interface_force",
       {matrices_.points.size(), 6},
       "N, N m",
       "force and moment that the mechanism exerts at each interface, body axes"}};
  for (const RecoveredField& field : fields_) outputs.push_back(field.description());
  return outputs;
}

void SuperelementBody::write_output(const LocalState& state, double* values) const {
  const Loan work = evaluate(state);
  const SuperelementMotion& motion = work->motion;
  const Frame& frame = motion.geometry.frame;
  Eigen::Map<VectorX>(values, 3) = frame.x;
  Eigen::Map<VectorX>(values + 3, 4) = quaternion_of(frame.R);
  values += 7;
  const auto n = static_cast<Eigen::Index>(matrices_.directions.size()) + matrices_.modes;
  const Eigen::Map<VectorX> coordinates(values, n);
  matrices_.to_file(motion.geometry.q, Eigen::Map<VectorX>(values, n));
  values += n;
  for (const BodyPoint& point : matrices_.points) {
    Eigen::Map<Vector6> force(values);
    force.setZero();
    force.head<3>() = motion.node_force.segment<3>(point.u);
    if (point.theta >= 0) force.tail<3>() = motion.node_force.segment<3>(point.theta);
    values += 6;
  }
  for (const RecoveredField& field : fields_) {
    field.write(coordinates, values);
    values += field.description().size();
  }
}

std::vector<std::string> SuperelementBody::optional_fields() const { return RecoveredField::names(); }

void SuperelementBody::record_field(const std::string& field) { fields_.emplace_back(field, read_superelement(file_)); }

std::vector<std::pair<std::string, std::string>> SuperelementBody::attributes() const { return attributes_; }

void SuperelementBody::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (matrices_.load_stiffness.empty()) return;
  const Loan work = evaluate(state);
  const SuperelementMotion& motion = work->motion;
  for (std::size_t j = 0; j < matrices_.directions.size(); ++j) {
    const SuperelementMatrices::Direction& direction = matrices_.directions[j];
    memory[static_cast<Eigen::Index>(j)] = direction.axis.dot(motion.node_force.segment<3>(direction.row));
  }
}

void SuperelementBody::add_break_points(std::vector<double>& times) const {
  for (const Load& load : loads_)
    for (double time : load.factor.break_points()) times.push_back(time);
}

}  // namespace bielle::mechanism

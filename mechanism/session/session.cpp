#include "mechanism/session/session.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mechanism/measures/input_measure.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/begin_first_order.hpp"
#include "mechanism/solvers/start/redundancy_at_start.hpp"
#include "mechanism/solvers/start/rigid_start.hpp"
#include "mechanism/solvers/start/start_rates.hpp"
#include "mechanism/system/check_state.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

Session::Session(std::unique_ptr<const Model> owned, const Model* model, int threads)
    : owned_(std::move(owned)),
      model_(owned_ ? *owned_ : *model),
      system_(model_),
      environment_(model_.environment),
      acting_(environment_),
      state_(system_.start(0)),
      shown_(&state_),
      recorder_(system_) {
  system_.use_threads(threads);
  State assembled;
  redundant_ = name_constraints(system_, take_out_redundant_at_start(system_, environment_, state_, assembled));
  mobility_ = count_mobility(system_, environment_, assembled);
}

Session::Session(Model&& model, int threads)
    : Session(std::make_unique<const Model>(std::move(model)), nullptr, threads) {}

Session::Session(const Model& model, int threads) : Session(nullptr, &model, threads) {}

Session::~Session() { at_rest(); }

void Session::at_rest() {
  if (!motion_) return;
  state_ = motion_->state();
  shown_ = &state_;
  std::exchange(motion_, nullptr)->end_computation();
}

void Session::set_state(State state) {
  check_state(system_, state);
  at_rest();
  state_ = std::move(state);
  report_.reset();
  started_ = true;
}

StartConditions Session::start_conditions() const { return started_ ? StartConditions() : conditions_of_file(system_); }

// -- computing

StartReport Session::assemble(const AssemblyOptions& options) {
  at_rest();
  stopping_ = false;
  acting_ = environment_;
  StartReport report;
  system_.begin_motion(state_, environment_, false);
  const StartConditions conditions = with_kept(system_, environment_, state_, start_conditions(), options);
  assemble_positions(system_, environment_, state_, report, conditions);
  begin_velocities(system_, environment_, state_, conditions, report);
  started_ = true;
  begin_first_order(system_, environment_, state_);
  const VectorX memory = state_.memory;
  system_.accept(state_, environment_);
  count_as_not_begun(system_, memory, state_);
  loaded_.motions = 1;
  EnergyBalance energy_balance;
  energy_balance.start(state_.time, system_.energy(state_, environment_));
  report_.emplace();
  report_->energy = energy_balance.totals();
  report_->balance = energy_balance.balance();
  recorder_.record(state_, environment_, *report_);
  return report;
}

Motion Session::dynamics(const DynamicsOptions& options) { return Motion(*this, options); }

Motion Session::dynamics(const DynamicsOptions& options, const std::vector<double>& checkpoint, ResultSink& sink) {
  Archive archive(checkpoint);
  return Motion(*this, options, archive, &sink);
}

// -- reading

StepRecord Session::report() const {
  if (report_) return *report_;
  StepRecord start;
  start.energy = system_.energy(*shown_, acting_);
  start.energy.input = start.energy.dissipation = 0;
  return start;
}

const NodeState& Session::node(const std::string& name) const {
  if (const auto index = model_.find_node(name)) return shown_->nodes[static_cast<std::size_t>(*index)];
  std::vector<std::string> names;
  for (const Node& node : model_.nodes())
    if (!node.internal) names.push_back(node.name);
  throw InputError(fmt::format("there is no node '{}'{}", name, did_you_mean(name, names)));
}

const ResultsRows& Session::readable() const {
  if (!readable_) readable_ = std::make_unique<ResultsRows>(model_, ResultsRows::Extent::all);
  return *readable_;
}

const std::vector<ResultsColumn>& Session::datasets() const {
  if (datasets_.empty()) datasets_ = readable().columns();
  return datasets_;
}

ResultsColumn Session::column(const std::string& dataset) const {
  if (std::optional<ResultsColumn> column = readable().find(dataset)) return *std::move(column);
  std::vector<std::string> names = {"time"};
  for (const ResultsColumn& each : datasets()) names.push_back(each.dataset);
  throw InputError(fmt::format("there is no dataset '{}'{}", dataset, did_you_mean(dataset, names)));
}

std::vector<double> Session::read(const ResultsColumn& column) const {
  return readable().read(column, recorder_.reported(*shown_, acting_), system_.slots(), acting_, report());
}

std::vector<double> Session::read(const std::string& dataset) const {
  if (dataset == "time") return {report().time.value_or(time())};
  return read(column(dataset));
}

double Session::measure(const std::string& name) const {
  auto found = gauges_.find(name);
  if (found == gauges_.end()) found = gauges_.emplace(name, Gauge(name, system_)).first;
  const Gauge& gauge = found->second;
  return gauge.value(gauge.reads_reactions() ? recorder_.reported(*shown_, acting_) : *shown_, acting_);
}

// -- callbacks

void Session::call_back() {
  for (const auto& callback : on_step_) callback(*this);
}

void Session::set_input(const std::string& name, double value, bool smooth) {
  if (!std::isfinite(value))
    throw InputError(fmt::format("input '{}': expected a finite number, found {}", name, value));
  for (const Component* component : model_.components_of({Section::measures, name})) {
    const auto* input = dynamic_cast<const InputMeasure*>(component);
    if (!input) continue;
    const int place = system_.slots_of(*input).memory_begin;
    if (motion_)
      motion_->set_memory(place, value, smooth);
    else
      state_.memory[place] = value;
    return;
  }
  std::vector<std::string> names;
  for (const Member& member : model_.members())
    if (dynamic_cast<const InputMeasure*>(member.component.get())) names.push_back(member.entry.name);
  throw InputError(fmt::format("there is no input '{}'{}", name, did_you_mean(name, names)));
}

}  // namespace bielle::mechanism

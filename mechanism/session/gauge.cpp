#include "mechanism/session/gauge.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/measures/node_measures.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Returns a measure of the model: named by the user, or created for one of the formulas.
const Measure* known_measure(const Model& model, const std::string& name) {
  for (const Member& member : model.members())
    if (const auto* measure = dynamic_cast<const Measure*>(member.component.get()); measure && measure->name() == name)
      return measure;
  return nullptr;
}

/// Lists the names that may be placed before the first dot, and the measures that need no dot.
std::vector<std::string> measurable_names(const Model& model) {
  std::vector<std::string> names;
  for (const Member& member : model.members())
    if (dynamic_cast<const Measure*>(member.component.get()) && member.recorded != Recorded::no)
      names.push_back(member.component->name());
  for (const Node& node : model.nodes())
    if (!node.internal) names.push_back(node.name);
  for (const Section section : {Section::joints, Section::elements, Section::hydraulics})
    for (const std::string& each : model.names_in(section)) names.push_back(each);
  return names;
}

/// Creates the measure "main.angle" from those of the joint `main`; the name of a component may contain dots itself.
std::unique_ptr<const Measure> make_dotted_measure(const Model& model, const std::string& name) {
  std::string known_subject;
  std::vector<std::string> offered;
  for (std::size_t end = 0; end < name.size();) {
    end = std::min(name.find('.', end + 1), name.size());
    const std::string subject = name.substr(0, end), wanted = name.substr(std::min(end + 1, name.size()));
    const auto has = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), wanted) != names.end();
    };
    for (const Component* component : model.components_named(subject)) {
      const std::vector<std::string> names = component->measure_names();
      if (has(names)) return component->make_measure(name, wanted);
      offered.insert(offered.end(), names.begin(), names.end());
      known_subject = subject;  // the longest name that fits
    }
    if (const auto index = model.find_node(subject)) {
      if (has(node_measure_names())) return make_node_measure(name, model, *index, wanted);
      offered.insert(offered.end(), node_measure_names().begin(), node_measure_names().end());
      known_subject = subject;
    }
  }
  if (known_subject.empty()) {
    const std::string subject = name.substr(0, name.find('.'));
    throw InputError(fmt::format("there is no measure, joint, node or element '{}'{}", subject,
                                 did_you_mean(subject, measurable_names(model))));
  }
  if (offered.empty()) throw InputError(fmt::format("'{}' has nothing that can be measured", known_subject));
  if (name == known_subject)
    throw InputError(fmt::format("'{}' alone is no measure{}", name, did_you_mean("", offered)));
  const std::string wanted = name.substr(known_subject.size() + 1);
  throw InputError(fmt::format("'{}' has no '{}'{}", known_subject, wanted, did_you_mean(wanted, offered)));
}

}  // namespace

Gauge::Gauge(const std::string& name, const System& system) : measure_(known_measure(system.model(), name)) {
  if (measure_) {
    slots_ = system.slots_of(*measure_);
    return;
  }
  own_ = make_dotted_measure(system.model(), name);
  measure_ = own_.get();
  Declaration declaration;
  measure_->declare(declaration);
  if (!declaration.memory.empty())
    throw InputError(
        fmt::format("'{}' is counted from step to step: give it a name in `measures` of the model, by which "
                    "it is read",
                    name));
  slots_.nodes = declaration.nodes;
  for (const Component* reference : declaration.references) slots_.refer_to(system.slots_of(*reference));
}

}  // namespace bielle::mechanism

#include "mechanism/measures/read_measure.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/measures/combined_measure.hpp"
#include "mechanism/measures/delayed_measure.hpp"
#include "mechanism/measures/event_record.hpp"
#include "mechanism/measures/node_measures.hpp"
#include "mechanism/measures/released_measure.hpp"
#include "mechanism/reading/functions_of_names.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/formula/formula_parser.hpp"
#include "reduce/common/formula/units.hpp"

namespace bielle::mechanism {
namespace {

const Measure& measure_of(const YamlValue& value, const FormulaText& formula, Model& model);

/// Lists the names in a formula, in the order in which they appear, each once.
std::vector<std::string> words_in(const std::string& text) {
  std::vector<std::string> words;
  const auto inside = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    for (end = begin; end < text.size() && inside(text[end]);) ++end;
    if (end == begin || std::isdigit(static_cast<unsigned char>(text[begin]))) continue;
    std::string word = text.substr(begin, end - begin);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(std::move(word));
  }
  return words;
}

/// Returns a formula, or a part of one, with its references. @param value  the value that contains it
FormulaText references_in(const std::string& formula, const std::vector<std::string>& variables,
                          const YamlValue& value) {
  std::vector<std::string> plain_names = variables;
  for (const auto& [name, number] : value.parameters()) plain_names.push_back(name);
  try {
    return find_references(formula, plain_names, functions_of_names(), functions_of_formulas());
  } catch (const InputError& error) {
    value.fail(fmt::format("in '{}': {}", formula, error.what()));
  }
}

/// Looks up a reference of a formula in the model.
class Lookup {
 public:
  /// @param variables  the formula's own
  Lookup(const YamlValue& value, const std::vector<std::string>& variables, Model& model)
      : value_(value), variables_(variables), model_(model) {}

  const Measure& find(const FormulaReference& reference) {
    if (contains(functions_of_formulas(), reference.function)) return delayed(reference);
    const std::string name = reference.function.empty() ? dotted(reference) : called(reference);
    if (const Measure* known = named(name)) return *known;
    return model_.add_measure(reference.function.empty() ? make_dotted(reference, name) : make_called(reference, name),
                              false);
  }

  const Measure* named(const std::string& name) {
    try {
      if (const Measure* found = model_.find_measure(name)) return found;
      EventRecord* const event = find_event_record(model_, name);
      if (!event) return nullptr;
      event->use();
      return &model_.add_measure(event->make_measure(name, ""), false);
    } catch (const InputError& error) {
      if (std::string(error.what()).rfind("the measure", 0) != 0) throw;  // the error contains its location already
      value_.fail(error.what());
    }
  }

 private:
  static std::string dotted(const FormulaReference& reference) {
    return fmt::format("{}.{}", reference.subjects.front(), fmt::join(reference.path, "."));
  }
  static std::string called(const FormulaReference& reference) {
    return fmt::format("{}({})", reference.function, fmt::join(reference.subjects, ", "));
  }

  int node(const std::string& name) const {
    if (const auto index = model_.find_node(name)) return *index;
    value_.fail(fmt::format("there is no node '{}'{}", name, did_you_mean(name, node_names())));
  }

  std::vector<std::string> node_names() const {
    std::vector<std::string> names;
    for (const Node& each : model_.nodes())
      if (!each.internal) names.push_back(each.name);
    return names;
  }

  std::unique_ptr<Measure> make_called(const FormulaReference& reference, const std::string& name) const {
    if (!reference.path.empty())
      value_.fail(fmt::format("'{}': {} is a number, nothing can follow it", reference.text, name));
    if (reference.subjects.size() != 2)
      value_.fail(fmt::format("'{}': expected two nodes, as in {}(a, b)", reference.text, reference.function));
    const NodePair pair{node(reference.subjects[0]), node(reference.subjects[1]), Vector3::Zero(), Vector3::Zero()};
    if (pair.first == pair.second) value_.fail(fmt::format("'{}': expected two different nodes", reference.text));
    return reference.function == "angle" ? make_angle(name, pair) : make_distance(name, pair);
  }

  bool exists(const std::string& name) const {
    return !model_.components_named(name).empty() || model_.find_node(name).has_value() ||
           find_event_record(model_, name);
  }

  /// Splits "blade_2.tip.position.x" into the longest name of something in the model, which may have dots, and the
  /// quantity.
  std::pair<std::string, std::string> subject_and_quantity(const FormulaReference& reference) const {
    const std::vector<std::string>& path = reference.path;
    for (std::size_t count = path.size() - 1; count > 0; --count) {
      const auto end = path.begin() + static_cast<std::ptrdiff_t>(count);
      std::string name = fmt::format("{}.{}", reference.subjects.front(), fmt::join(path.begin(), end, "."));
      if (exists(name)) return {std::move(name), fmt::format("{}", fmt::join(end, path.end(), "."))};
    }
    return {reference.subjects.front(), fmt::format("{}", fmt::join(path, "."))};
  }

  /// Returns a measure of a component; forces are zero while its entry is released.
  std::unique_ptr<Measure> make_of(const Component& component, const std::string& name,
                                   const std::string& measure) const {
    std::unique_ptr<Measure> made = component.make_measure(name, measure);
    if (!are_units_of_forces(made->units())) return made;
    std::vector<const Activity*> activities = activities_of(model_, component);
    if (activities.empty()) return made;
    return std::make_unique<ReleasedMeasure>(std::move(made), std::move(activities));
  }

  std::unique_ptr<Measure> make_dotted(const FormulaReference& reference, const std::string& name) const {
    const auto [subject, wanted] = subject_and_quantity(reference);
    const auto has = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), wanted) != names.end();
    };
    std::vector<std::string> available;
    const auto offer = [&](const std::vector<std::string>& names) {
      available.insert(available.end(), names.begin(), names.end());
    };
    for (const Component* component : model_.components_named(subject)) {
      if (has(component->measure_names())) return make_of(*component, name, wanted);
      offer(component->measure_names());
    }
    if (EventRecord* const event = find_event_record(model_, subject)) {
      if (has(event->measure_names())) {
        event->use();
        return event->make_measure(name, wanted);
      }
      offer(event->measure_names());
    }
    if (const auto index = model_.find_node(subject)) {
      if (has(node_measure_names())) return make_node_measure(name, model_, *index, wanted);
      offer(node_measure_names());
    }
    // Measures of a control block are listed as well: "plant.y1".
    for (const std::string& each : model_.announced_measures())
      if (each.rfind(subject + ".", 0) == 0) available.push_back(each.substr(subject.size() + 1));
    if (available.empty()) {
      std::vector<std::string> subjects = node_names();
      for (const Section section : {Section::joints, Section::elements})
        for (const std::string& each : model_.names_in(section)) subjects.push_back(each);
      if (!model_.components_named(subject).empty())
        value_.fail(fmt::format("'{}': '{}' has nothing that can be measured", reference.text, subject));
      value_.fail(fmt::format("'{}': there is no joint, node or element '{}'{}", reference.text, subject,
                              did_you_mean(subject, subjects)));
    }
    value_.fail(
        fmt::format("'{}': '{}' has no '{}'{}", reference.text, subject, wanted, did_you_mean(wanted, available)));
  }

  /// Returns the measure of `delay(x, T)`, which all formulas with the same x and T share.
  const Measure& delayed(const FormulaReference& reference) {
    if (!reference.path.empty())
      value_.fail(fmt::format("'{}': {} is a number, nothing can follow it", reference.text, reference.function));
    if (reference.subjects.size() != 2)
      value_.fail(fmt::format("'{}': expected a measure and a time, as in delay(main.angle, 0.02)", reference.text));
    const std::string &operand = reference.subjects[0], &time = reference.subjects[1];
    const FormulaText formula = references_in(operand, {"t"}, value_);
    for (const std::string& word : words_in(formula.replaced))
      if (word != "t" && contains(variables_, word) && !model_.announces_measure(word))
        value_.fail(fmt::format("'{}': the past of '{}' is not known, the variable of this formula; delay a measure",
                                reference.text, word));
    const double T = delay_time(reference, time);
    const Measure& of = measure_of(value_, formula, model_);
    const std::string name = fmt::format("delay({}, {})", of.name(), T);
    if (const Measure* known = model_.find_measure(name)) return *known;
    return model_.add_measure(std::make_unique<DelayedMeasure>(name, of, T, DelayedMeasure::usual_points, of.units()),
                              false);
  }

  /// Returns T > 0 [s], a number or a formula of parameters.
  double delay_time(const FormulaReference& reference, const std::string& text) const {
    double time = 0;
    try {
      time = Expression(text, {}, value_.parameters())(std::span<const double>());
    } catch (const std::runtime_error& error) {
      value_.fail(fmt::format("'{}': the delay is constant, a number or a formula of parameters [s]: {}",
                              reference.text, error.what()));
    }
    if (!(time > 0))
      value_.fail(fmt::format("'{}': expected a delay greater than 0 s, found {:.6g}", reference.text, time));
    return time;
  }

  const YamlValue& value_;
  const std::vector<std::string>& variables_;
  Model& model_;
};

struct ReadFormula {
  Expression expression;
  std::vector<const Measure*> measures;
};

FormulaText formula_text(const YamlValue& value, const std::vector<std::string>& variables) {
  return references_in(value.formula_text(variables, functions_of_names()).written, variables, value);
}

/// @param formula  the whole formula of the value, or a part of it
ReadFormula read_formula(const YamlValue& value, const FormulaText& formula, const std::vector<std::string>& variables,
                         Model& model) {
  Lookup lookup(value, variables, model);
  ReadFormula result;
  std::vector<std::string> names = variables;
  for (const std::string& word : words_in(formula.replaced)) {
    const bool known = model.announces_measure(word) || find_event_record(model, word);
    if (!known || contains(variables, word) || value.parameters().count(word)) continue;
    names.push_back(word);
    result.measures.push_back(lookup.named(word));
  }
  for (const FormulaReference& reference : formula.references) result.measures.push_back(&lookup.find(reference));
  result.expression = value.expression(names, formula);
  return result;
}

ReadFormula read_formula(const YamlValue& value, const std::vector<std::string>& variables, Model& model) {
  return read_formula(value, formula_text(value, variables), variables, model);
}

std::vector<StateFormula::Argument> refer_to(const std::vector<const Measure*>& measures, References& references) {
  std::vector<StateFormula::Argument> arguments;
  for (const Measure* measure : measures) arguments.push_back({measure, references.add(*measure)});
  return arguments;
}

/// Returns the units of t and of the measures.
std::vector<std::string> argument_units(const std::vector<const Measure*>& measures) {
  std::vector<std::string> units = {"s"};
  for (const Measure* measure : measures) units.push_back(measure->units());
  return units;
}

std::unique_ptr<Measure> make_combined(const std::string& name, const ReadFormula& read, const YamlValue& formula,
                                       const std::optional<YamlValue>& units) {
  if (read.measures.empty() && read.expression.is_constant())
    formula.fail(
        "a measure is a formula of the time t, or of the state: of joints (main.angle), nodes (pin.position.x), other "
        "measures; a constant belongs to `parameters`");
  std::string inferred = units ? units->text() : units_of(read.expression, argument_units(read.measures));
  References references;
  StateFormula of_state(read.expression, 1, refer_to(read.measures, references));
  return std::make_unique<CombinedMeasure>(name, std::move(references), std::move(of_state), std::move(inferred));
}

std::unique_ptr<Measure> read_combined(const std::string& name, const YamlValue& formula,
                                       const std::optional<YamlValue>& units, Model& model) {
  return make_combined(name, read_formula(formula, {"t"}, model), formula, units);
}

/// Returns the measure that a formula names, or one that it defines.
const Measure& measure_of(const YamlValue& value, const FormulaText& formula, Model& model) {
  static const std::vector<std::string> variables = {"t"};
  // Creates the measure if the formula is a single name.
  const ReadFormula read = read_formula(value, formula, variables, model);
  if (const Measure* known = Lookup(value, variables, model).named(formula.written)) return *known;
  return model.add_measure(make_combined(formula.written, read, value, {}), false);
}

/// The words of the quantities, in the order of NodeQuantity.
const std::vector<std::string> quantity_words = {"position",         "velocity", "rotation",
                                                 "angular_velocity", "turn",     "turn_rate"};

const KeyTable& measure_of_node_keys() {
  using namespace keys;
  static const KeyTable table{
      "the measure of a node",
      "A quantity of a node along a direction.",
      {{"node", name_of("node"), required, "The node."},
       {"relative_to", name_of("node"), otherwise("ground"), "Node in whose axes the quantity is seen."},
       {"quantity", word(quantity_words, "a quantity"), otherwise("position"), "Quantity of the node."},
       {"direction",
        {word({"x", "y", "z"}, "a direction (x, y, z or a vector)"), direction().as_vector().in_inertial_axes()},
        required,
        "Direction along which the quantity is measured, in the axes of `relative_to`."},
       {"at",
        {vector3("m").as_point(), list_of(2, vector3("m").as_point())},
        otherwise("[0, 0, 0]"),
        "Point of the node in its axes, or two points, one of `relative_to` and one of the node."}}};
  return table;
}

std::unique_ptr<Measure> read_of_node(const std::string& name, const YamlValue& entry, const Model& model) {
  NodePair pair;
  pair.first = node_named_by(entry.at("relative_to"), model);
  pair.second = node_named_by(entry.at("node"), model);
  if (pair.first == pair.second) entry.at("node").fail("a node relative to itself does not move");
  const auto chosen = std::find(quantity_words.begin(), quantity_words.end(), entry.at("quantity").word());
  const auto quantity = static_cast<NodeQuantity>(chosen - quantity_words.begin());
  if (const auto at = entry.find("at")) {
    if (quantity != NodeQuantity::position && quantity != NodeQuantity::velocity)
      at->fail("a rotation is that of the whole node: it has no point");
    if (at->is_sequence() && at->size() == 2 && at->at(std::size_t{0}).is_sequence()) {
      pair.at_first = at->at(std::size_t{0}).vector3();
      pair.at_second = at->at(std::size_t{1}).vector3();
    } else {
      pair.at_second = at->vector3();
    }
  }
  const YamlValue direction = entry.at("direction");
  const Vector3 axis =
      direction.is_sequence() ? Vector3(direction.direction()) : Vector3::Unit(direction.word()[0] - 'x');
  return make_node_measure(name, model, pair, quantity, axis);
}

}  // namespace

StateFormula read_state_formula(const YamlValue& value, const std::vector<std::string>& variables, Model& model,
                                References& references) {
  const ReadFormula read = read_formula(value, variables, model);
  return {read.expression, variables.size(), refer_to(read.measures, references)};
}

std::string units_of_formula(const YamlValue& value, Model& model) {
  const ReadFormula read = read_formula(value, {"t"}, model);
  return units_of(read.expression, argument_units(read.measures));
}

void check_measure_name(const std::string& name, const YamlValue& entry, const Model& model) {
  if (model.announces_measure(name)) entry.fail(fmt::format("there is a measure, input or state '{}' already", name));
  if (entry.parameters().count(name)) entry.fail(fmt::format("'{}' is a parameter already; choose another name", name));
  const std::vector<std::string> own = {"t", "q", "v", "e", "s"};
  if (contains(own, name) || contains(built_in_names(), name) || contains(functions_of_names(), name) ||
      contains(functions_of_formulas(), name))
    entry.fail(fmt::format("'{}' means something in formulas already; choose another name", name));
  if (!is_dotted_word(name)) entry.fail("this is a name in formulas: letters, digits and '_', no digit first");
}

const KeyTable& measure_keys() {
  using namespace keys;
  static const KeyTable table{
      "a measure",
      "A quantity of the state by a formula, with its units.",
      {{"formula", state_formula("any", {"t"}), required, "Formula of the time t, parameters and measures."},
       {"units", text(), computed("units that follow from the formula"), "Units that are recorded with the values."}},
      {{"node", "", measure_of_node_keys}}};
  return table;
}

void read_measure(const std::string& name, const YamlValue& given, Model& model) {
  check_measure_name(name, given, model);
  if (given.is_map() && !given.has("formula") && !given.has("node"))
    given.fail("expected a formula, `formula` with `units`, or a `node`");
  const YamlValue entry = given.is_map() ? given.keyed(measure_keys()) : given;
  model.announce_measure(name, [name, entry, &model] {
    std::unique_ptr<Measure> measure;
    if (!entry.is_map()) {
      measure = read_combined(name, entry, {}, model);
    } else if (entry.has("node")) {
      measure = read_of_node(name, entry, model);
    } else {
      measure = read_combined(name, entry.at("formula"), entry.find("units"), model);
    }
    model.add_measure(std::move(measure), true);
  });
}

const Measure& measure_named_by(const YamlValue& value, Model& model) {
  return measure_of(value, formula_text(value, {"t"}), model);
}

}  // namespace bielle::mechanism

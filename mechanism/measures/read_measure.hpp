// Measures and formulas of the state in input files: names are looked up in the model after all of it has been read.
#pragma once

#include <string>
#include <vector>

#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Reads the formula of a value: it depends on the component's own variables, the parameters, and the measures
///     <joint>.<coordinate>  <joint>.<coordinate>.rate  <joint>.reaction.x  <node>.position.x  <node>.velocity.x
///     <spring>.elongation   distance(<node>, <node>)   angle(<node>, <node>)   <named measure>
/// @param variables   variables of the component, e.g. {"t"}
/// @param references  references of the component that owns the formula; the measures are added
/// @throws InputError naming the nearest name
StateFormula read_state_formula(const YamlValue& value, const std::vector<std::string>& variables, Model& model,
                                References& references);
/// Returns the units of such a formula of t; empty if they are unknown.
std::string units_of_formula(const YamlValue& value, Model& model);

/// Rejects text that cannot be the name of a measure or input in formulas. @throws InputError
void check_measure_name(const std::string& name, const YamlValue& entry, const Model& model);

/// The keys of a measure that is no plain formula.
const KeyTable& measure_keys();
/// Reads an entry of `measures`: a formula of the time or the state; `{formula, units}`; or `{node, relative_to,
/// quantity, direction, at}`.
/// @throws InputError also if measures refer to each other in a circle
void read_measure(const std::string& name, const YamlValue& given, Model& model);

/// Returns the measure that a value names or defines by a formula.
const Measure& measure_named_by(const YamlValue& value, Model& model);

}  // namespace bielle::mechanism

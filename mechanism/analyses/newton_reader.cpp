#include "mechanism/analyses/newton_reader.hpp"

namespace bielle::mechanism {
namespace {

std::vector<Key> common_keys() {
  using namespace keys;
  return {{"tolerance", number().positive().at_most(1e-3), otherwise("1e-9"),
           "Residual at which the equations count as solved, relative to the largest acting forces."},
          {"iterations", integer().at_least(2), otherwise("20"), "Largest number of iterations."},
          {"line_search", boolean(), otherwise("true"),
           "Whether a step of Newton's method that makes the residual larger is shortened."}};
}

const KeyTable& newton_keys() {
  static const KeyTable table{"`newton`", "Solution of the equations by Newton's method.", common_keys()};
  return table;
}

const KeyTable& dynamic_newton_keys() {
  using namespace keys;
  static const KeyTable table{
      "`newton`", "Solution of the equations of a step by Newton's method.",
      joined({common_keys(),
              {{"tangent", word({"automatic", "reused", "renewed"}, "a way with the tangent"), otherwise("automatic"),
                "Use of a factorised tangent: `automatic` while that costs less than new factors, `reused` as long as "
                "the residual falls fast with it, `renewed` for one iteration alone."}}})};
  return table;
}

Key key_of(const KeyTable& (*table)()) {
  return {"newton", keys::nested(table), keys::optional, "Solution of the equations of a step by Newton's method."};
}

Tangent read_tangent(const YamlValue& entry) {
  const std::string word = entry.word();
  return word == "automatic" ? Tangent::automatic : word == "reused" ? Tangent::reused : Tangent::renewed;
}

}  // namespace

Key newton_key() { return key_of(newton_keys); }
Key dynamic_newton_key() { return key_of(dynamic_newton_keys); }

NewtonOptions read_newton(const YamlValue& analysis) {
  NewtonOptions options;
  const auto entry = analysis.find("newton");
  if (!entry) return options;
  options.tolerance = entry->at("tolerance").number();
  options.iterations = entry->at("iterations").integer();
  options.line_search = entry->at("line_search").boolean();
  if (const auto tangent = entry->find("tangent")) options.tangent = read_tangent(*tangent);
  return options;
}

}  // namespace bielle::mechanism

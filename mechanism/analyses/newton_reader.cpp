#include "mechanism/analyses/newton_reader.hpp"

namespace bielle::mechanism {
namespace {

Tangent read_tangent(const YamlValue& entry) {
  const std::string word = entry.word({"automatic", "reused", "renewed"}, "a way with the tangent");
  return word == "automatic" ? Tangent::automatic : word == "reused" ? Tangent::reused : Tangent::renewed;
}

}  // namespace

NewtonOptions read_newton(const YamlValue& analysis, bool dynamic) {
  NewtonOptions options;
  const auto entry = analysis.find("newton");
  if (!entry) return options;
  std::vector<std::string> keys = {"tolerance", "iterations", "line_search"};
  if (dynamic) keys.emplace_back("tangent");
  entry->check_keys(keys, "`newton`");
  if (entry->has("tolerance")) options.tolerance = entry->at("tolerance").positive_number();
  if (options.tolerance > 1e-3)
    entry->at("tolerance").fail("expected at most 1e-3: it is relative to the largest forces");
  if (entry->has("iterations")) options.iterations = entry->at("iterations").integer();
  if (options.iterations < 2) entry->at("iterations").fail("expected at least 2");
  if (entry->has("line_search")) options.line_search = entry->at("line_search").boolean();
  if (entry->has("tangent")) options.tangent = read_tangent(entry->at("tangent"));
  return options;
}

}  // namespace bielle::mechanism

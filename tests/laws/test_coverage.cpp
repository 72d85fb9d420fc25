// Every component type must have a sample.
#include <algorithm>

#include <catch2/catch.hpp>

#include "mechanism/hydraulics/reading/circuit_reader.hpp"
#include "tests/laws/subject.hpp"

using namespace bielle::laws;
using bielle::mechanism::circuit_types;
using bielle::mechanism::component_table;
using bielle::mechanism::ComponentType;

namespace {

/// Returns the types of the component table and of circuits.
std::vector<std::pair<bielle::mechanism::Section, std::string>> all_types() {
  std::vector<std::pair<bielle::mechanism::Section, std::string>> types;
  for (const ComponentType& type : component_table()) types.emplace_back(type.section, type.name);
  for (const std::string& type : circuit_types()) types.emplace_back(bielle::mechanism::Section::hydraulics, type);
  return types;
}

}  // namespace

TEST_CASE("every type of the component table and of circuits has a sample, and every sample a type and a component") {
  const auto types = all_types();
  for (const auto& type : types) {
    CAPTURE(type.second);
    const auto mine = [&](const Sample& s) { return s.section == type.first && s.type == type.second; };
    CHECK(std::any_of(samples().begin(), samples().end(), mine));
  }
  for (const Sample& sample : samples()) {
    CAPTURE(title(sample));
    CHECK(std::find(types.begin(), types.end(), std::pair(sample.section, sample.type)) != types.end());
    const auto list = subjects(sample);
    CHECK(!list.empty());
    for (const Subject& subject : list) CHECK(subject.dense->declarations().size() == 1);
  }
}

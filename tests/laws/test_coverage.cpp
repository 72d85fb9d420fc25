// Every component type is put to the laws.
#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"

using namespace bielle::laws;
using bielle::mechanism::component_table;
using bielle::mechanism::ComponentType;

TEST_CASE("every type of the component table has a sample, and every sample a type and a component") {
  for (const ComponentType& type : component_table()) {
    CAPTURE(type.name);
    const auto mine = [&](const Sample& s) { return s.section == type.section && s.type == type.name; };
    CHECK(std::any_of(samples().begin(), samples().end(), mine));
  }
  for (const Sample& sample : samples()) {
    CAPTURE(title(sample));
    const auto mine = [&](const ComponentType& t) { return t.section == sample.section && sample.type == t.name; };
    CHECK(std::any_of(component_table().begin(), component_table().end(), mine));
    const auto list = subjects(sample);
    CHECK(!list.empty());
    for (const Subject& subject : list) CHECK(subject.dense->declarations().size() == 1);
  }
}

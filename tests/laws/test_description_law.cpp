// Every component type must describe itself when a model is checked.
#include <catch2/catch.hpp>

#include "mechanism/model/description.hpp"
#include "mechanism/system/system.hpp"
#include "tests/laws/subject.hpp"

using namespace bielle::laws;
using namespace bielle::mechanism;

TEST_CASE("every component describes itself") {
  for (const Sample& sample : samples()) {
    CAPTURE(title(sample));
    const auto file = read_sample(sample, sample.model);
    const Model& model = file->model;
    const System system(model);
    const State state = system.start(0);
    Description description(model);
    for (std::size_t m = 0; m < model.members().size(); ++m) {
      const Component& component = *model.members()[m].component;
      if (component.name() == "it")
        component.describe(LocalState(state, system.slots()[m], model.environment), description);
    }
    CHECK(!description.lines()[0].empty());
  }
}

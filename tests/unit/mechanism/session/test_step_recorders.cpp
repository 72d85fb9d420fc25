// These tests check the names of gathered values in a results file, and the choice of the element that represents a
// beam.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/session/step_recorders.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

TEST_CASE("components whose results would have one name are refused before anything is computed") {
  TemporaryFolder folder;
  write_superelement(straight_beam({1, 1e6, 1e3, 1e3, 1e3, 1e-3}, 4).reduced().body, folder / "arm.h5");
  const auto begin = [&](const std::string& second) {
    const ReadyModel model(fmt::format(
        "nodes: {{r: {{fixed: true}}}}\nelements:\n  arm: {{type: superelement, file: {0}/arm.h5, nodes: {{a: r}}}}\n"
        "  {1}: {{type: superelement, file: {0}/arm.h5, nodes: {{a: r}}}}\n",
        folder.path(), second));
    StepRecorders(model.file.model).begin();
  };
  CHECK_THAT(message_of<InputError>([&] { begin("arm/error"); }),
             Contains("'arm' and 'arm/error' cannot both have results") && Contains("rename"));
  begin("arm/upper");
  begin("other");
}

TEST_CASE("of a beam's elements the one that is strained most speaks") {
  // A cantilever of 1 m with a circle of radius 100 mm: curvature M/EI under a moment alone, the same everywhere.
  const ReadyModel model(
      "nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}, c: {position: [0, 1, 0]}}\n"
      "elements:\n"
      "  one: {type: beam, nodes: [a, b], elements: 4, section: {circle: 0.1, young: 2e11, poisson: 0.3, density: "
      "7800}}\n"
      "  two: {type: beam, nodes: [a, c], elements: 4, section: {circle: 0.1, young: 2e11, poisson: 0.3, density: "
      "7800}}\n");
  StepRecorders recorders(model.file.model);
  recorders.begin();
  State state = model.system.start(0);
  Environment environment = model.environment();
  recorders.add(state, model.system.slots(), environment);
  CHECK(recorders.summary().empty());
  // The last element of `one` is stretched by 3 %, the third by 2.5 %.
  const auto moved = [&](const std::string& name, double x) {
    state.nodes[static_cast<std::size_t>(*model.file.model.find_node(name))].x.x() += x;
  };
  moved("one.3", 0.25 * 0.025);
  moved("b", 0.25 * 0.055);
  recorders.add(state, model.system.slots(), environment);
  const std::string text = recorders.summary();
  CHECK_THAT(text, Contains("warning: beam 'one' is strained by 3 %, most in element 4 of 4, at t = 0 s"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
}

TEST_CASE("a beam whose elements are too long for its tension says so") {
  // N = EA strain; l = sqrt(EI/N) = (r/2)/sqrt(strain) = 5 mm/sqrt(strain) fits seven times into an element of 1/2 m
  // from a strain of 0.49 % on.
  const auto says = [](double strain, const std::string& more) {
    const ReadyModel model(
        "nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}}\nelements: {one: {type: beam, nodes: [a, b], elements: 2, "
        "section: {circle: 0.01, young: 2e11, poisson: 0.3, density: 7800}" +
        more + "}}\n");
    StepRecorders recorders(model.file.model);
    recorders.begin();
    State state = model.system.start(0);
    state.nodes[static_cast<std::size_t>(*model.file.model.find_node("b"))].x.x() += 0.5 * strain;
    recorders.add(state, model.system.slots(), model.environment());
    return recorders.summary();
  };
  CHECK_THAT(says(0.006, ""),
             Contains("warning: under its tension beam 'one' bends within 0.065 m of clamps and side loads") &&
                 Contains("are 0.5 m long: take at least 5 of them"));
  CHECK(says(0.004, "").empty());
  CHECK(says(-0.006, "").empty());
  CHECK_THAT(says(0.006, ", bending: constant"), Contains("take at least 5 of them"));
}

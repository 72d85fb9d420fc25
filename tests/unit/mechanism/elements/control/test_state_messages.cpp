// Messages about states that are written wrongly.
#include <catch2/catch.hpp>

#include "tests/support/hinged_rotor.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using bielle::test::rotor;
using Catch::Contains;

namespace {

std::string message(const std::string& more) {
  return bielle::test::message_of<bielle::InputError>([&] { bielle::test::session_of(rotor(more)); });
}

}  // namespace

TEST_CASE("a state is one thing, and says which") {
  CHECK_THAT(message("states: {x: {start: 1}}\n"),
             Contains("model.yaml:") && Contains("states.x") && Contains("needs a `rate`"));
  CHECK_THAT(message("states: {x: {rte: 1}}\n"), Contains("'rte'") && Contains("did you mean 'rate'"));
  CHECK_THAT(message("states: {x: {rate: 1, filter: main.angle}}\n"),
             Contains("'filter' is not a key of a state with a `rate`"));
  CHECK_THAT(message("states: {x: 3}\n"), Contains("states.x"));
  CHECK_THAT(message("stats: {x: {rate: 1}}\n"), Contains("did you mean 'states'"));
}

TEST_CASE("names of states are names in formulas, each once") {
  CHECK_THAT(message("states: {t: {rate: 1}}\n"), Contains("means something in formulas already"));
  CHECK_THAT(message("states: {'two words': {rate: 1}}\n"), Contains("letters, digits"));
  CHECK_THAT(message("parameters: {k: 1}\nstates: {k: {rate: 1}}\n"), Contains("is a parameter already"));
  CHECK_THAT(message("states: {lag: {rate: 1}}\nmeasures: {lag: main.angle}\n"),
             Contains("measures.lag") && Contains("a measure, input or state 'lag' already"));
}

TEST_CASE("an output that is named wrong is told with those that there are") {
  const std::string block =
      "states: {plant: {state_space: {A: [[-1]], B: [[1]], C: [[1], [2]]}, inputs: [main.angle]}}\n";
  CHECK_THAT(message(block + "measures: {one: plant.y3}\n"), Contains("'plant' has no 'y3'") && Contains("y2"));
  CHECK(message(block + "measures: {one: plant.y2 + plant.x1}\n") == "(nothing thrown)");
}

TEST_CASE("a loop through direct feed-through is refused where it stands") {
  const std::string loop = message(
      "states: {lead: {transfer_function: {numerator: [2, 1], denominator: [1, 3]}, input: \"main.angle - gain\"}}\n"
      "measures: {gain: \"3*lead\"}\n");
  CHECK_THAT(loop, Contains("model.yaml:") && Contains("refers to itself"));
  // Without it the loop consists of differential equations.
  CHECK(message(
            "states: {lag: {transfer_function: {numerator: [1], denominator: [1, 3]}, input: \"main.angle - gain\"}}\n"
            "measures: {gain: \"3*lag\"}\n") == "(nothing thrown)");
}

TEST_CASE("what has no equilibrium of its own does not start there") {
  CHECK_THAT(
      message("states: {total: {transfer_function: {numerator: [1], denominator: [1, 0]}, input: main.angle, start: "
              "equilibrium}}\n"),
      Contains("states.total.start") && Contains("it integrates"));
}

TEST_CASE("values of states may have units, which must fit") {
  CHECK(message("states: {x: {filter: main.angle, time_constant: 10 ms, start: 5 deg}}\n") == "(nothing thrown)");
  CHECK(message("states: {x: {filter: main.angle, frequency: 1200 1/min, damping: 0.7}}\n") == "(nothing thrown)");
  CHECK_THAT(message("states: {x: {filter: main.angle, time_constant: 10 m}}\n"),
             Contains("states.x.time_constant: expected a value in s, found one in 'm'"));
  CHECK_THAT(message("states: {x: {filter: main.angle, frequency: 3 rad/s}}\n"),
             Contains("states.x.frequency: expected a value in Hz, found one in 'rad/s'"));
}

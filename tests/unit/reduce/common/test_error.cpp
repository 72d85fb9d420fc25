#include <new>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/process/run_program.hpp"

using bielle::did_you_mean;
using bielle::nearest_name;

TEST_CASE("The nearest name is found after every kind of typing error") {
  const std::vector<std::string> keys = {"damping", "density", "poisson", "rho", "young"};
  CHECK(nearest_name("dampng", keys) == "damping");    // left out
  CHECK(nearest_name("dampingg", keys) == "damping");  // one letter too many
  CHECK(nearest_name("dawping", keys) == "damping");   // exchanged
  CHECK(nearest_name("dampign", keys) == "damping");   // two letters exchanged count as one error, not two
  CHECK(nearest_name("DAMPING", keys) == "damping");   // case
  CHECK(nearest_name("rh", keys) == "rho");            // one letter of three differs
  CHECK(nearest_name("oyung", keys) == "young");
}

TEST_CASE("No name is offered when more than a third of the letters differ") {
  const std::vector<std::string> keys = {"damping", "ab"};
  CHECK(nearest_name("stiffness", keys).empty());
  CHECK(nearest_name("ac", keys).empty());
  CHECK(nearest_name("", keys).empty());
  CHECK(nearest_name("x", {}).empty());
}

TEST_CASE("The nearest of several names is offered, the first of equally near ones") {
  CHECK(nearest_name("ratio", std::vector<std::string>{"rations", "ratios"}) == "ratios");
  CHECK(nearest_name("node_c", std::vector<std::string>{"node_a", "node_b"}) == "node_a");
}

TEST_CASE("A message offers the nearest name, or the names that exist") {
  const std::vector<std::string> two = {"mass", "inertia"};
  CHECK(did_you_mean("mas", two) == "; did you mean 'mass'?");
  CHECK(did_you_mean("stiffness", two) == "; expected one of 'mass', 'inertia'");
  CHECK(did_you_mean("stiffness", std::vector<std::string>{"mass"}) == "; expected 'mass'");
  CHECK(did_you_mean("stiffness", {}).empty());
  std::vector<std::string> many;
  for (int i = 0; i < 15; ++i) many.push_back("node" + std::to_string(i));
  const std::string message = did_you_mean("stiffness", many);
  CHECK(message.find("'node11'") != std::string::npos);
  CHECK(message.find("'node12'") == std::string::npos);
  CHECK(message.find("and 3 more") != std::string::npos);
  // Only those of the many candidates that are most like the word are shown.
  many.push_back("stiff_point");
  many.emplace_back("end_stiffness_of_the_arm");
  const std::string nearest = did_you_mean("stiffness", many);
  CHECK(nearest.find("expected one of 'end_stiffness_of_the_arm', 'stiff_point', 'node0'") != std::string::npos);
  CHECK(nearest.find("and 5 more") != std::string::npos);
}

TEST_CASE("An error about a key keeps the key, and begins with it unless it is hidden") {
  const bielle::InputError shown("modes.count", "too many"), hidden("modes", "too many", bielle::Subject::hidden);
  CHECK(std::string(shown.what()) == "modes.count: too many");
  CHECK(shown.subject() == "modes.count");
  CHECK(std::string(hidden.what()) == "too many");
  CHECK(hidden.subject() == "modes");
  CHECK(std::string(bielle::InputError("", "too many").what()) == "too many");
  CHECK(bielle::ComputationError("failed").subject().empty());
}

TEST_CASE("Errors of work on a key get the key; other exceptions pass unchanged") {
  CHECK(bielle::about("modes", [] { return 7; }) == 7);
  try {
    bielle::about("modes", [] { throw bielle::InputError("too many"); });
    FAIL("nothing thrown");
  } catch (const bielle::InputError& error) {
    CHECK(std::string(error.what()) == "modes: too many");
    CHECK(error.subject() == "modes");
  }
  CHECK_THROWS_WITH(bielle::about("modes", [] { throw bielle::ComputationError("failed"); }), "failed");
}

TEST_CASE("The exit status distinguishes a wrong input from a failed computation") {
  const auto status = [](int (*body)(int, char**)) { return bielle::run_program("bielle-test", body, 0, nullptr); };
  CHECK(status([](int, char**) { return 0; }) == 0);
  CHECK(status([](int, char**) -> int { throw bielle::InputError("wrong input"); }) == 1);
  CHECK(status([](int, char**) -> int { throw bielle::ComputationError("failed"); }) == 2);
  CHECK(status([](int, char**) -> int { throw std::bad_alloc(); }) == 2);
  CHECK(status([](int, char**) -> int { throw std::logic_error("never"); }) == 2);
  CHECK(status([](int, char**) -> int { throw 7; }) == 2);
}

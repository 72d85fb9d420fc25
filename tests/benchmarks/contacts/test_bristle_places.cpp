// Bristles (LuGre) must not depend on the order of a surface's triangles, nor on which of two shapes is named first.
// Static analyses keep the bristles of places that still touch.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <catch2/catch.hpp>

#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_bristle_places {
namespace {

const std::string bristles =
    "friction: {model: lugre, coefficient: 0.4, static: 0.5, stribeck_velocity: 0.1, bristle_stiffness: 2e3, "
    "bristle_damping: 10}";

/// A groove along y, z = |x|, consists of 2 x 2 x 5 triangles in some order. Its walls are so narrow that the search
/// finds triangles of both walls together. @returns its path
std::string write_groove(const char* name, unsigned seed) {
  struct Facet {
    Vector3 a, b, c;
  };
  std::vector<Facet> facets;
  constexpr int strips = 5;
  for (int k = 0; k < strips; ++k) {
    const double y = -0.4 + 0.3 * k, end = y + 0.3;
    facets.push_back({{0, y, 0}, {0.15, y, 0.15}, {0.15, end, 0.15}});
    facets.push_back({{0, y, 0}, {0.15, end, 0.15}, {0, end, 0}});
    facets.push_back({{0, y, 0}, {-0.15, end, 0.15}, {-0.15, y, 0.15}});
    facets.push_back({{0, y, 0}, {0, end, 0}, {-0.15, end, 0.15}});
  }
  if (seed > 0) std::shuffle(facets.begin(), facets.end(), std::mt19937(seed));
  const std::string path = (std::filesystem::temp_directory_path() / name).string();
  std::ofstream file(path);
  file << "solid groove\n";
  for (const Facet& facet : facets) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const Vector3& corner : {facet.a, facet.b, facet.c})
      file << fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", corner.x(), corner.y(), corner.z());
    file << "endloop\nendfacet\n";
  }
  file << "endsolid groove\n";
  return path;
}

/// Returns the path of a ball in the groove, which rocks across it, slides along it, and spins.
std::vector<Vector3> path_in_groove(const char* name, unsigned seed) {
  const std::string stl = write_groove(name, seed);
  const std::string text = contact_model(
      {{"ball", fmt::format("position: [0, 0, {:.17g}], velocity: [0.1, 1.2, 0], angular_velocity: [3, 8, 10]",
                            0.1 * std::sqrt(2.0) - 1e-4)}},
      "  it: {type: contact, shapes: [{node: ball, sphere: 0.1}, {node: ground, surface: " + stl +
          "}], stiffness: 1e6, damping: 2, " + bristles + "}\n",
      "[0, 0, -9.81]");
  std::vector<Vector3> path;
  run_contact(text, {2e-4, 0.3},
              [&](const Session& session, const Motion&) { path.push_back(session.node("ball").x); });
  std::filesystem::remove(stl);
  return path;
}

/// Returns the last position and rotation vector of a ball on a plane.
std::pair<Vector3, Vector3> spun(bool plane_first, const std::string& held, double h) {
  const std::string plane = "{node: ground, plane: [0, 0, 1]}", ball = "{node: ball, sphere: 0.1}";
  const std::string text = contact_model(
      {{"ball", "position: [0, 0, 0.0999], velocity: [0.6, 0.2, 0], angular_velocity: [0, 0, 40]" + held}},
      fmt::format("  it: {{type: contact, shapes: [{}, {}], stiffness: 1e6, damping: 2, {}}}\n",
                  plane_first ? plane : ball, plane_first ? ball : plane, bristles),
      "[0, 0, -9.81]");
  std::pair<Vector3, Vector3> end;
  run_contact(text, {h, 0.25}, [&](const Session& session, const Motion&) {
    end = {session.node("ball").x, session.node("ball").Omega};
  });
  return end;
}

}  // namespace

TEST_CASE("the order of a surface's triangles does not matter to a ball that rubs in two places of it") {
  const std::vector<Vector3> path = path_in_groove("bielle_groove_0.stl", 0);
  REQUIRE(path.size() == 1501);
  CHECK(path.back().y() > 0.1);
  for (const unsigned seed : {1U, 2U, 3U}) {
    const std::vector<Vector3> other = path_in_groove("bielle_groove_1.stl", seed);
    REQUIRE(other.size() == path.size());
    double most = 0;
    for (std::size_t k = 0; k < path.size(); ++k) most = std::max(most, (path[k] - other[k]).norm());
    CAPTURE(seed);
    CHECK(most < 1e-10);  // Newton's tolerance, over 1500 steps
  }
}

TEST_CASE("a ball that spins where it slides does not notice which shape is named first") {
  const auto apart = [](const std::string& held, double h) {
    const auto one = spun(true, held, h), other = spun(false, held, h);
    return (one.first - other.first).norm() + 0.1 * (one.second - other.second).norm();
  };
  CHECK(apart(", fixed: [rx, ry]", 1e-3) < 1e-9);
  // If it also rolls, the results agree to second order in the rotation of a step.
  const double coarse = apart("", 1e-3), fine = apart("", 5e-4);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-3);
  CHECK(fine < 0.6 * coarse);
}

TEST_CASE("static analyses forget bristles of what has parted, and keep the others") {
  const ReadyModel model(contact_model(
      {{"ball", "position: [0, 0, 0.0999]"}},
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e6, " +
          bristles + "}\n"));
  Environment environment = model.environment();
  State state = model.system.start(0);
  model.system.accept(state, environment);
  constexpr Eigen::Index count = 7 + 2 * 12;  // after the time, the middles of the shapes, and the nodes
  REQUIRE(state.memory[count] == 1);
  state.memory.segment<3>(count + 3) = Vector3(1e-5, 2e-5, 0);
  environment.statics = true;
  model.system.accept(state, environment);
  REQUIRE(state.memory[count] == 1);
  CHECK((state.memory.segment<3>(count + 3) - Vector3(1e-5, 2e-5, 0)).norm() == 0);
  State away = state;
  away.nodes[static_cast<std::size_t>(*model.file.model.find_node("ball"))].x.z() = 0.2;
  model.system.accept(away, environment);
  CHECK(away.memory[count] == 0);
}

}  // namespace test_bristle_places

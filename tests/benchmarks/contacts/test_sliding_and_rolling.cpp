// Friction of contacts: balls that roll and slip, blocks that creep and slide, floors of triangles.
//
// A ball on an incline of angle a rolls with 5/7 g sin(a) as long as tan(a) < 7/2 mu, and slips with g (sin(a) - mu
// cos(a)) beyond. With regularised friction a sticking body creeps: a force of f mu N at the speed v_0 atanh(f).
#include <cmath>
#include <cstdint>
#include <fstream>

#include <catch2/catch.hpp>

#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

std::string inclined_gravity(double angle) {
  return fmt::format("[{:.17g}, 0, {:.17g}]", g * std::sin(angle), -g * std::cos(angle));
}

/// Returns the acceleration along x of a ball that starts at rest in contact, over 0.1 s at the end.
double acceleration_of_ball(double angle, double friction) {
  const double depth = std::pow(g * std::cos(angle) / 1e9, 1 / 1.5);
  const std::string text = contact_model(
      {{"ball", fmt::format("position: [0, 0, {:.17g}]", 0.1 - depth)}},
      fmt::format("  it: {{type: contact, shapes: [{{node: ground, plane: [0, 0, 1]}}, {{node: ball, sphere: 0.1}}], "
                  "stiffness: 1e9, damping: 0.5, friction: {{coefficient: {}, velocity: 1e-4}}}}\n",
                  friction),
      inclined_gravity(angle));
  double v = 0, v_before = 0;
  run_contact(text, {1e-3, 0.5}, [&](const Session& session, const Motion&) {
    v = session.node("ball").v.x();
    if (session.time() < 0.4 + 1e-9) v_before = v;
  });
  return (v - v_before) / 0.1;
}

}  // namespace

TEST_CASE("a ball rolls down an incline with 5/7 of gravity's pull, or slips") {
  // m = 1, J = 0.4 m r^2 = 0.004. The force acts at half the depth (2e-6 of the radius) below the surface.
  const double angle = 0.3;
  CHECK_THAT(acceleration_of_ball(angle, 0.3), Catch::WithinRel(5. / 7 * g * std::sin(angle), 1e-4));
  CHECK_THAT(acceleration_of_ball(angle, 0.05), Catch::WithinRel(g * (std::sin(angle) - 0.05 * std::cos(angle)), 1e-4));
}

TEST_CASE("a block creeps below the friction angle, as documented, and slides above it") {
  const auto velocities = [](double angle) {
    const std::string text = contact_model(
        {{"block", "position: [0, 0, 0.1]", 2, {0.02, 0.02, 0.02}}},
        "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: block, box: [0.4, 0.3, 0.2]}], "
        "stiffness: 1e7, damping: 30, friction: {coefficient: 0.5, velocity: 1e-3}}\n",
        inclined_gravity(angle));
    std::pair<double, double> v;
    run_contact(text, {5e-4, 0.5}, [&](const Session& session, const Motion&) {
      v.second = session.node("block").v.x();
      if (session.time() < 0.4 + 1e-9) v.first = v.second;
    });
    return v;
  };
  const double below = std::atan(0.4), above = std::atan(0.7);
  const double creep = 1e-3 * std::atanh(0.4 / 0.5);
  CHECK_THAT(velocities(below).first, Catch::WithinRel(creep, 1e-4));
  CHECK_THAT(velocities(below).second, Catch::WithinRel(creep, 1e-4));
  const auto [v_before, v] = velocities(above);
  CHECK_THAT((v - v_before) / 0.1, Catch::WithinRel(g * (std::sin(above) - 0.5 * std::cos(above)), 1e-4));
}

TEST_CASE("a floor of triangles is a plane: a ball falls, bounces, rolls across the edges between them") {
  const TemporaryFolder folder;
  // The file has a square of 2 m in 8 x 8 cells of two triangles, in binary form and in millimetres.
  {
    std::ofstream file(folder.path() + "/floor.stl", std::ios::binary);
    const std::string header(80, ' ');
    file.write(header.data(), 80);
    const std::uint32_t count = 128;
    file.write(reinterpret_cast<const char*>(&count), 4);
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        for (const int half : {0, 1}) {
          const float a = -1000.F + 250.F * static_cast<float>(i), b = -1000.F + 250.F * static_cast<float>(j);
          const float lower[12] = {0, 0, 1, a, b, 0, a + 250, b, 0, a + 250, b + 250, 0};
          const float upper[12] = {0, 0, 1, a, b, 0, a + 250, b + 250, 0, a, b + 250, 0};
          file.write(reinterpret_cast<const char*>(half == 0 ? lower : upper), 48);
          file.write("\0\0", 2);
        }
  }
  const auto last = [&](const std::string& floor) {
    const std::string text =
        contact_model({{"ball", "position: [-0.6, -0.3, 0.12], velocity: [1.5, 0.8, 0], angular_velocity: [0, 3, 1]"}},
                      "  it: {type: contact, shapes: [{node: ground, " + floor +
                          "}, {node: ball, sphere: 0.1}], stiffness: 1e6, restitution: 0.7, friction: {coefficient: "
                          "0.3, velocity: 0.01}}\n",
                      "[0, 0, -9.81]");
    const std::string path = folder.file("model.yaml", text);
    const MechanismFile file = read_mechanism_file(path);
    Session session(file.model);
    DynamicsOptions options;
    options.duration = 0.6;
    options.stepping.size = 5e-4;
    Motion motion = session.dynamics(options);
    motion.finish();
    return session.node("ball");
  };
  const NodeState plane = last("plane: [0, 0, 1]"), triangles = last("surface: floor.stl, units: mm");
  CHECK(plane.x.x() > 0);
  CHECK((plane.x - triangles.x).norm() < 1e-9);
  CHECK((plane.v - triangles.v).norm() < 1e-8);
  CHECK((plane.R - triangles.R).norm() < 1e-8);
}

// Loops that move although the count of constraints denies it: Bennett's, Bricard's, a planar four-bar of hinges in
// space.
//
// Bennett (G. T. Bennett, Engineering 76, 1903): four hinges, opposite links equal, lengths a, b and twists alpha, beta
// with a/sin(alpha) = b/sin(beta); consecutive angles obey tan(t_1/2) tan(t_2/2) = sin((beta + alpha)/2)/sin((beta -
// alpha)/2). Bricard, threefold symmetric with twists of +-90 degrees (Y. Chen, Z. You, T. Tarnai, Int. J. Solids
// Struct. 42, 2005, 2287): six hinges, angles t and p in turn, cos(t) + cos(p) + cos(t) cos(p) = 0. Both relations were
// checked by multiplying the transformations of the links: the loops close to 2e-16.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

struct Link {
  double angle, length, twist;  ///< about z, along x, about x
};

/// Returns a loop of links: link k carries hinge k + 1; the first hinge is on the ground and driven. Angles are zero in
/// the drawn position.
std::string loop(const std::vector<Link>& links, const std::string& drive) {
  std::string nodes = "nodes:\n", elements = "elements:\n", joints = "joints:\n";
  Isometry3d frame = Isometry3d::Identity();
  const std::size_t n = links.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector3d at = frame.translation(), z = frame.linear().col(2);
    const std::string here = k + 1 < n ? fmt::format("l{}", k) : "ground",
                      before = k == 0 ? "ground" : fmt::format("l{}", k - 1);
    if (k + 1 < n) {
      nodes += fmt::format("  l{}: {{position: [{:.17g}, {:.17g}, {:.17g}]}}\n", k, at.x(), at.y(), at.z());
      elements += fmt::format("  b{}: {{type: rigid_body, node: l{}, mass: 1, inertia: [0.01, 0.01, 0.01]}}\n", k, k);
    }
    joints += fmt::format(
        "  h{}: {{type: hinge, nodes: [{}, {}], position: [{:.17g}, {:.17g}, {:.17g}], axis: [{:.17g}, {:.17g}, "
        "{:.17g}]}}\n",
        k, before, here, at.x(), at.y(), at.z(), z.x(), z.y(), z.z());
    frame = frame * AngleAxisd(links[k].angle, Vector3d::UnitZ()) * Eigen::Translation3d(links[k].length, 0, 0) *
            AngleAxisd(links[k].twist, Vector3d::UnitX());
  }
  // The last hinge closes the loop, which begins again in the first frame.
  return nodes + elements + joints + drive;
}

double offset(double angle) { return std::remainder(angle, 2 * M_PI); }

}  // namespace

TEST_CASE("Bennett's loop moves with one degree of freedom as its relation says") {
  const double alpha = 0.5, beta = 1.1, a = 0.3, b = a * std::sin(beta) / std::sin(alpha);
  const double k = std::sin(0.5 * (beta + alpha)) / std::sin(0.5 * (beta - alpha));
  const auto second = [&](double first) { return 2 * std::atan(k / std::tan(0.5 * first)); };
  const double start = 0.7;
  const std::string text =
      loop({{start, a, alpha}, {second(start), b, beta}, {-start, a, alpha}, {-second(start), b, beta}},
           "drives: {motor: {joint: h0, angle: \"1.2*t\"}}\n");
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "bennett.yaml");
  Session session(file.model);
  CHECK(session.redundant().size() >= 1);
  CHECK(session.mobility().degrees == 0);  // one, which is driven
  move(text, 0.01, 1.5, [&](const Session& moving) {
    const double first = start + 1.2 * moving.time();
    CHECK(offset(moving.read("joints/h1/coordinate")[0] - second(first) + second(start)) == Approx(0).margin(1e-8));
    CHECK(offset(moving.read("joints/h2/coordinate")[0] + first - start) == Approx(0).margin(1e-8));
  });
}

TEST_CASE("Bricard's loop of six hinges moves as its relation says") {
  const auto other = [](double t) { return std::acos(-std::cos(t) / (1 + std::cos(t))); };
  const double start = 1.9, quarter = M_PI / 2;
  std::vector<Link> links;
  for (int k = 0; k < 3; ++k) {
    links.push_back({start, 1, quarter});
    links.push_back({other(start), 1, -quarter});
  }
  const std::string text = loop(links, "drives: {motor: {joint: h0, angle: \"-0.4*t\"}}\n");
  move(text, 0.01, 1, [&](const Session& session) {
    const double t = start - 0.4 * session.time();
    for (const char* joint : {"joints/h1/coordinate", "joints/h3/coordinate", "joints/h5/coordinate"})
      CHECK(session.read(joint)[0] == Approx(other(t) - other(start)).margin(1e-8));
    CHECK(session.read("joints/h2/coordinate")[0] == Approx(t - start).margin(1e-8));
  });
}

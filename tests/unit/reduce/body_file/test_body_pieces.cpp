// Tests of `pieces` in body files: planes, lines and arcs, and the messages about wrong ones.
#include <cmath>

#include <catch2/catch.hpp>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::message_of;
using Catch::Contains;

namespace test_body_pieces {
namespace {

BodyFile read(const std::string& pieces) {
  return parse_body_file(
      "body: rod\n"
      "parameters: {parts: 5}\n"
      "geometry: rod.step\n"
      "mesh: {size: 3e-3}\n"
      "materials: {steel: {young: 210e9, poisson: 0.3, density: 7850}}\n"
      "regions: {all: steel}\n"
      "interfaces: {root: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}}}\n"
      "modes: {count: 2}\n"
      "pieces: " +
          pieces + "\n",  // 9
      "rod.yaml");
}

std::string message(const std::string& pieces) {
  return message_of<InputError>([&] { read(pieces); });
}

}  // namespace

TEST_CASE("planes are given by point and normal, or normal to an axis") {
  const BodyFile body = read(
      "{planes: [{point: [1, 2, 3], normal: [0, 0, 2], name: waist}, {axis: y, at: 0.5}, {axis: x, at: [1, "
      "\"parts/2\"]}]"
      ", tie: average, compare: false}");
  REQUIRE(body.pieces);
  CHECK(body.pieces->tie == Tie::average);
  CHECK_FALSE(body.pieces->compare);
  const std::vector<CutPlane>& cuts = body.mesh.cuts;
  REQUIRE(cuts.size() == 4);
  CHECK(cuts[0].name == "waist");
  CHECK(cuts[0].point == Eigen::Vector3d(1, 2, 3));
  CHECK(cuts[0].normal == Eigen::Vector3d(0, 0, 1));
  CHECK(cuts[0].subject == "pieces.planes[1]");
  CHECK(cuts[1].name == "cut_2");
  CHECK(cuts[1].point == Eigen::Vector3d(0, 0.5, 0));
  CHECK(cuts[3].name == "cut_4");
  CHECK(cuts[3].point == Eigen::Vector3d(2.5, 0, 0));
  CHECK(cuts[3].normal == Eigen::Vector3d(1, 0, 0));
  CHECK(read("{planes: {axis: z, at: 1}}").mesh.cuts.size() == 1);
  CHECK(read("{planes: {axis: z, at: 1}}").pieces->tie == Tie::rigid);
}

TEST_CASE("lines and arcs are cut into equal parts") {
  const std::vector<CutPlane> line = read("{count: parts, line: {from: [1, 0, 0], to: [1, 10, 0]}}").mesh.cuts;
  REQUIRE(line.size() == 4);
  CHECK((line[2].point - Eigen::Vector3d(1, 6, 0)).norm() < 1e-14);
  CHECK(line[2].normal == Eigen::Vector3d(0, 1, 0));
  // The arc starts at the origin along x, and is a quarter of a circle of radius 2 towards -y.
  const std::vector<CutPlane> arc =
      read("{count: 3, arc: {from: [0, 0, 0], centre: [0, -2, 0], axis: [0, 0, -1], angle: \"pi/2\"}}").mesh.cuts;
  REQUIRE(arc.size() == 2);
  const double third = std::acos(-1.0) / 6;
  CHECK((arc[0].point - Eigen::Vector3d(2 * std::sin(third), 2 * std::cos(third) - 2, 0)).norm() < 1e-14);
  CHECK((arc[0].normal - Eigen::Vector3d(std::cos(third), -std::sin(third), 0)).norm() < 1e-14);
}

TEST_CASE("positions of cuts have units") {
  const std::vector<CutPlane> cuts =
      read("{planes: [{point: [1 mm, 0, 0], normal: [1, 0, 0]}, {axis: x, at: [3 cm, 4 in]}]}").mesh.cuts;
  REQUIRE(cuts.size() == 3);
  CHECK(cuts[0].point.x() == Approx(1e-3));
  CHECK(cuts[1].point.x() == Approx(0.03));
  CHECK(cuts[2].point.x() == Approx(0.1016));
  const auto arc = [](const std::string& angle) {
    return "{count: 4, arc: {from: [1, 0, 0], centre: [0, 0, 0], axis: [0, 0, 1], angle: " + angle + "}}";
  };
  CHECK((read(arc("360 deg")).mesh.cuts[0].point - Eigen::Vector3d(0, 1, 0)).norm() < 1e-14);
  CHECK_THAT(message(arc("3 mm")), Contains("pieces.arc.angle: expected a value in rad, found one in 'mm'"));
  CHECK_THAT(message("{planes: {axis: x, at: 3 deg}}"),
             Contains("pieces.planes.at: expected a value in m, found one in 'deg'"));
}

TEST_CASE("a plane has the keys of its kind") {
  CHECK_THAT(message("{planes: {axs: x, at: 1}}"),
             Contains("'axs' is not a key of a plane that cuts; did you mean 'axis'?"));
  CHECK_THAT(message("{planes: {axis: x, at: 1, normal: [1, 0, 0]}}"),
             Contains("'normal' is not a key of planes normal to an axis"));
}

TEST_CASE("impossible cuts are refused with their place in the file") {
  CHECK_THAT(message("{planes: []}"), Contains("rod.yaml:9: pieces.planes: expected at least one plane"));
  CHECK_THAT(message("{plane: [{axis: x, at: 1}]}"), Contains("did you mean 'planes'?"));
  CHECK_THAT(message("{planes: [{point: [0, 0, 0], normal: [0, 0, 0]}]}"), Contains("pieces.planes[1].normal"));
  CHECK_THAT(message("{planes: [{axis: q, at: 1}]}"), Contains("'q'"));
  CHECK_THAT(message("{planes: [{axis: x, at: [1, 2], name: a}]}"), Contains("one name goes with one plane"));
  CHECK_THAT(message("{planes: [{axis: x, at: 1, name: a}, {axis: x, at: 2, name: a}]}"),
             Contains("pieces.planes[2]: there are two cuts 'a'"));
  CHECK_THAT(message("{planes: {axis: x, at: 1}, count: 2}"), Contains("pieces.count"));
  CHECK_THAT(message("{count: 3}"), Contains("expected exactly one of planes, line (with count), arc (with count)"));
  CHECK_THAT(message("{count: 1, line: {from: [0, 0, 0], to: [1, 0, 0]}}"),
             Contains("pieces.count: expected a number between 2 and 1000, found 1"));
  CHECK_THAT(message("{count: 3, line: {from: [0, 0, 0], to: [0, 0, 0]}}"), Contains("two different points"));
  CHECK_THAT(message("{count: 3, arc: {from: [0, 0, 1], centre: [0, 0, 0], axis: [0, 0, 1], angle: 1}}"),
             Contains("lies on the axis"));
  CHECK_THAT(message("{count: 3, arc: {from: [1, 0, 1], centre: [0, 0, 0], axis: [0, 0, 1], angle: 45}}"),
             Contains("expected an angle [rad] up to 2 pi"));
  CHECK_THAT(message("{planes: {axis: x, at: 1}, tie: rigd}"), Contains("did you mean 'rigid'?"));
}

}  // namespace test_body_pieces

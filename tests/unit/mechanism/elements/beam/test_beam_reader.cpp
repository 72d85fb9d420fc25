// Beams as input: geometry, attachment to nodes, messages.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "mechanism/elements/beam/beam_geometry.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/model_text.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::error;
using bielle::test::model_from_text;
using Catch::Contains;
using std::numbers::pi;

namespace test_beam_reader {
namespace {

const std::string section = "section: {EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 6}";

std::unique_ptr<Model> beam(const std::string& keys, const std::string& a = "{position: [0, 0, 0]}",
                            const std::string& b = "{position: [2, 0, 0]}") {
  return model_from_text("nodes: {a: " + a + ", b: " + b + "}\nelements:\n  shaft: {type: beam, nodes: [a, b], " +
                         keys + "}\n");
}

}  // namespace

TEST_CASE("a straight beam makes its inner nodes in line, with the section's axes") {
  const auto model = beam(section + ", elements: 4, orientation: [1, 0, 1]");
  REQUIRE(model->nodes().size() == 6);
  CHECK(model->members().size() == 4);
  CHECK(model->members()[2].entry == Entry{Section::elements, "shaft"});
  CHECK(model->members()[2].recorded == Recorded::stacked);
  REQUIRE(model->chains().size() == 1);
  CHECK(model->chains()[0].nodes == std::vector<int>{1, 3, 4, 5, 2});
  const Node& second = model->node(*model->find_node("shaft.2"));
  CHECK(second.internal);
  CHECK(error(second.frame.x, Vector3(1, 0, 0)) < 1e-15);
  Matrix3 axes;
  axes << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // y along inertial z
  CHECK(error(second.frame.R, axes) < 1e-15);
}

TEST_CASE("a beam has eight elements unless told otherwise") { CHECK(beam(section)->members().size() == 8); }

TEST_CASE("a beam is free of stress as placed, whatever the axes of its nodes") {
  const auto model = beam(section + ", elements: 5, twist: 1.3, arc_through: [1, 1, 0.3]",
                          "{position: [0, 0, 0], rotation_vector: [1, 2, 0.5]}",
                          "{position: [2, 0, 0], rotation_vector: [0, -2, 0.5]}");
  const DenseModel dense(*model);
  CHECK(dense.residual(dense.start()).norm() < 1e-13);
  CHECK(error(model->node(1).frame.R, exp_so3(Vector3(1, 2, 0.5))) == 0);
}

TEST_CASE("without an orientation the section's y is the inertial axis most normal to the beam") {
  const auto y_axis = [](const std::string& end) {
    const auto model = beam(section + ", elements: 2", "{position: [0, 0, 0]}", "{position: " + end + "}");
    return Vector3(model->node(3).frame.R.col(1));
  };
  CHECK(error(y_axis("[2, 0, 0]"), Vector3::UnitY()) < 1e-15);
  CHECK(error(y_axis("[0, 2, 0]"), Vector3::UnitX()) < 1e-15);
  CHECK(error(y_axis("[0, 0, -2]"), Vector3::UnitX()) < 1e-15);
  CHECK(error(y_axis("[2, 2, 0]"), Vector3::UnitZ()) < 1e-15);
}

TEST_CASE("arcs by their centre or a third point pass where they should") {
  // A quarter of the unit circle about z, both ways of giving it.
  for (const char* arc : {"arc_centre: [1, 0, 0]", "arc_through: ['1 - cos(pi/4)', 'sin(pi/4)', 0]"}) {
    const auto model = beam(section + ", elements: 3, " + arc, "{position: [0, 0, 0]}", "{position: [1, 1, 0]}");
    for (int k : {1, 2}) {
      const double angle = k * pi / 6;
      const Frame& frame = model->node(2 + k).frame;
      CHECK(error(frame.x, Vector3(1 - std::cos(angle), std::sin(angle), 0)) < 1e-14);
      CHECK(error(frame.R.col(0), Vector3(std::sin(angle), std::cos(angle), 0)) < 1e-14);
    }
    CHECK(error(model->node(3).frame.R.col(1), Vector3(std::cos(pi / 6), -std::sin(pi / 6), 0)) < 1e-14);
  }
  // Three quarters of it, from (0,0) round over (2,0) to (1,1).
  const auto long_way =
      beam(section + ", elements: 3, arc_through: [2, 0, 0]", "{position: [0, 0, 0]}", "{position: [1, 1, 0]}");
  CHECK(error(long_way->node(3).frame.x, Vector3(1, -1, 0)) < 1e-14);
  CHECK(error(long_way->node(4).frame.x, Vector3(2, 0, 0)) < 1e-14);
  CHECK(error(long_way->node(3).frame.R.col(0), Vector3(1, 0, 0)) < 1e-14);
}

TEST_CASE("the centre of an arc may be rounded: the arc leads from node to node") {
  const Vector3 start(0, 0, 0), end(1, 1, 0);
  const BeamLine line =
      read_beam_line(bielle::YamlValue::parse("arc_centre: [1.000004, 0, 0]", "arc.yaml"), start, end);
  CHECK(error(line.point(0), start) < 1e-15);
  CHECK(error(line.point(1), end) < 1e-15);
  CHECK(error(line.point(0.5), Vector3(1 - std::cos(pi / 4), std::sin(pi / 4), 0)) < 4e-6);
}

TEST_CASE("twist turns the section about the axis, linearly from start to end") {
  const auto model = beam(section + ", elements: 4, twist: pi/2");
  CHECK(error(model->node(4).frame.R, exp_so3(Vector3(pi / 4, 0, 0))) < 1e-14);
}

TEST_CASE("inner nodes start with the velocity of the rigid motion of their ends") {
  const Vector3 omega(0.3, -0.2, 0.5), v(1, 2, 3);
  const auto model = beam(section + ", elements: 4, arc_through: [1, 1, 0.3]",
                          "{position: [0, 0, 0], velocity: [1, 2, 3], angular_velocity: [0.3, -0.2, 0.5]}",
                          // v + omega x (2, 0, 0)
                          "{position: [2, 0, 0], velocity: [1, 3, 3.4], angular_velocity: [0.3, -0.2, 0.5]}");
  for (int k = 3; k < 6; ++k) {
    const Node& node = model->node(k);
    CHECK(error(node.velocity, v + omega.cross(node.frame.x)) < 1e-14);
    CHECK(error(node.frame.R * node.angular_velocity, omega) < 1e-14);
  }
}

TEST_CASE("start velocities of inner nodes go over from the motion of one end to that of the other") {
  const auto model =
      beam(section + ", elements: 4", "{position: [0, 0, 0], velocity: [1, 0, 0], angular_velocity: [0, 0, 1]}",
           "{position: [2, 0, 0], rotation_vector: [0, 0, pi/2], angular_velocity: [2, 0, 3]}");
  // The point is at a quarter of the length: the start alone would move it by (1, 0.5, 0), the end by (0, 3, -2) x
  // (-1.5, 0, 0).
  const Node& node = model->node(3);
  CHECK(error(node.velocity, 0.75 * Vector3(1, 0.5, 0) + 0.25 * Vector3(0, 2, 3).cross(Vector3(-1.5, 0, 0))) < 1e-14);
  CHECK(error(node.frame.R * node.angular_velocity, Vector3(0, 0.5, 1.5)) < 1e-14);
}

TEST_CASE("a beam that cannot be built says why") {
  CHECK_THROWS_WITH(beam(section + ", elements: 0"),
                    Contains("elements.shaft.elements") && Contains("between 1 and 100000, found 0"));
  CHECK_THROWS_WITH(beam(section + ", bending: resdual"),
                    Contains("elements.shaft.bending") && Contains("did you mean 'residual'"));
  CHECK_THROWS_WITH(beam(section + ", orientation: [3, 0, 0]"), Contains("parallel to the beam's axis"));
  CHECK_THROWS_WITH(beam(section + ", damping: -1"), Contains("elements.shaft.damping"));
  CHECK_THROWS_WITH(beam(section + ", arc_centre: [0.5, 1, 0]"), Contains("not at one distance from the centre"));
  CHECK_THROWS_WITH(beam(section + ", arc_centre: [1, 0, 0]"), Contains("half circle") && Contains("`arc_through`"));
  CHECK_THROWS_WITH(beam(section + ", arc_centre: [1, 1e8, 0]"), Contains("turns by less than 1e-06 rad"));
  CHECK_THROWS_WITH(beam(section + ", arc_through: [1, 0, 0]"), Contains("in one line"));
  CHECK_THROWS_WITH(beam(section + ", arc_centre: [1, 1, 0], arc_through: [1, 1, 0]"),
                    Contains("either `arc_centre` or `arc_through`"));
  CHECK_THROWS_WITH(beam(section, "{position: [2, 0, 0]}"), Contains("same place") && !Contains("full circle"));
  CHECK_THROWS_WITH(beam(section + ", arc_centre: [1, 0, 0]", "{position: [2, 0, 0]}"),
                    Contains("same place") && Contains("make a full circle of two arcs"));
  CHECK_THROWS_WITH(beam(section + ", elements: 1e12"),
                    Contains("elements.shaft.elements") && Contains("between 1 and 100000"));
  CHECK_THROWS_WITH(beam(section + ", elements: 1e6"), Contains("between 1 and 100000, found"));
  CHECK_THROWS_WITH(beam(section + ", elements: 1, arc_through: [1, -1e2, 0]"),
                    Contains("its one element would turn by 3") && Contains("none follows more than 171"));
  CHECK_THROWS_WITH(beam(section + ", elements: 2, twist: 7"),
                    Contains("each of 2 elements would turn by 201 degrees"));
  CHECK_THROWS_WITH(beam("elements: 2"), Contains("section"));
  CHECK_THROWS_WITH(
      model_from_text("nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}, shaft.1: {position: [2, 0, 0]}}\n"
                      "elements: {shaft: {type: beam, nodes: [a, b], " +
                      section + "}}"),
      Contains("model.yaml:2") && Contains("already a node 'shaft.1'"));
  CHECK_THROWS_WITH(beam(section + ", lenght: 2"), Contains("'lenght' is not a key of a beam"));
}

TEST_CASE("angles, times and lengths of beams may have units, which must fit") {
  const auto turned = beam(section + ", elements: 4, twist: 90 deg, damping: 2 ms, arc_through: [100 cm, 1, 0]"),
             plain = beam(section + ", elements: 4, twist: pi/2, damping: 0.002, arc_through: [1, 1, 0]");
  for (std::size_t k = 0; k < plain->nodes().size(); ++k) {
    CHECK(error(turned->nodes()[k].frame.x, plain->nodes()[k].frame.x) < 1e-14);
    CHECK(error(turned->nodes()[k].frame.R, plain->nodes()[k].frame.R) < 1e-14);
  }
  CHECK_THROWS_WITH(beam(section + ", damping: 2 m"),
                    Contains("elements.shaft.damping: expected a value in s, found one in 'm'"));
  CHECK_THROWS_WITH(beam(section + ", twist: 1 m"),
                    Contains("elements.shaft.twist: expected a value in rad, found one in 'm'"));
}

}  // namespace test_beam_reader

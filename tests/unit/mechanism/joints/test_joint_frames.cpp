// Positions of joints on their nodes: by one place, by points and axes of each node, by nothing.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/joints/joint.hpp"

using namespace bielle::mechanism;

namespace {

/// Returns two nodes turned relative to each other, and a hinge with the given keys.
MechanismFile with_hinge(const std::string& keys) {
  return read_mechanism_text(R"yaml(
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}
joints: {it: {type: hinge, nodes: [a, b], )yaml" +
                                 keys + "}}\n",
                             "hinge.yaml");
}

JointFrames frames_of(const MechanismFile& file) {
  return dynamic_cast<const Joint&>(*file.model.components_of({Section::joints, "it"}).front()).frames();
}

Frame drawn(const MechanismFile& file, const char* name) { return file.model.node(*file.model.find_node(name)).frame; }

}  // namespace

TEST_CASE("a joint at one place has frames that coincide as drawn") {
  const MechanismFile file = with_hinge("position: [0.5, 0.2, 0.1], axis: [1, 2, 3]");
  const JointFrames frames = frames_of(file);
  const Frame first = drawn(file, "a") * frames.on_first, second = drawn(file, "b") * frames.on_second;
  CHECK((first.x - Vector3(0.5, 0.2, 0.1)).norm() < 1e-15);
  CHECK((second.x - first.x).norm() < 1e-15);
  CHECK((second.R - first.R).norm() < 1e-14);
  CHECK((first.R.col(2) - Vector3(1, 2, 3).normalized()).norm() < 1e-14);
  CHECK(frames.arm == 0);
}

TEST_CASE("points and axes of each node stand in the nodes' own axes") {
  const JointFrames frames = frames_of(
      with_hinge("at: [[1, 2, 3], [4, 5, 6]], axis: [[0, 1, 0], [0, 0, 2]], second_axis: [[1, 3, 0], [0, -1, 5]]"));
  CHECK(frames.on_first.x == Vector3(1, 2, 3));
  CHECK(frames.on_second.x == Vector3(4, 5, 6));
  CHECK((frames.on_first.R.col(2) - Vector3::UnitY()).norm() < 1e-14);
  CHECK((frames.on_second.R.col(2) - Vector3::UnitZ()).norm() < 1e-14);
  CHECK((frames.on_first.R.col(0) - Vector3::UnitX()).norm() < 1e-14);
  CHECK((frames.on_second.R.col(0) + Vector3::UnitY()).norm() < 1e-14);
  CHECK(frames.arm == 0);
}

TEST_CASE("with points of each node and inertial axes the axes coincide as drawn") {
  const MechanismFile file = with_hinge("at: [[1, 2, 3], [4, 5, 6]], axis: [1, 2, 3], second_axis: [0, 1, 0]");
  const JointFrames frames = frames_of(file);
  CHECK((drawn(file, "a").R * frames.on_first.R - drawn(file, "b").R * frames.on_second.R).norm() < 1e-14);
}

TEST_CASE("where axes are drawn askew and no second one is given, x follows by the smallest turn between them") {
  const MechanismFile file = with_hinge("position: [0, 0, 0], axis: [[0, 1, 0], [0, 0, 1]]");
  const JointFrames frames = frames_of(file);
  const Matrix3 A = drawn(file, "a").R * frames.on_first.R, B = drawn(file, "b").R * frames.on_second.R;
  const Vector3 turn = log_so3(Matrix3(B * A.transpose()));  // inertial
  const Vector3 normal = A.col(2).cross(B.col(2));
  CHECK(turn.norm() == Approx(std::atan2(normal.norm(), A.col(2).dot(B.col(2)))).epsilon(1e-12));
  CHECK((turn.normalized() - normal.normalized()).norm() < 1e-12);
}

TEST_CASE("a joint without a place is attached at its second node and knows the arm to the first") {
  const MechanismFile file = with_hinge("axis: [1, 2, 3]");
  const JointFrames frames = frames_of(file);
  CHECK(frames.on_second.x.norm() < 1e-15);
  CHECK(((drawn(file, "a") * frames.on_first).x - Vector3(1.1, 0.5, 0.4)).norm() < 1e-15);
  CHECK(frames.arm == Approx(Vector3(0.8, 0.4, 0.6).norm()).epsilon(1e-14));
}

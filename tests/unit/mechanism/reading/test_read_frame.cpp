// Orientations in model files: every key gives its rotation, and values that give none are refused with their place.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/math/rotation_parameters.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::InputError;
using bielle::YamlValue;
using bielle::test::error;
using bielle::test::message_of;
using Catch::Contains;

namespace {

Frame frame(const std::string& text) {
  static const bielle::KeyTable table{"a frame", "A frame.", frame_keys()};
  return read_frame(YamlValue::parse(text, "model.yaml").keyed(table));
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { frame(text); });
}

std::string list(const VectorX& v) {
  std::string text = "[";
  for (const double x : v) text += fmt::format("{:.17g}, ", x);
  return text + "]";
}

}  // namespace

TEST_CASE("each key of an orientation gives the same rotation") {
  const Matrix3 R = exp_so3({0.4, -1.1, 0.7});
  const auto check = [&](const std::string& text) {
    CAPTURE(text);
    CHECK(error(frame(text).R, R) < 1e-15 * 4);
  };
  check("rotation_vector: " + list(RotationVector::parameters(R)));
  check("quaternion: " + list(-2 * UnitQuaternion::parameters(R)));
  check("bryant: " + list(BryantAngles::parameters(R)));
  check("euler: " + list(EulerAngles::parameters(R)));
  check("rodrigues: " + list(RodriguesVector::parameters(R)));
  check("conformal: " + list(ConformalVector::parameters(R)));
  check(fmt::format("matrix: [{}, {}, {}]", list(R.row(0)), list(R.row(1)), list(R.row(2))));
  // Every pair of axes, the second with some of the first in it, either way round.
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j)
        check(fmt::format("axes: {{{}: {}, {}: {}}}", "xyz"[i], list(3 * R.col(i)), "xyz"[j],
                          list(2 * R.col(j) - R.col(i))));
}

TEST_CASE("numbers of an orientation may be formulas, and half turns are no trouble") {
  const Matrix3 half = Vector3(-1, -1, 1).asDiagonal();
  CHECK(error(frame("rotation_vector: [0, 0, pi]").R, half) < 1e-15);
  CHECK(error(frame("{position: [1, 2, \"1+2\"], conformal: [0, 0, \"4*tan(pi/4)\"]}").R, half) < 1e-15);
  CHECK(error(frame("{position: [1, 2, \"1+2\"]}").x, Vector3(1, 2, 3)) == 0);
  CHECK(frame("{}").R == Matrix3::Identity());
}

TEST_CASE("a matrix of a few digits is made orthonormal; one that is no rotation is refused") {
  const Matrix3 R = frame("matrix: [[0.8660, -0.5, 0], [0.5, 0.8660, 0], [0, 0, 1]]").R;
  CHECK(error(R.transpose() * R, Matrix3::Identity()) < 1e-15);
  CHECK(error(R, exp_so3({0, 0, M_PI / 6})) < 1e-4);
  CHECK_THAT(refusal("matrix: [[1, 0, 0], [0, 2, 0], [0, 0, 1]]"),
             Contains("model.yaml:1: matrix") && Contains("length"));
  CHECK_THAT(refusal("matrix: [[1, 0, 0], [0, 1, 0.0011], [0, 0, 1]]"), Contains("off by up to 0.0011"));
  CHECK_THAT(refusal("matrix: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]"), Contains("left-handed"));
  CHECK_THAT(refusal("matrix: [[1, 0], [0, 1]]"), Contains("model.yaml:1: matrix"));
}

TEST_CASE("what gives no orientation is refused") {
  CHECK_THAT(refusal("{bryant: [0, 0, 1], euler: [0, 0, 1]}"), Contains("two orientations") && Contains("euler"));
  CHECK_THAT(refusal("quaternion: [1, 0, 0]"), Contains("w x y z"));
  CHECK_THAT(refusal("quaternion: [0, 0, 0, 0]"), Contains("length zero"));
  CHECK_THAT(refusal("bryant: [1, 2]"), Contains("model.yaml:1: bryant"));
  CHECK_THAT(refusal("axes: {x: [1, 0, 0], y: [2, 0, 0]}"), Contains("parallel"));
  CHECK_THAT(refusal("axes: {x: [0, 0, 0], y: [0, 1, 0]}"), Contains("axes.x"));
  CHECK_THAT(refusal("axes: {x: [1, 0, 0]}"), Contains("two of the axes"));
  CHECK_THAT(refusal("axes: {x: [1, 0, 0], w: [2, 0, 0]}"), Contains("'w'"));
}

TEST_CASE("positions and angles may have units, which must fit") {
  CHECK(error(frame("position: [12 mm, 1 inch, 0]").x, Vector3(0.012, 0.0254, 0)) < 1e-16);
  CHECK(error(frame("bryant: [0, 0, 90 deg]").R, exp_so3({0, 0, M_PI / 2})) < 1e-15);
  CHECK_THAT(refusal("position: [12 s, 0, 0]"),
             Contains("model.yaml:1: position[1]: expected a value in m, found one in 's'"));
  CHECK_THAT(refusal("bryant: [12 mm, 0, 0]"),
             Contains("model.yaml:1: bryant[1]: expected a value in rad, found one in 'mm'"));
}

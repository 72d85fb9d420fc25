// Constraints of single held directions. (Motions and reactions: tests/benchmarks/joints/test_held_directions.cpp.)
#include <array>
#include <memory>

#include <catch2/catch.hpp>

#include "mechanism/elements/forces/held_directions.hpp"
#include "mechanism/math/so3.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/model_text.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;

TEST_CASE("as drawn, the gradient of a held direction is its axis, whether one or two rotations are held") {
  const Matrix3 axes = exp_so3(Vector3(0.3, -0.8, 0.5));
  for (const std::array<bool, 6>& held :
       {std::array{false, false, false, true, false, false}, std::array{false, false, false, false, true, false},
        std::array{false, false, false, false, false, true}, std::array{false, true, false, true, true, false},
        std::array{false, false, true, true, false, true}, std::array{true, false, false, false, true, true}}) {
    const std::unique_ptr<Model> model =
        model_from_text("nodes: {a: {rotation_vector: [0.2, 0.4, -0.1]}}\nloads: {push: {node: a, force: [1, 0, 0]}}");
    const int index = *model->find_node("a");
    const Node& node = model->node(index);
    model->add(std::make_unique<HeldDirections>(node, index, axes, held), Entry{Section::supports, "a"}, Recorded::no);
    const DenseModel dense(*model);
    const MatrixX K = dense.tangent(dense.start(), DenseModel::Part::K);
    int row = dense.multiplier_begin();
    for (int k = 0; k < 6; ++k) {
      if (!held[static_cast<std::size_t>(k)]) continue;
      Vector6 gradient = Vector6::Zero();
      if (k < 3)
        gradient.head<3>() = axes.col(k);
      else
        gradient.tail<3>() = node.frame.R.transpose() * axes.col(k - 3);
      CHECK((K.row(row++).segment<6>(6 * index).transpose() - gradient).norm() < 1e-14);
    }
    CHECK(row == dense.size());
  }
}

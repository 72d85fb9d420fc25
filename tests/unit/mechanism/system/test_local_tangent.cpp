// Requests of a component to its local matrices, and the places of its blocks.
#include <catch2/catch.hpp>

#include "mechanism/system/system.hpp"

using namespace bielle::mechanism;

namespace {

/// A body without rotation whose tangent is one number, written as its argument says.
class Body final : public Component {
 public:
  Body(int node, bool claims_blocks, bool asks_dense)
      : Component("body", "body"), node_(node), claims_blocks_(claims_blocks), asks_dense_(asks_dense) {}
  void declare(Declaration& declaration) const override {
    declaration.nodes = {node_};
    declaration.mass = true;
    declaration.in_blocks = claims_blocks_;
  }
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override {
    r.head<3>() += 2 * state.node(0).a;
  }
  void add_tangent(const LocalState&, LocalTangent& tangent) const override {
    if (!tangent.wants_M) return;
    if (!asks_dense_) {
      tangent.M.add_identity(0, 0, 2);
      return;
    }
    auto translations = tangent.M.dense().block(0, 0, 3, 3);  // outlives the view that it is of
    translations.diagonal().array() += 2;
  }
  void add_pattern(const Slots&, LocalPattern& pattern) const override { pattern.add_diagonal(0, 0); }

 private:
  int node_;
  bool claims_blocks_, asks_dense_;
};

/// Returns a free node (1), one that is held in a direction (2) and one that the first carries (3).
Model three_nodes() {
  Model model;
  Node node;
  node.name = "free";
  model.add_node(node);
  node.name = "held";
  node.freedom[1] = Freedom::fixed;
  model.add_node(node);
  node = {};
  node.name = "carried";
  node.frame.x = {0, 1, 0};
  node.carrier = 1;
  model.add_node(node);
  return model;
}

MatrixX mass(const Model& model) {
  const System system(model);
  std::vector<double> values;
  system.tangent(system.start(0), model.environment, {0, 0, 1, 0, 0}, nullptr, values);
  MatrixX M = MatrixX::Zero(system.size(), system.size());
  system.pattern().for_each(
      [&](int place, int row, int column) { M(row, column) = values[static_cast<std::size_t>(place)]; });
  return M;
}

}  // namespace

TEST_CASE("blocks and a dense matrix give the same tangent, wherever the node stands") {
  for (const int node : {0, 1, 2, 3}) {
    const auto mass_of = [&](bool claims_blocks, bool asks_dense) {
      Model model = three_nodes();
      model.add(std::make_unique<Body>(node, claims_blocks, asks_dense), {Section::elements, "body"});
      return mass(model);
    };
    CAPTURE(node);
    const MatrixX dense = mass_of(false, true);
    CHECK(dense == mass_of(false, false));
    CHECK(dense == mass_of(true, false));
    CHECK((dense.array() != 0).any() == (node > 0));
  }
}

TEST_CASE("a component that declares blocks alone is held to it") {
  for (const int node : {1, 2, 3}) {
    Model model = three_nodes();
    model.add(std::make_unique<Body>(node, true, true), {Section::elements, "body"});
    CAPTURE(node);
    CHECK_THROWS_AS(mass(model), std::logic_error);
  }
}

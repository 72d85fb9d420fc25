#include "mechanism/system/pair_tangents.hpp"

#include <algorithm>
#include <utility>

#include "mechanism/system/node_relation.hpp"

namespace bielle::mechanism {

PairTangents::PairTangents(const CoupledPairs& component, const NodeKinematics& kinematics, const Slots& slots)
    : component_(component), kinematics_(kinematics), plain_(true) {
  parts_.reserve(slots.nodes.size());
  for (const int node : slots.nodes) {
    const Carry* carry = kinematics.carry(node);
    const NodeFreedom& freedom = kinematics.freedom(carry ? carry->carrier : node);
    plain_ = plain_ && !carry && (freedom.all_free || freedom.count == 0);
    parts_.push_back({node, freedom.begin, freedom.count, {}});
  }
}

void PairTangents::choose(const LocalState& state) {
  thread_local std::vector<std::pair<int, int>> near;
  near.clear();
  component_.add_near_nodes(state, near);
  // Earlier pairs are kept if they are few: iterations may alternate between states with other pairs.
  if (near_.size() <= 2 * near.size() + parts_.size())
    for (const Near& pair : near_) near.emplace_back(pair.a, pair.b);
  for (auto& [a, b] : near)
    if (a > b) std::swap(a, b);
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  near_.clear();
  for (const auto& [a, b] : near)
    if (part(a).count > 0 && part(b).count > 0) near_.push_back({a, b, {}, {}});
}

void PairTangents::find_places(const SparsePattern& pattern) {
  const auto find = [&](const Part& rows, const Part& columns, Columns& places) {
    if (rows.count == 0) return;
    for (int k = 0; k < columns.count; ++k)
      places[static_cast<std::size_t>(k)] = pattern.find(rows.begin, columns.begin + k);
  };
  for (Part& part : parts_) find(part, part, part.diagonal);
  for (Near& pair : near_) {
    find(part(pair.a), part(pair.b), pair.ab);
    find(part(pair.b), part(pair.a), pair.ba);
  }
}

const PairTangents::Near* PairTangents::find(int a, int b) const {
  const auto found =
      std::lower_bound(near_.begin(), near_.end(), std::pair(a, b),
                       [](const Near& each, const auto& wanted) { return std::pair(each.a, each.b) < wanted; });
  return found != near_.end() && found->a == a && found->b == b ? &*found : nullptr;
}

/// Adds pairs to the values of the global tangent.
class PairTangents::Sum final : public PairDerivatives {
 public:
  /// @param relation  relations of the component's nodes; nullptr: all nodes are free or held
  Sum(const PairTangents& all, const LocalState& state, const TangentRequest& request,
      const std::vector<NodeRelation>* relation, std::vector<double>& values)
      : all_(all), state_(state), request_(request), relation_(relation), values_(values) {}
  bool complete() const { return complete_; }

  void add(int a, int b, const Vector12& r, const Matrix12& K, const Matrix12& C) override {
    // A node that is held in all directions, as the ground is, has no entries.
    static constexpr Near none{};
    const Part &first = all_.part(a), &second = all_.part(b);
    const bool both_move = first.count > 0 && second.count > 0;
    const Near* near = both_move ? all_.find(std::min(a, b), std::max(a, b)) : &none;
    if (!near) {
      complete_ = false;
      return;
    }
    const Columns &ab = a < b ? near->ab : near->ba, &ba = a < b ? near->ba : near->ab;
    const std::array<Side, 2> sides = {Side{first, {&first.diagonal, &ab}, a},
                                       Side{second, {&ba, &second.diagonal}, b}};
    if (relation_)
      add_related(sides, r, K, C);
    else
      add_plain(sides, K, C);
  }

 private:
  /// One of the two nodes, and the blocks of its rows.
  struct Side {
    const Part& part;
    std::array<const Columns*, 2> blocks;
    int local;
  };

  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;  ///< on the stack

  template <class Matrix>
  void put(const Columns& columns, int row, int column, const Matrix& block) {
    for (int c = 0; c < block.cols(); ++c) {
      double* value = values_.data() + columns[static_cast<std::size_t>(column + c)] + row;
      for (int r = 0; r < block.rows(); ++r) value[r] += block(r, c);
    }
  }

  /// Adds a pair whose nodes are free or held in all directions. Columns of rotations of K are multiplied by the T of
  /// their node.
  void add_plain(const std::array<Side, 2>& sides, const Matrix12& K, const Matrix12& C) {
    const TangentWeights& weights = request_.weights;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const Side &row = sides[static_cast<std::size_t>(i / 2)], &column = sides[static_cast<std::size_t>(j / 2)];
        if (row.part.count == 0 || column.part.count == 0) continue;
        const Columns& places = *row.blocks[static_cast<std::size_t>(j / 2)];
        const int r = 3 * (i % 2), c = 3 * (j % 2);
        if (weights.stiffness != 0) {
          const Matrix3 block = K.block<3, 3>(3 * i, 3 * j);
          if (request_.turns && c > 0)
            put(places, r, c, Matrix3(weights.stiffness * (block * request_.turns[column.part.node]).eval()));
          else
            put(places, r, c, Matrix3(weights.stiffness * block));
        }
        if (weights.damping != 0) put(places, r, c, Matrix3(weights.damping * C.block<3, 3>(3 * i, 3 * j)));
      }
  }

  /// Does the same for nodes that are held in some directions or carried by others, see member_tangent.hpp.
  void add_related(const std::array<Side, 2>& sides, const Vector12& r, const Matrix12& K, const Matrix12& C) {
    const TangentWeights& weights = request_.weights;
    for (int j = 0; j < 2; ++j) {
      const Side& column = sides[static_cast<std::size_t>(j)];
      const NodeRelation& of_column = relation(column);
      Eigen::Matrix<double, 12, Eigen::Dynamic, 0, 12, 6> columns =
          weights.stiffness * K.middleCols<6>(6 * j) * of_column.displacement_step;
      columns += weights.damping * C.middleCols<6>(6 * j) * of_column.displacement;
      if (of_column.carried) columns += weights.stiffness * C.middleCols<6>(6 * j) * of_column.rate_of_displacement;
      for (int i = 0; i < 2; ++i) {
        const Side& row = sides[static_cast<std::size_t>(i)];
        const Block block = relation(row).displacement.transpose() * columns.middleRows<6>(6 * i);
        put(*row.blocks[static_cast<std::size_t>(j)], 0, 0, block);
      }
      if (of_column.carried) add_turning_of_arm(column, r.segment<3>(6 * j));
    }
  }

  /// Adds the term due to the rotation of the arm at which a force on a carried node acts on its carrier.
  void add_turning_of_arm(const Side& side, const Vector3& force) {
    const Carry* carry = all_.kinematics_.carry(side.part.node);
    const NodeFreedom& f = all_.kinematics_.freedom(carry->carrier);
    const Matrix3& R = state_.global().nodes[static_cast<std::size_t>(carry->carrier)].R;
    const Matrix3 turn = request_.weights.stiffness * (skew(carry->c) * skew(R.transpose() * force));
    const Matrix6X6 G = f.G.leftCols(f.count);
    const Matrix6X6 GT = times_step_tangent(G, f, request_.dq);
    const Block block = G.bottomRows<3>().transpose() * turn * GT.bottomRows<3>();
    put(side.part.diagonal, 0, 0, block);
  }

  const NodeRelation& relation(const Side& side) const { return (*relation_)[static_cast<std::size_t>(side.local)]; }

  const PairTangents& all_;
  const LocalState& state_;
  const TangentRequest& request_;
  const std::vector<NodeRelation>* relation_;
  std::vector<double>& values_;
  bool complete_ = true;
};

bool PairTangents::add(const LocalState& state, const TangentRequest& request, std::vector<double>& values) const {
  if (request.weights.stiffness == 0 && request.weights.damping == 0) return true;
  thread_local std::vector<NodeRelation> relation;
  if (!plain_) {
    relation.resize(std::max(relation.size(), parts_.size()));
    for (std::size_t k = 0; k < parts_.size(); ++k)
      relation[k] = relate(kinematics_, parts_[k].node, state.global(), request.dq);
  }
  Sum sum(*this, state, request, plain_ ? nullptr : &relation, values);
  component_.add_pair_tangents(state, sum);
  return sum.complete();
}

}  // namespace bielle::mechanism

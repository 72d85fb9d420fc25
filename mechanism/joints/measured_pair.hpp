// Joints whose constraints are scalar measures of their two nodes.
//
// A type computes its rows as numbers with derivatives (reduce/common/autodiff.hpp); residual, tangent and rates of the
// rows follow from them. Rows are holonomic, m = 0, or non-holonomic, w . v = 0: of those the gradient is w and the
// second derivatives are dw, and the value does not count.
#pragma once

#include <array>
#include <span>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

class MeasuredPair : public Joint {
 public:
  struct Row {
    const char* name;   ///< "x"
    const char* units;  ///< of its multiplier: "N" or "N m"
    ConstraintKind kind = ConstraintKind::holonomic;
  };
  /// @param rows  at most six
  MeasuredPair(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
               std::vector<Row> rows, const Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;

 protected:
  /// @param rows  as many as declared
  virtual void calc_rows(const LocalState& state, std::span<PairMeasure> rows) const = 0;

  // What rows are made of, besides positions.
  /// d . d, with d the way from the origin of J_A to that of J_B.
  PairMeasure squared_distance(const LocalState& state) const;
  /// Alignment of an axis of J_A with one of J_B.
  PairMeasure alignment(int first_axis, int second_axis, const LocalState& state) const;

 private:
  using Rows = std::array<PairMeasure, 6>;
  std::span<const PairMeasure> calc(const LocalState& state, Rows& rows) const;
  std::vector<Row> rows_;
};

}  // namespace bielle::mechanism

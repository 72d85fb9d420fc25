// Joints whose constraints are scalar measures of their two nodes.
//
// A type computes its rows as numbers with derivatives (reduce/common/autodiff.hpp); residual, tangent and rates of the
// rows follow from them. Types derive from MeasuredRows, and write their rows once for both orders of derivatives.
// Rows are holonomic, m = 0, or non-holonomic, w . v = 0: for the latter the gradient is w and the second derivatives
// are dw, and the value is not used.
#pragma once

#include <array>
#include <span>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

class MeasuredPair : public Joint {
 public:
  struct Row {
    const char* name;   ///< name: "x"
    const char* units;  ///< units of its multiplier: "N" or "N m"
    ConstraintKind kind = ConstraintKind::holonomic;
  };
  /// @param rows  at most six rows
  MeasuredPair(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
               std::vector<Row> rows, const Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;

 protected:
  /// @param rows  as many rows as declared
  virtual void calc_rows(const LocalState& state, std::span<PairMeasure> rows) const = 0;
  /// Computes the rows with gradients only, for residuals.
  virtual void calc_row_slopes(const LocalState& state, std::span<PairSlope> rows) const = 0;

  // Terms of rows, in addition to positions.
  /// The product d . d, with the vector d from the origin of J_A to that of J_B.
  template <int order = 2>
  PairMeasureOf<order> squared_distance(const LocalState& state) const {
    return square(position<order>(0, state)) + square(position<order>(1, state)) + square(position<order>(2, state));
  }
  /// Computes the alignment (scalar product) of an axis of J_A with an axis of J_B.
  template <int order = 2>
  PairMeasureOf<order> alignment(int first_axis, int second_axis, const LocalState& state) const {
    return measure_alignment<order>(state.node(0), state.node(1), frames().on_first.R.col(first_axis),
                                    frames().on_second.R.col(second_axis));
  }

 private:
  using Rows = std::array<PairMeasure, 6>;
  std::span<const PairMeasure> calc(const LocalState& state, Rows& memory) const;
  std::vector<Row> rows_;
};

/// Base of a type that writes its rows once, as a template:
///     template <int order> void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
template <class Type>
class MeasuredRows : public MeasuredPair {
 protected:
  using MeasuredPair::MeasuredPair;

 private:
  void calc_rows(const LocalState& state, std::span<PairMeasure> rows) const final {
    type().template rows<2>(state, rows);
  }
  void calc_row_slopes(const LocalState& state, std::span<PairSlope> rows) const final {
    type().template rows<1>(state, rows);
  }
  const Type& type() const { return static_cast<const Type&>(*this); }
};

}  // namespace bielle::mechanism

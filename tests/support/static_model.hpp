// A model from text at rest, solved by dense algebra: for tests of beams that compare shapes.
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/dense_solution.hpp"
#include "tests/support/model_text.hpp"

namespace bielle::test {

/// Nodes `fixed: true` (and `ground`) are held; the others and amplitudes are free, except for directions given to
/// `hold`.
struct StaticModel {
  std::unique_ptr<Model> model;
  DenseModel dense;
  State state;
  std::vector<int> free;

  explicit StaticModel(const std::string& yaml) : model(model_from_text(yaml)), dense(*model), state(dense.start()) {
    for (int k = 0; k < dense.nodes(); ++k)
      for (int d = 0; d < 6; ++d)
        if (model->node(k).freedom[static_cast<std::size_t>(d)] == mechanism::Freedom::free) free.push_back(6 * k + d);
    for (int k = dense.amplitude_begin(); k < dense.first_order_begin(); ++k) free.push_back(k);
  }
  const mechanism::NodeState& node(const std::string& name) const {
    return state.nodes[static_cast<std::size_t>(*model->find_node(name))];
  }
  /// Keeps only the given directions of each node (0..5: dx dy dz, rotations about the node's axes).
  void keep_directions(const std::vector<int>& directions) {
    const auto other = [&](int i) {
      return std::find(directions.begin(), directions.end(), i % 6) == directions.end();
    };
    free.erase(std::remove_if(free.begin(), free.end(), other), free.end());
  }
  int unknown(const std::string& name, int direction) const { return 6 * *model->find_node(name) + direction; }
  void hold(const std::string& name, int direction) { std::erase(free, unknown(name, direction)); }
  mechanism::MatrixX stiffness() const { return dense.tangent(state, DenseModel::Part::K)(free, free); }

  /// Returns the sign of the determinant of the stiffness, which changes at a critical load.
  int stiffness_sign() const {
    LUFactors factors;
    factors.compute(stiffness());
    return factors.sign();
  }

  /// Returns the first load factor above `low` at which the stiffness becomes singular: upwards in steps until the sign
  /// of its determinant changes, then by bisection. The state follows.
  double critical_load(double low, double step, double tolerance, double width) {
    const auto sign_at = [&](double factor) {
      if (load(1, tolerance, factor) < 0) throw std::runtime_error("no equilibrium on the way to a critical load");
      return stiffness_sign();
    };
    const int sign = sign_at(low);
    double high = low + step;
    for (int k = 0; sign_at(high) == sign; ++k) {
      if (k == 100) throw std::runtime_error("no critical load found");
      low = high;
      high += step;
    }
    while (high - low > width) {
      const double middle = 0.5 * (low + high);
      (sign_at(middle) == sign ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// Controls a displacement: moves a node's coordinate (0..2) to a value in equal steps; the load factor is an
  /// unknown. It passes limit points of the load. @returns the load factor @throws std::runtime_error without
  /// convergence
  double control(const std::string& name, int coordinate, double value, int steps, double tolerance) {
    const auto row = std::find(free.begin(), free.end(), unknown(name, coordinate)) - free.begin();
    const Eigen::Index n = static_cast<Eigen::Index>(free.size());
    const double from = node(name).x[coordinate];
    for (int k = 1; k <= steps; ++k) {
      const double target = from + (value - from) * k / steps;
      for (int iteration = 0;; ++iteration) {
        if (iteration == 40) throw std::runtime_error("no equilibrium at a prescribed displacement");
        const mechanism::VectorX r = dense.residual(state)(free);
        const double gap = target - node(name).x[coordinate];
        if (iteration > 0 && r.cwiseAbs().maxCoeff() < tolerance && std::abs(gap) < 1e-12 * (1 + std::abs(target)))
          break;
        dense.environment.load_factor += 1;
        mechanism::MatrixX bordered = mechanism::MatrixX::Zero(n + 1, n + 1);
        bordered.col(n).head(n) = dense.residual(state)(free) - r;  // loads are linear in their factor
        dense.environment.load_factor -= 1;
        bordered.topLeftCorner(n, n) = stiffness();
        bordered(n, row) = 1;
        mechanism::VectorX right(n + 1), all = mechanism::VectorX::Zero(dense.size());
        right << -r, gap;
        const mechanism::VectorX step = solution(bordered, right);
        all(free) = step.head(n);
        dense.move(state, all);
        dense.environment.load_factor += step[n];
      }
    }
    return dense.environment.load_factor;
  }

  /// Moves to a load factor in equal steps from the present one; a step that does not converge is halved.
  /// @returns the largest number of iterations of a step; -1: no convergence
  int load(int steps, double tolerance, double factor = 1, double from = 0) {
    int most = 0;
    for (int k = 1; k <= steps; ++k) {
      const double begin = from + (factor - from) * (k - 1) / steps, end = from + (factor - from) * k / steps;
      const int iterations = raise(begin, end, tolerance, 8);
      if (iterations < 0) return -1;
      most = std::max(most, iterations);
    }
    return most;
  }

 private:
  int raise(double from, double to, double tolerance, int halvings) {
    const mechanism::State before = state;
    dense.environment.load_factor = to;
    int iterations = -1;
    try {
      iterations = solve_static(dense, state, free, tolerance);
    } catch (const ComputationError&) {
      // An element refuses an iterate that is far off.
    }
    if (iterations >= 0) return iterations;
    state = before;
    if (halvings == 0) return -1;
    const int first = raise(from, 0.5 * (from + to), tolerance, halvings - 1);
    return first < 0 ? -1 : raise(0.5 * (from + to), to, tolerance, halvings - 1);
  }
};

}  // namespace bielle::test

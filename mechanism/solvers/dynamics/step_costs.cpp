#include "mechanism/solvers/dynamics/step_costs.hpp"

namespace bielle::mechanism {
namespace {

// Nanoseconds, from chains of rigid links, beams and superelements of 10 to 500 parts and from the examples
// (mechanism/solvers/README.md). For one member a constant may be wrong by half; the ratio of a factorisation with its
// tangent to an iteration is then right to about a third, which changes the cost of a step by a few per cent.
constexpr double residual_per_block_row = 5, tangent_per_block_row = 11;
constexpr double residual_per_dense_entry = 4, tangent_per_dense_entry = 20;
constexpr double residual_per_equation = 4, tangent_per_entry = 1.5;
constexpr double factor_per_operation = 0.35, factor_per_entry = 1.3;
constexpr double factor_per_dense_operation = 0.15, factor_per_dense_entry = 1.5;
constexpr double solution_per_equation = 3, solution_per_entry = 0.85, solution_per_dense_entry = 0.5;

}  // namespace

StepCosts count_costs(const System& system, int equations, int tangents, const FactorCost& factors) {
  const EvaluationSize& size = system.evaluation_size();
  // Entries of bodies that are near to each other are not counted: they depend on earlier states.
  const double lasting = system.pattern().entry_count() - static_cast<double>(system.pattern().intermittent().size());
  const double tangent = tangent_per_block_row * size.block_rows + tangent_per_dense_entry * size.dense_entries +
                         tangent_per_entry * lasting;
  StepCosts costs;
  costs.evaluation = residual_per_block_row * size.block_rows + residual_per_dense_entry * size.dense_entries +
                     residual_per_equation * equations;
  costs.factorisation = tangents * tangent + factor_per_operation * factors.operations +
                        factor_per_entry * factors.entries + factor_per_dense_operation * factors.dense_operations +
                        factor_per_dense_entry * factors.dense_entries;
  costs.solution = solution_per_equation * equations + solution_per_entry * factors.entries +
                   solution_per_dense_entry * factors.dense_entries;
  return costs;
}

}  // namespace bielle::mechanism

#include "reduce/matrices/held_modes.hpp"

#include <algorithm>

#include "reduce/dense/dense_products.hpp"
#include "reduce/matrices/set_mass.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

Unknowns held_unknowns(const MatrixSet& set) {
  std::vector<int> components(set.numbers.size(), 0);
  for (const NodalUnknown& u : set.unknowns)
    if (!u.is_scalar()) ++components[static_cast<std::size_t>(u.node)];
  std::vector<bool> held(set.numbers.size(), false);
  for (const auto& [name, node] : set.interfaces) held[static_cast<std::size_t>(node)] = true;
  if (set.interfaces.empty())
    std::transform(components.begin(), components.end(), held.begin(), [](int count) { return count == 6; });
  Unknowns result;
  for (Eigen::Index k = 0; k < set.size(); ++k)
    if (const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
        !u.is_scalar() && held[static_cast<std::size_t>(u.node)])
      result.push_back(k);
  return result;
}

std::optional<HeldModes> held_modes(const MatrixStudy& study, int count) {
  HeldModes result;
  result.held = held_unknowns(study.set);
  for (Eigen::Index k = 0; k < study.size(); ++k)
    if (!std::binary_search(result.held.begin(), result.held.end(), k)) result.free.push_back(k);
  const SparseColumns mass = submatrix(study.mass, result.free, result.free);
  const auto with_mass = static_cast<int>((Eigen::VectorXd(mass.diagonal()).array() > 0).count());
  if (result.held.empty() || with_mass == 0) return std::nullopt;
  const SparseColumns stiffness = submatrix(study.stiffness, result.free, result.free);
  result.modes = natural_modes(stiffness, mass, std::min(count, with_mass), 0, study.threads);
  if (!study.geometric) return result;
  Unknowns all(static_cast<std::size_t>(study.size()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Eigen::Index>(i);
  // The static answer of the free unknowns to rigid motions of the held ones is the rigid motion itself.
  Eigen::MatrixXd rigid = *study.geometric;
  rigid.rightCols(3) -=
      rigid.leftCols(3) * skew(study.middle - mass_of(study).centre);  // turns about the centre of mass
  const Eigen::MatrixXd momenta = submatrix(study.mass, result.free, all) * rigid;
  result.effective_mass = transposed_product(result.modes.vectors, momenta).cwiseAbs2();
  result.whole_mass = rigid.cwiseProduct(study.mass * rigid).colwise().sum();
  return result;
}

}  // namespace bielle::reduce

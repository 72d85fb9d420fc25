#include "reduce/superelement/superelement_sum.hpp"

#include "reduce/common/files/checksum.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle {

namespace {

/// Adds the columns one after the other, with the shape.
template <class Matrix>
void add(Checksum& sum, const Matrix& matrix) {
  sum.add(static_cast<double>(matrix.rows()));
  sum.add(static_cast<double>(matrix.cols()));
  sum.add({matrix.data(), static_cast<std::size_t>(matrix.size())});
}

template <class Matrices>
void add_all(Checksum& sum, const Matrices& matrices) {
  for (const auto& matrix : matrices) add(sum, matrix);
}

void add_numbers(Checksum& sum, const std::vector<int>& numbers) {
  for (const int number : numbers) sum.add(static_cast<double>(number));
}

void add_adequacy(Checksum& sum, const Adequacy& adequacy) {
  for (const Eigen::VectorXd* numbers :
       {&adequacy.frequencies, &adequacy.mode_error, &adequacy.mesh_error, &adequacy.tie_error, &adequacy.stress_error})
    add(sum, *numbers);
  add(sum, adequacy.worst_place);
  add(sum, adequacy.inertia_answer);
  for (const double number : {adequacy.next_mode, adequacy.wanted, static_cast<double>(adequacy.order),
                              adequacy.one_element_thick, adequacy.least_jacobian})
    sum.add(number);
  for (const std::string& name : adequacy.rigid_ties) sum.add(name);
}

}  // namespace

std::int64_t sum_of(const Superelement& body) {
  Checksum sum;
  for (const Interface& interface : body.interfaces) {
    sum.add(interface.name);
    add(sum, interface.position);
    add(sum, interface.rotation);
    for (const bool kept : interface.kept) sum.add(kept ? 1.0 : 0.0);
  }
  for (const Eigen::MatrixXd* matrix : {&body.stiffness, &body.mass, &body.damping, &body.effective_mass,
                                        &body.displacement_recovery, &body.stress_recovery})
    add(sum, *matrix);
  add(sum, body.frequencies);
  add_all(sum, body.inertia_components);
  add_all(sum, body.spin_stiffness);
  add_all(sum, body.load_stiffness);
  add_all(sum, body.surface_rotations);
  sum.add(body.total_mass);
  add(sum, body.centre);
  add(sum, body.inertia);
  for (const auto& [name, pattern] : body.loads) {
    sum.add(name);
    add_all(sum, pattern.force);
  }
  add(sum, body.mesh.points);
  for (const auto& [type, cells] : body.mesh.cells)
    for (const int node : cells.reshaped()) sum.add(static_cast<double>(node));
  for (const auto& [name, nodes] : body.mesh.groups) {
    sum.add(name);
    add_numbers(sum, nodes);
  }
  add_numbers(sum, body.stress_nodes);
  for (const StressMaterial& material : body.stress_origin.materials) add(sum, material.elasticity);
  add_numbers(sum, body.stress_origin.material_of);
  // These parts are added only if they exist, so that the sum of files without them does not change.
  for (const auto& [name, point] : body.points) {
    sum.add(name);
    add(sum, point.position);
    add(sum, point.shapes);
    for (const bool exact : point.residual) sum.add(exact ? 1.0 : 0.0);
  }
  for (const Eigen::MatrixXd* matrix :
       {&body.mode_turns, &body.strains, &body.inertia_answer.whole, &body.inertia_answer.missing})
    if (matrix->size() > 0) add(sum, *matrix);
  for (const auto& [name, quantity] : body.quantities) {
    sum.add(name);
    for (std::size_t row = 0; row < quantity.rows.size(); ++row) {
      sum.add(quantity.rows[row]);
      sum.add(quantity.units[row]);
    }
    add(sum, quantity.matrix);
  }
  if (body.residual_vectors > 0) sum.add(static_cast<double>(body.residual_vectors));
  if (body.adequacy) add_adequacy(sum, *body.adequacy);
  return sum.value();
}

}  // namespace bielle

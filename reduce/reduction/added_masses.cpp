#include "reduce/reduction/added_masses.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/fe/weighted_nodes.hpp"
#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/reduction/ties.hpp"
#include "reduce/superelement/point_weights.hpp"

namespace bielle::reduce {

namespace {

constexpr double most_ratio = 1e6;  // added mass over own: the checks of mass properties have a tolerance of 1e-10

/// Returns the nodes around a place, with the weights that a named point there gives them.
SurfaceIntegrals around(const Solid& solid, const Eigen::Vector3d& place, const std::string& body) {
  const std::vector<int> inside = nodes_of_solid(solid);
  const PointWeights weights = point_weights(solid.mesh.points(Eigen::all, inside), place, body);
  std::map<int, double> weight_of;
  for (std::size_t k = 0; k < weights.nodes.size(); ++k)
    weight_of[inside[static_cast<std::size_t>(weights.nodes[k])]] = weights.weights[static_cast<Eigen::Index>(k)];
  std::vector<int> nodes;
  Eigen::VectorXd sorted(weights.weights.size());
  for (const auto& [node, weight] : weight_of) {
    sorted[static_cast<Eigen::Index>(nodes.size())] = weight;
    nodes.push_back(node);
  }
  return sum_over_nodes(solid.mesh, std::move(nodes), sorted);
}

AddedMass put_on(const Solid& solid, const MassRequest& request, const std::string& body) {
  AddedMass result;
  result.surface = request.place ? around(solid, *request.place, body) : integrate_tied(solid.mesh, request.group);
  const std::optional<Eigen::Vector3d> position = request.position ? request.position : request.place;
  check_position(position, result.surface, solid.mesh, request.place ? "its place" : "its surface");
  Interface centre;
  centre.position = position.value_or(result.surface.centroid);
  result.loads = spread_unit_loads(result.surface, centre);
  result.name = request.name;
  result.mass = request.mass;
  result.position = centre.position;
  result.inertia = request.inertia;
  return result;
}

/// @param mass  mass of the body alone [kg] @param size  its diagonal [m]
/// @throws InputError for a mass or an inertia compared with which those of the body are lost in rounding, which is
/// probably a wrong unit
void check_size(const MassRequest& request, double mass, double size) {
  if (request.mass > most_ratio * mass)
    throw InputError(
        fmt::format("its mass of {:.3g} kg is more than a million times that of the body, {:.3g} kg, which "
                    "is lost in rounding compared with it; masses are in kilograms",
                    request.mass, mass));
  if (const double inertia = request.inertia.trace() / 2; inertia > most_ratio * mass * size * size)
    throw InputError(
        fmt::format("its inertia of {:.3g} kg m^2 is more than a million times that of the body, which is "
                    "lost in rounding compared with it; inertia is in kg m^2",
                    inertia));
}

/// Returns L with L L^T = J; moments that rounding makes negative count as zero.
Eigen::Matrix3d root(const Eigen::Matrix3d& inertia) {
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(inertia);
  return pairs.vectors * pairs.values.cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace

Eigen::Matrix3d AddedMass::second_moment() const { return inertia.trace() / 2 * Eigen::Matrix3d::Identity() - inertia; }

Eigen::Matrix<double, 6, 6> AddedMass::matrix() const {
  Eigen::Matrix<double, 6, 6> result = Eigen::Matrix<double, 6, 6>::Zero();
  result.topLeftCorner<3, 3>().diagonal().setConstant(mass);
  result.bottomRightCorner<3, 3>() = inertia;
  return result;
}

Eigen::MatrixXd AddedMass::motion(const RowMatrix& u) const {
  Eigen::MatrixXd rows(loads.rows(), u.cols());
  for (std::size_t a = 0; a < surface.nodes.size(); ++a)
    rows.middleRows<3>(3 * static_cast<Eigen::Index>(a)) = u.middleRows<3>(3 * surface.nodes[a]);
  return transposed_product(loads, rows);
}

void AddedMass::add_forces(const Eigen::MatrixXd& f, RowMatrix& forces) const {
  const Eigen::MatrixXd rows = product(loads, f);
  for (std::size_t a = 0; a < surface.nodes.size(); ++a)
    forces.middleRows<3>(3 * surface.nodes[a]) += rows.middleRows<3>(3 * static_cast<Eigen::Index>(a));
}

AddedMasses::AddedMasses(const Solid& solid, const std::vector<MassRequest>& requests, const std::string& body) {
  if (requests.empty()) return;
  const double mass = mass_properties(solid).mass;
  const double size = (solid.mesh.points.rowwise().maxCoeff() - solid.mesh.points.rowwise().minCoeff()).norm();
  std::set<std::string> names;
  for (const MassRequest& request : requests)
    about(request.subject, [&] {
      if (!names.insert(request.name).second) throw InputError(fmt::format("there are two masses '{}'", request.name));
      check_size(request, mass, size);
      masses_.push_back(put_on(solid, request, body));
    });
}

void AddedMasses::add_inertia(const RowMatrix& u, RowMatrix& products) const {
  for (const AddedMass& mass : masses_) mass.add_forces(mass.matrix() * mass.motion(u), products);
}

void AddedMasses::add_linear_inertia(const Eigen::Vector3d& centre, RowMatrix& inertia) const {
  for (const AddedMass& mass : masses_) {
    const Eigen::Matrix3d second = mass.second_moment();
    const Eigen::Vector3d arm = mass.position - centre;
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(6, LinearFields::count);
    for (int i = 0; i < 3; ++i) {
      loads(i, 4 * i) = mass.mass;
      for (int j = 0; j < 3; ++j) {
        loads(i, 4 * i + 1 + j) = mass.mass * arm(j);
        loads.col(4 * i + 1 + j).tail<3>() = skew(second.col(j)).col(i);  // int xi x e_i xi_j dm
      }
    }
    mass.add_forces(loads, inertia);
  }
}

void AddedMasses::add_inertia_components(const RowMatrix& shapes, std::array<Eigen::MatrixXd, 6>& components) const {
  for (const AddedMass& mass : masses_) {
    const Eigen::MatrixXd motion = mass.motion(shapes);
    const Eigen::Matrix3d second = mass.second_moment();
    std::array<Eigen::MatrixXd, 3> turned;  // rows: the displacement of direction k per unit of xi
    for (int k = 0; k < 3; ++k)
      turned[static_cast<std::size_t>(k)] = skew(Eigen::Vector3d::Unit(k)) * motion.bottomRows<3>();
    for (std::size_t s = 0; s < voigt_pairs.size(); ++s) {
      const auto [k, l] = voigt_pairs[s];
      const Eigen::MatrixXd along_l = second * turned[static_cast<std::size_t>(l)];
      components[s] += mass.mass * motion.row(k).transpose() * motion.row(l);
      components[s] += transposed_product(turned[static_cast<std::size_t>(k)], along_l);
      if (k == l) components[s] = Eigen::MatrixXd(components[s] + components[s].transpose()) / 2;
    }
  }
}

Eigen::MatrixXd AddedMasses::root_of_inertia(const std::vector<std::int64_t>& unknowns) const {
  const auto rows = static_cast<Eigen::Index>(unknowns.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, 6 * static_cast<Eigen::Index>(masses_.size()));
  for (std::size_t k = 0; k < masses_.size(); ++k) {
    const AddedMass& mass = masses_[k];
    Eigen::Matrix<double, 6, 6> factor = Eigen::Matrix<double, 6, 6>::Zero();
    factor.topLeftCorner<3, 3>().diagonal().setConstant(std::sqrt(mass.mass));
    factor.bottomRightCorner<3, 3>() = root(mass.inertia);
    const Eigen::MatrixXd columns = mass.loads * factor;
    for (std::size_t a = 0; a < mass.surface.nodes.size(); ++a)
      for (int i = 0; i < 3; ++i) {
        const std::int64_t unknown = 3 * static_cast<std::int64_t>(mass.surface.nodes[a]) + i;
        const auto place = std::lower_bound(unknowns.begin(), unknowns.end(), unknown);
        if (place == unknowns.end() || *place != unknown) continue;
        result.block<1, 6>(place - unknowns.begin(), 6 * static_cast<Eigen::Index>(k)) =
            columns.row(3 * static_cast<Eigen::Index>(a) + i);
      }
  }
  return result;
}

MassProperties with_masses(const MassProperties& body, const AddedMasses& masses) {
  MassProperties sum = body;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  // about the centre of the body alone
  for (const AddedMass& mass : masses) {
    sum.mass += mass.mass;
    first += mass.mass * (mass.position - body.centre);
  }
  sum.centre = body.centre + first / sum.mass;
  const auto moved = [&](double mass, const Eigen::Vector3d& centre) {
    const Eigen::Matrix3d arm = skew(Eigen::Vector3d(centre - sum.centre));
    return Eigen::Matrix3d(-mass * arm * arm);
  };
  sum.inertia += moved(body.mass, body.centre);
  for (const AddedMass& mass : masses) sum.inertia += mass.inertia + moved(mass.mass, mass.position);
  return sum;
}

Solid requested_solid(const Mesh& mesh, const ReductionOptions& options) {
  Solid solid = about(
      "regions", [&] { return make_solid(mesh, options.materials, options.regions, options.integration); },
      Subject::hidden);
  solid.lumped = options.lumped;
  if (options.coatings.empty()) return solid;
  const double mass = mass_properties(solid).mass;
  for (const CoatingRequest& request : options.coatings) {
    solid.coatings.push_back(
        {about(request.subject, [&] { return surface_group(mesh, request.group); }), request.mass_per_area});
    const double added = request.mass_per_area * integrate_surface(mesh, request.group).area;
    if (added > most_ratio * mass)
      throw InputError(request.subject,
                       fmt::format("its mass of {:.3g} kg is more than a million times that of the body, {:.3g} kg, "
                                   "which is lost in rounding compared with it; `per_area` is in kg/m^2",
                                   added, mass));
  }
  return solid;
}

}  // namespace bielle::reduce

#include "reduce/reduction/ties.hpp"

#include <algorithm>
#include <set>

#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/fe/weighted_nodes.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseRows sparse(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  SparseRows result(rows, columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

void add_column(Triplets& entries, int node, std::size_t column, const Eigen::Vector3d& values) {
  for (int i = 0; i < 3; ++i) {
    if (values(i) != 0) {
      entries.emplace_back(3 * node + i, static_cast<int>(column), values(i));
    }
  }
}

std::string place(const Eigen::Vector3d& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z()); }

/// Returns the displacement of a point at `x` for a unit motion in direction `axis` of the interface.
Eigen::Vector3d carried(const Interface& interface, int axis, const Eigen::Vector3d& x) {
  const Eigen::Vector3d direction = interface.rotation.col(axis % 3);
  return axis < 3 ? direction : Eigen::Vector3d(skew(direction) * (x - interface.position));
}

/// Claims the points of an interface; refuses points that are in no solid cell or belong to an earlier interface.
class Claims {
 public:
  explicit Claims(const Solid& solid) : solid_(solid), inside_(points_of_solid(solid)), owner_(solid.points(), -1) {}

  void claim(const std::vector<int>& nodes, int request, const std::vector<InterfaceRequest>& requests) {
    int shared = 0, first = -1, with = -1;
    for (const int node : nodes) {
      if (!inside_[node]) {
        throw InputError(requests[request].subject,
                         fmt::format("point {} of surface '{}' at {} is no point of the solid", node,
                                     requests[request].group, place(solid_.mesh.points.col(node))));
      }
      if (owner_[node] >= 0) {
        with = owner_[node];
        first = shared++ == 0 ? node : first;
      } else {
        owner_[node] = request;
      }
    }
    if (shared > 0) {
      throw InputError(
          requests[request].subject,
          fmt::format(
              "surface '{}' shares {} with interface '{}', the first at {}; interfaces must not touch, leave a row "
              "of elements between them",
              requests[request].group, counted(shared, "point"), requests[with].name,
              place(solid_.mesh.points.col(first))));
    }
  }

 private:
  const Solid& solid_;
  std::vector<bool> inside_;
  std::vector<int> owner_;
};

/// Gathers the ties of all interfaces, one request after the other.
class TieBuilder {
 public:
  explicit TieBuilder(const Solid& solid) : solid_(solid) { ties_.tied.assign(solid.points(), false); }

  /// @param surface  surface of the request
  void add(const InterfaceRequest& request, const SurfaceIntegrals& surface) {
    std::array<bool, 6> directions = request.kept;
    if (request.tie == Tie::free) {
      std::fill(directions.begin() + 3, directions.end(), false);
    }
    if (std::none_of(directions.begin(), directions.end(), [](bool keep) { return keep; })) {
      throw InputError(request.subject, "no direction of the interface is kept");
    }
    if (request.tie != Tie::free) {
      add_interface(request, {request.name, request.position.value_or(surface.centroid), request.rotation, directions},
                    surface, surface.nodes);
      return;
    }
    for (const int node : surface.nodes) {
      add_interface(
          request,
          {fmt::format("{}_{}", request.name, node), solid_.mesh.points.col(node), request.rotation, directions},
          surface, {node});
    }
  }

  Ties build() {
    const Eigen::Index rows = 3 * solid_.points();
    ties_.carry_kept = sparse(rows, static_cast<Eigen::Index>(ties_.kept.size()), kept_);
    ties_.carry_released = sparse(rows, static_cast<Eigen::Index>(ties_.released.size()), released_);
    ties_.spread = sparse(rows, static_cast<Eigen::Index>(ties_.averages.size()), spread_);
    return std::move(ties_);
  }

 private:
  void add_interface(const InterfaceRequest& request, Interface interface, const SurfaceIntegrals& surface,
                     std::vector<int> nodes) {
    if (!names_.insert(interface.name).second) {
      throw InputError(request.subject, fmt::format("there are two interfaces '{}'", interface.name));
    }
    const int number = static_cast<int>(ties_.interfaces.size());
    for (int axis = 0; axis < (request.tie == Tie::free ? 3 : 6); ++axis) {
      const bool is_kept = interface.kept[axis];
      if (request.tie != Tie::average) {
        carry(interface, axis, nodes);
      } else if (is_kept) {
        spread_over(nodes, spread_unit_load(surface, interface, axis));
      }
      if (is_kept) {
        ties_.kept.push_back({number, axis});
      } else if (request.tie != Tie::average) {
        ties_.released.push_back({number, axis});
      }
    }
    ties_.interfaces.push_back(std::move(interface));
    ties_.surfaces.push_back(
        {request.tie, std::move(nodes), request.tie == Tie::free ? SurfaceIntegrals{} : surface, request.subject});
  }

  /// Makes the nodes move with a direction of the interface, which is kept or released.
  void carry(const Interface& interface, int axis, const std::vector<int>& nodes) {
    const bool is_kept = interface.kept[axis];
    for (const int node : nodes) {
      add_column(is_kept ? kept_ : released_, node, is_kept ? ties_.kept.size() : ties_.released.size(),
                 carried(interface, axis, solid_.mesh.points.col(node)));
      ties_.tied[node] = true;
    }
  }

  /// @param load  load of each node, for the next kept direction
  void spread_over(const std::vector<int>& nodes, const Eigen::Matrix3Xd& load) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      add_column(spread_, nodes[k], ties_.averages.size(), load.col(static_cast<Eigen::Index>(k)));
    }
    ties_.averages.push_back(static_cast<int>(ties_.kept.size()));
  }

  const Solid& solid_;
  Ties ties_;
  std::set<std::string> names_;
  Triplets kept_, released_, spread_;
};

}  // namespace

Eigen::Matrix3d polar_moment(const SurfaceIntegrals& surface) {
  return surface.second_moment.trace() * Eigen::Matrix3d::Identity() - surface.second_moment;
}

Eigen::Matrix3Xd spread_unit_load(const SurfaceIntegrals& surface, const Interface& interface, int axis) {
  // Force F on X acts as F on the centroid and the moment (X - X_c) x F; a moment is distributed as J^-1 M x r.
  const Eigen::Vector3d direction = interface.rotation.col(axis % 3);
  const Eigen::Vector3d force = axis < 3 ? direction : Eigen::Vector3d::Zero();
  const Eigen::Vector3d moment =
      axis < 3 ? Eigen::Vector3d(skew(interface.position - surface.centroid) * direction) : direction;
  return force / surface.area * surface.weights.transpose() +
         skew(polar_moment(surface).inverse() * moment) * surface.first_moments;
}

Eigen::MatrixXd spread_unit_loads(const SurfaceIntegrals& surface, const Interface& interface) {
  Eigen::MatrixXd loads(3 * static_cast<Eigen::Index>(surface.nodes.size()), 6);
  for (int axis = 0; axis < 6; ++axis) loads.col(axis) = spread_unit_load(surface, interface, axis).reshaped();
  return loads;
}

void check_position(const std::optional<Eigen::Vector3d>& position, const SurfaceIntegrals& surface, const Mesh& mesh,
                    const char* from) {
  const double size = (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  const double arm = position ? (*position - surface.centroid).norm() : 0;
  if (arm > 100 * size) {
    throw InputError(
        fmt::format("its position is {:.3g} m from {}, which is more than a hundred times the body's size of {:.3g} m; "
                    "positions are in metres",
                    arm, from, size));
  }
}

Ties make_ties(const Solid& solid, const std::vector<InterfaceRequest>& requests) {
  if (requests.empty()) {
    throw InputError(
        "interfaces: there is none, and a mechanism moves a body by its interfaces; one with 'tie: average' on any "
        "surface leaves the body free");
  }
  TieBuilder ties(solid);
  Claims claims(solid);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    const InterfaceRequest& request = requests[k];
    const SurfaceIntegrals surface = about(request.subject, [&] {
      SurfaceIntegrals integrals = integrate_tied(solid.mesh, request.group);
      check_position(request.position, integrals, solid.mesh);
      return integrals;
    });
    claims.claim(surface.nodes, static_cast<int>(k), requests);
    ties.add(request, surface);
  }
  return ties.build();
}

}  // namespace bielle::reduce

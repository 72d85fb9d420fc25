#include "reduce/reduction/ties.hpp"

#include <algorithm>
#include <set>

#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
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

/// Motion of a point at `x` by direction `axis` of the interface.
Eigen::Vector3d carried(const Interface& interface, int axis, const Eigen::Vector3d& x) {
  const Eigen::Vector3d direction = interface.rotation.col(axis % 3);
  return axis < 3 ? direction : Eigen::Vector3d(skew(direction) * (x - interface.position));
}

/// Refuses points that are in no solid cell or belong to an earlier interface, and claims the others.
class Claims {
 public:
  explicit Claims(const Solid& solid) : solid_(solid), inside_(points_of_solid(solid)), owner_(solid.points(), -1) {}

  void claim(const std::vector<int>& nodes, int request, const std::vector<InterfaceRequest>& requests) {
    int shared = 0, first = -1, with = -1;
    for (const int node : nodes) {
      if (!inside_[node]) {
        throw InputError(fmt::format("{}: point {} of surface '{}' at {} is no point of the solid",
                                     requests[request].located, node, requests[request].group,
                                     place(solid_.mesh.points.col(node))));
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
          fmt::format("{}: surface '{}' shares {} point{} with interface '{}', the first at {}; interfaces must not "
                      "touch, leave a row "
                      "of elements between them",
                      requests[request].located, requests[request].group, shared, shared == 1 ? "" : "s",
                      requests[with].name, place(solid_.mesh.points.col(first))));
    }
  }

 private:
  const Solid& solid_;
  std::vector<bool> inside_;
  std::vector<int> owner_;
};

/// An arm of a hundred times the body makes its matrices worthless, and is a slip in the unit.
void check_position(const InterfaceRequest& request, const SurfaceIntegrals& surface, const Mesh& mesh) {
  const double size = (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  const double arm = request.position ? (*request.position - surface.centroid).norm() : 0;
  if (arm > 100 * size) {
    throw InputError(
        fmt::format("{}: its position is {:.3g} m from its surface, which is more than a hundred times the body's size "
                    "of {:.3g} m; "
                    "positions are in metres",
                    request.located, arm, size));
  }
}

/// C^T of an average tie for one direction of the interface: the force that each node of the surface gets from a unit
/// load. Force F on X acts as F on the centroid and the moment (X - X_c) x F; a moment is spread as J^-1 M x r.
Eigen::Matrix3Xd spread_unit_load(const SurfaceIntegrals& surface, const Interface& interface, int axis) {
  const Eigen::Vector3d direction = interface.rotation.col(axis % 3);
  const Eigen::Vector3d force = axis < 3 ? direction : Eigen::Vector3d::Zero();
  const Eigen::Vector3d moment =
      axis < 3 ? Eigen::Vector3d(skew(interface.position - surface.centroid) * direction) : direction;
  return force / surface.area * surface.weights.transpose() +
         skew(polar_moment(surface).inverse() * moment) * surface.first_moments;
}

}  // namespace

Eigen::Matrix3d polar_moment(const SurfaceIntegrals& surface) {
  return surface.second_moment.trace() * Eigen::Matrix3d::Identity() - surface.second_moment;
}

Ties make_ties(const Solid& solid, const std::vector<InterfaceRequest>& requests) {
  if (requests.empty()) {
    throw InputError(
        "interfaces: there is none, and a mechanism moves a body by its interfaces; one with 'tie: average' on any "
        "surface "
        "leaves the body free");
  }
  Ties ties;
  ties.tied.assign(solid.points(), false);
  Claims claims(solid);
  std::set<std::string> names;
  Triplets kept, released, spread;
  const auto add_interface = [&](const InterfaceRequest& request, Interface interface, const SurfaceIntegrals& surface,
                                 std::vector<int> nodes) {
    if (!names.insert(interface.name).second) {
      throw InputError(fmt::format("{}: there are two interfaces '{}'", request.located, interface.name));
    }
    const int number = static_cast<int>(ties.interfaces.size());
    for (int axis = 0; axis < (request.tie == Tie::free ? 3 : 6); ++axis) {
      const bool is_kept = interface.kept[axis];
      if (request.tie == Tie::average) {
        if (is_kept) {
          const Eigen::Matrix3Xd load = spread_unit_load(surface, interface, axis);
          for (std::size_t k = 0; k < nodes.size(); ++k) {
            add_column(spread, nodes[k], ties.averages.size(), load.col(static_cast<Eigen::Index>(k)));
          }
          ties.averages.push_back(static_cast<int>(ties.kept.size()));
        }
      } else {
        for (const int node : nodes) {
          add_column(is_kept ? kept : released, node, is_kept ? ties.kept.size() : ties.released.size(),
                     carried(interface, axis, solid.mesh.points.col(node)));
          ties.tied[node] = true;
        }
      }
      if (is_kept) {
        ties.kept.push_back({number, axis});
      } else if (request.tie != Tie::average) {
        ties.released.push_back({number, axis});
      }
    }
    ties.interfaces.push_back(std::move(interface));
    ties.surfaces.push_back(
        {request.tie, std::move(nodes), request.tie == Tie::free ? SurfaceIntegrals{} : surface, request.located});
  };

  for (std::size_t k = 0; k < requests.size(); ++k) {
    const InterfaceRequest& request = requests[k];
    SurfaceIntegrals surface;
    try {
      surface = integrate_surface(solid.mesh, request.group);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", request.located, error.what()));
    }
    check_position(request, surface, solid.mesh);
    claims.claim(surface.nodes, static_cast<int>(k), requests);
    std::array<bool, 6> directions = request.kept;
    if (request.tie == Tie::free) {
      std::fill(directions.begin() + 3, directions.end(), false);
    }
    if (std::none_of(directions.begin(), directions.end(), [](bool keep) { return keep; })) {
      throw InputError(fmt::format("{}: no direction of the interface is kept", request.located));
    }
    if (request.tie == Tie::free) {
      for (const int node : surface.nodes) {
        add_interface(
            request,
            {fmt::format("{}_{}", request.name, node), solid.mesh.points.col(node), request.rotation, directions},
            surface, {node});
      }
    } else {
      add_interface(request, {request.name, request.position.value_or(surface.centroid), request.rotation, directions},
                    surface, surface.nodes);
    }
  }
  const Eigen::Index rows = 3 * solid.points();
  ties.carry_kept = sparse(rows, static_cast<Eigen::Index>(ties.kept.size()), kept);
  ties.carry_released = sparse(rows, static_cast<Eigen::Index>(ties.released.size()), released);
  ties.spread = sparse(rows, static_cast<Eigen::Index>(ties.averages.size()), spread);
  return ties;
}

}  // namespace bielle::reduce

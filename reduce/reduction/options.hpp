// The user's request for a reduction, independent of any file format: body_file.cpp fills it, reduce_body() executes
// it. The `subject` of a request is the key by which the user makes it; it stands in messages about the request.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/fe/integration.hpp"
#include "reduce/fe/material.hpp"
#include "reduce/reduction/mode_request.hpp"

namespace bielle::reduce {

/// Relation of the nodes of a surface to their interface node.
enum class Tie {
  rigid,    ///< every node moves with the interface node as with a rigid body
  average,  ///< the interface node moves as the area-weighted mean of the surface, which stays flexible
  free      ///< each node of the group is an interface of its own with 3 translations
};

struct InterfaceRequest {
  std::string name;
  std::string group;  ///< surface group of the mesh, or a group of nodes with weights
  Tie tie = Tie::rigid;
  std::optional<Eigen::Vector3d> position;  ///< [m]; default: centroid of the surface (area-weighted)
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  std::array<bool, 6> kept = {true, true, true, true, true, true};
  std::string subject;  ///< "interfaces.big_end"
};

struct LoadRequest {
  std::string name;
  std::string group;                        ///< surface group
  std::optional<double> pressure;           ///< [Pa], pushing against the surface; or
  std::optional<Eigen::Vector3d> traction;  ///< [Pa], body axes; or
  std::optional<Eigen::Vector3d> force;     ///< total [N], spread evenly over the area
  std::string subject;                      ///< "loads.gas"
  bool residual = false;                    ///< whether its static answer shall be exact, by residual vectors
};

/// A named point inside the body: the mean of a surface, or a place in the mesh.
struct PointRequest {
  std::string name;
  std::string group;                        ///< surface group that it follows; empty: the mesh around `position`
  std::optional<Eigen::Vector3d> position;  ///< [m]; default: centroid of the surface (area-weighted)
  std::array<bool, 6> residual{};           ///< loads x y z rx ry rz, body axes, that get residual vectors
  std::string subject;                      ///< "points.pin"
};

/// A rigid mass that moves as the area-weighted mean of a surface, or as the mean of the nodes around a place.
struct MassRequest {
  std::string name;
  std::string group;                                  ///< surface group that it follows; or
  std::optional<Eigen::Vector3d> place;               ///< place in the mesh whose nodes it follows [m]
  double mass = 0;                                    ///< [kg], not negative
  std::optional<Eigen::Vector3d> position;            ///< its centre [m]; default: centroid of the surface, the place
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about its centre, body axes [kg m^2]
  std::string subject;                                ///< "masses.motor"
};

/// Mass without stiffness on a surface.
struct CoatingRequest {
  std::string name;
  std::string group;         ///< surface group
  double mass_per_area = 0;  ///< [kg/m^2], positive
  std::string subject;       ///< "masses.paint"
};

enum class RecoveryExtent { none, surface, all };

struct ReductionOptions {
  std::string name;
  std::string input_text;
  std::map<std::string, Material> materials;
  std::map<std::string, std::string> regions;  ///< volume group -> material name; key "all" for the whole body
  Integration integration = Integration::standard;
  std::vector<InterfaceRequest> interfaces;  ///< at least one: a mechanism moves a body by its interfaces
  ModeRequest modes;                         ///< fixed-boundary modes; without a request: none
  bool inertia_relief = false;               ///< residual vectors for its own accelerations (inertia_answer.hpp)
  bool modes_proven = false;                 ///< whether to count the modes, to prove that none was missed
  /// Damping of the eigenmodes of the free reduced body, in their order, where the last ratio holds for all further
  /// ones; or Rayleigh damping.
  std::vector<double> damping_ratios;
  std::optional<std::array<double, 2>> rayleigh;  ///< alpha [1/s] on M~, beta [s] on K~
  std::vector<LoadRequest> loads;
  std::vector<PointRequest> points;
  std::vector<MassRequest> masses;
  std::vector<CoatingRequest> coatings;
  bool lumped = false;  ///< whether the mesh has a diagonal mass matrix (fe/assembly.hpp)
  RecoveryExtent displacement_recovery = RecoveryExtent::all;
  RecoveryExtent stress_recovery = RecoveryExtent::surface;
  bool judged = true;  ///< whether to measure the accuracy of the reduction
};

}  // namespace bielle::reduce

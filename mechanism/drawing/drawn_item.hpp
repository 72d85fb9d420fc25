// Shapes by which a mechanism is drawn: plain data without mechanics. The format in which the results file holds them,
// with all kinds of shapes and their values, is described in mechanism/io/drawing.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

/// A place that moves with a node.
struct DrawnPlace {
  int node = 0;  ///< index of the model's node
  Frame frame;   ///< axes of the node -> axes of the item [m]
};

/// A mesh of triangles, which any number of items may use.
struct DrawnMesh {
  std::string name;                                    ///< e.g. the name of its file
  std::vector<std::array<float, 3>> points;            ///< [m]
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< indices of points, anticlockwise seen from outside
};

/// A pulley of a course of rope, about z of its place.
struct DrawnPulley {
  double radius = 0;  ///< [m]; 0: the rope passes a point
  int side = 1;       ///< +1: the rope runs round it in the positive sense about z, -1: in the negative one
};

/// A closed outline of a beam's section, in the axes y and z of the section [m].
using DrawnOutline = std::vector<std::array<double, 2>>;

/// The section of a beam at one of its stations.
struct DrawnSection {
  double at = 0;  ///< 0 at the start of the beam, 1 at its end
  DrawnOutline outer;
  DrawnOutline inner = {};  ///< empty: the section is solid
};

/// A value of an item: lengths in m.
using DrawnValue = std::variant<double, bool, std::string, std::vector<double>, std::vector<std::string>,
                                std::vector<std::vector<double>>>;

/// One thing that is drawn.
struct DrawnItem {
  std::string shape;  ///< kind of the shape: "box"
  /// One place of the shape itself, its two ends, the frames of a joint on its nodes, or the points of a course.
  std::vector<DrawnPlace> places = {};
  std::vector<std::pair<std::string, DrawnValue>> values = {};  ///< e.g. {"radius", 0.1}
  std::shared_ptr<const DrawnMesh> mesh = {};
  std::vector<DrawnPulley> pulleys = {};    ///< pulleys at the places of a course
  std::vector<DrawnSection> sections = {};  ///< sections of a beam, from its start to its end
  std::string colour = {};                  ///< "#rrggbb"; empty: the viewer chooses
  double opacity = 1;                       ///< 0: invisible, 1: opaque
  std::string role = {};                    ///< "contact", "support", "cut" (removed from the other solids), or empty
  std::string entry = {};                   ///< section and name in the file, "joints/main"
  std::string type = {};                    ///< type as in the file, "hinge"
};

}  // namespace bielle::mechanism

// Quantities of a component that has a mesh: they are large, and are recorded only if the user asks for them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

/// A place in a component that has a mesh: one of its nodes, or a point in the axes of the mesh [m].
struct MeshPlace {
  std::optional<int> node;
  Vector3 point = Vector3::Zero();
};

/// Functions without `const` are called while the model is read. @throws InputError
class MeshFields {
 public:
  virtual ~MeshFields() = default;

  /// Names of the fields that can be recorded: "von_mises".
  virtual std::vector<std::string> field_names() const = 0;
  /// Adds one of them to the outputs of the component.
  virtual void record_field(const std::string& field) = 0;
  /// Adds a quantity that the file of another program recovers to the outputs.
  virtual void record_quantity(const std::string& name) = 0;
  /// Returns the names of the fields that can be recorded at a single point: "stress".
  virtual std::vector<std::string> point_field_names() const = 0;
  /// Records one of them at a place of the mesh. @param name  under which it is recorded
  virtual void record_at(const std::string& field, const std::string& name, const MeshPlace& place) = 0;
  /// Names of the quantities whose largest values over all steps can be recorded.
  virtual std::vector<std::string> peak_names() const = 0;
  /// Requests these peaks. It is called once.
  virtual void record_peaks(const std::vector<std::string>& quantities) = 0;

  /// Returns whether the outputs are so large that they are cheaper to compute for several states at once.
  virtual bool outputs_together() const = 0;
  /// Does the same as Component::write_output for each of the states. @param values  of each state
  virtual void write_outputs(std::span<const LocalState> states, std::span<double* const> values) const = 0;
};

}  // namespace bielle::mechanism

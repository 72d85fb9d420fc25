// All outputs of a superelement that require its mesh: whole fields, and stress or strain at chosen points.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/elements/superelement/recovery/recovered_field.hpp"
#include "mechanism/model/mesh_fields.hpp"

namespace bielle::mechanism {

class RecoveredOutputs {
 public:
  /// Each function throws InputError if the superelement does not contain the data to recover it, and the message
  /// describes how to make one that does.
  void add_field(const std::string& field, const Superelement& body);
  /// Adds a field of stress at the node nearest to a place, recorded as "<field>_at_<name>".
  void add_point(const std::string& field, const std::string& name, const MeshPlace& place, const Superelement& body);
  /// Adds a quantity of the superelement's file, recorded under its name.
  void add_quantity(const std::string& name, const Superelement& body);
  /// Reads the stress of all nodes, which all derived quantities share.
  void load_stress(const Superelement& body);
  std::shared_ptr<const StressRecovery> stress() const { return stress_; }
  bool has_stress() const { return stress_ != nullptr; }  ///< stress or strain was requested

  const std::vector<OutputField>& descriptions() const { return descriptions_; }
  /// Attributes of the points: {"stress_at_root", "node 12 at [..] m"}.
  const std::vector<std::pair<std::string, std::string>>& facts() const { return facts_; }
  bool large() const { return !of_displacement_.empty() || !of_stress_.empty(); }  ///< whole fields are recorded
  /// @param coordinates  coordinates of the frames, in the order of the file
  /// @param values       for each frame; the described values begin at `begin`
  void write(const FrameBlock& coordinates, std::span<double* const> values, std::size_t begin) const;

 private:
  struct Field {
    RecoveredField field;
    std::size_t offset;  ///< offset of the first number of the output among the described values
  };
  struct Point {
    RecoveredField field;
    std::size_t offset;
    StressRecovery stress;
  };
  struct Quantity {
    std::size_t offset;
    MatrixX matrix;  ///< (rows, n)
  };
  std::size_t take(const OutputField& description);
  void write_displacement(const FrameBlock& coordinates, std::span<double* const> values, std::size_t begin) const;

  RecoveryMatrix displacement_;  ///< (3 p, n)
  std::shared_ptr<const StressRecovery> stress_;
  std::vector<Field> of_displacement_, of_stress_;
  std::vector<Point> points_;
  std::vector<Quantity> quantities_;
  std::vector<OutputField> descriptions_;
  std::vector<std::pair<std::string, std::string>> facts_;
  std::size_t size_ = 0;
};

}  // namespace bielle::mechanism

// A rope that is divided into sections at the places that grip it or on which it slips with friction, as the readers of
// belts and cables create it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/joints/cables/rope_section.hpp"

namespace bielle::mechanism {

/// For each place of a rope, the coefficient of friction if it slips there with friction.
using RopeFrictions = std::vector<std::optional<double>>;

class DividedRope {
 public:
  /// @param entry  for messages; all arguments must outlive the object
  DividedRope(const char* type, const std::string& name, const RopePath& path, const RopeMaterial& material,
              const RopeFrictions& frictions, const YamlValue& entry, Model& model);
  /// Adds the components to the model. @param sections  places that each section passes, its ends included
  /// @throws InputError if pulleys overlap
  void add(const std::vector<std::vector<std::size_t>>& sections, bool closed);

 private:
  Entry own() const { return {Section::joints, name_}; }
  void add_slip(std::size_t place);
  const RopeSection& add_section(const std::vector<std::size_t>& places, Recorded recorded);
  void add_between(const RopeSection& before, const RopeSection& after, std::size_t place, bool closed);

  const char* type_;
  const std::string& name_;
  const RopePath& path_;
  const RopeMaterial& material_;
  const RopeFrictions& frictions_;
  const YamlValue& entry_;
  Model& model_;
  std::vector<const RopeSlip*> slips_;           ///< at each place; nullptr: none
  std::size_t frictions_added_ = 0, count_ = 0;  ///< numbers of pulleys with friction
};

}  // namespace bielle::mechanism

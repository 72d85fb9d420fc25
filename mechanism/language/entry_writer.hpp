// Entries of a part as entries of the model: with names, numbers and places of the model.
#pragma once

#include <functional>
#include <string>

#include "mechanism/language/scope.hpp"
#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// Rewrites entries of one scope. The tables of keys tell which texts are names, formulas and vectors.
class EntryWriter {
 public:
  /// Makes a node at a point of a body. @param point  a map of body_point_keys, with the model's names
  /// @returns the name of the node
  using MakePoint = std::function<std::string(const YamlNode& point, const std::string& path)>;

  EntryWriter(const Scope& scope, const MakePoint& make_point) : scope_(scope), make_point_(make_point) {}

  /// @param path  path of the value in the model, for messages
  Tree write(const Tree& value, const KeyForms& forms, const std::string& path) const;
  Tree write_map(const YamlNode& map, const KeyTable& table, const std::string& path) const;

 private:
  Tree write_scalar(const Tree& node, const KeyForms& forms, const std::string& path) const;
  Tree write_entries(const YamlNode& map, const KeyForm& form, const std::string& path) const;
  Tree write_list(const YamlNode& list, const KeyForms& forms, const std::string& path) const;
  Tree place_word(const YamlNode& node, const std::string& text, const KeyForms& forms) const;
  Tree mirrored_inertia(const Tree& value) const;
  Tree place_vector(const Tree& list, const KeyForm& form, const std::string& path) const;
  Tree place_frame(const YamlNode& map, const KeyTable& table) const;

  const Scope& scope_;
  const MakePoint& make_point_;
};

}  // namespace bielle::mechanism

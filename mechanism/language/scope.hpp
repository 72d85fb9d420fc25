// Names and numbers that mean something in a part or in a repeated entry only.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "mechanism/language/placement.hpp"
#include "mechanism/language/tree.hpp"
#include "reduce/common/formula/expression.hpp"

namespace bielle::mechanism {

/// Checks that a number of a part, or of a repeated entry, has a name that formulas can contain.
void check_word(const std::string& name, const YamlNode& place, const std::string& main_file, const std::string& path);

/// A part that is being placed, or one turn of a repeated entry.
struct Scope {
  const Scope* outer = nullptr;
  const std::string* main_file = nullptr;    ///< file of nodes without a file of their own
  const Parameters* parameters = nullptr;    ///< of the whole model
  std::map<std::string, double> values;      ///< parameters of the part, numbers of repeated entries
  std::map<std::string, std::string> words;  ///< words of repeated entries
  std::string prefix;                        ///< of the part's names: "blade_2."; empty in the model itself
  std::set<std::string> own;                 ///< names of the part's entries, as the part writes them
  std::set<std::string> measures;            ///< those that are plain words in formulas
  std::map<std::string, Tree> merged;        ///< nodes of the part that are nodes of the model, whose names these are
  Placement placement;                       ///< of the part's axes in the inertial ones

  /// Returns a scope for something within this one. @pre this one lives longer
  Scope inner() const;
  /// Returns whether names or numbers have to be replaced.
  bool replaces() const;
  /// Returns the name in the model of a thing that the part names; nothing if the part has no such thing.
  std::optional<std::string> name_of(const std::string& name) const;
  /// Returns the text of a formula with names and numbers of the model.
  /// @param variables  names that the formula itself has
  std::string formula(const std::string& text, const std::vector<std::string>& variables) const;
  /// Returns a text in which words in braces, and formulas as whole numbers, are replaced: "{side}_bay_{k+1}".
  /// @param path  for messages
  std::string text(const YamlNode& node, const std::string& path) const;
  /// Evaluates a number or formula of parameters; a number may have a unit.
  double number(const YamlNode& node, const std::string& path) const;
  /// Evaluates a number of an entry in the model. Returns no value for a formula of time or of the state.
  std::optional<double> constant(const YamlNode& node, const std::string& path) const;

 private:
  const std::string* word_of(const std::string& name) const;
};

}  // namespace bielle::mechanism

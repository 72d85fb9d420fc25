// Input files: YAML with file and line in every message, suggestions for unknown keys, and numbers that may be
// expressions of the file's parameters.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"
#include "reduce/common/formula/formula_references.hpp"
#include "reduce/common/input/key_table.hpp"

namespace bielle {

struct YamlNode;

/// A value in an input file, with its position. Cheap to copy.
///
/// Every reader throws InputError `file:line: path.of.key: what was expected`. Each reader of a map binds it to its
/// table of keys once (`keyed`), which refuses unknown keys: nothing in a file is silently ignored. The values of a
/// bound map know their units, ranges and defaults. Duplicate keys, merge keys (`<<`) and second documents are refused
/// when the file is loaded.
class YamlValue {
 public:
  /// Loads a file. @throws InputError when it is missing, unreadable or no valid YAML (with the line).
  static YamlValue load(const std::string& path);
  /// Parses text; `name` stands for the file in messages.
  static YamlValue parse(const std::string& text, const std::string& name);
  /// Reads a tree that was made from one or several files. @param text  the first file as it is written
  /// @param name  the first file; nodes without a file of their own belong to it
  static YamlValue of_tree(std::shared_ptr<const YamlNode> root, const std::string& text, const std::string& name);

  /// Parameters that numbers in this file may use (shared by all values of the file).
  void set_parameters(Parameters parameters);
  /// Adds one parameter.
  void set_parameter(const std::string& name, double value);
  const Parameters& parameters() const;

  bool is_map() const;
  bool is_sequence() const;
  bool is_scalar() const;
  bool is_null() const;

  // -- maps
  bool has(const std::string& key) const;
  /// Returns the value of a key; that of the table's default if the key is missing. @throws if there is no default
  YamlValue at(const std::string& key) const;
  std::optional<YamlValue> find(const std::string& key) const;  ///< empty when missing
  /// Returns keys and values in the order of the file. @throws when this is no map; a null value is an empty map.
  std::vector<std::pair<std::string, YamlValue>> entries() const;
  /// @throws InputError at the first key not in `allowed`: `'dampng' is not a key of a hinge; did you mean 'damping'?`
  /// @param of  the thing in words with its article: "a hinge", "the mesh"
  void check_keys(const std::vector<std::string>& allowed, const std::string& of) const;
  /// Returns this map bound to a table, or to the variant of it that applies: its values have the forms of the table's
  /// keys. A value that is a map, and can have one table only, is bound when it is taken out of this map.
  /// @throws InputError at the first key that the table does not have, as check_keys
  YamlValue keyed(const KeyTable& table) const;

  // -- sequences
  std::size_t size() const;
  YamlValue at(std::size_t index) const;
  std::vector<YamlValue> items() const;  ///< @throws when this is no sequence

  // -- scalars. Numbers may be expressions of the parameters, or have a unit if the value's form has one; they are
  // returned in SI units. Infinities, NaN and numbers outside the form's range are refused.
  double number() const;
  double positive_number() const;      ///< > 0
  double non_negative_number() const;  ///< >= 0
  int integer() const;
  bool boolean() const;
  std::string text() const;  ///< the text as written, also of numbers
  /// Returns one of the given words; the message for any other suggests the nearest. @param what  in words with its
  /// article: "a joint type"
  std::string word(const std::vector<std::string>& allowed, const std::string& what) const;
  std::string word() const;  ///< one of the words of the value's form
  Eigen::VectorXd vector() const;
  /// Returns a list of `count` numbers greater than 0. @param expected  description for messages: "[radius, length]"
  Eigen::VectorXd positive_numbers(std::size_t count, const std::string& expected) const;
  Eigen::Vector3d vector3() const;
  Eigen::Vector3d direction() const;  ///< vector3, normalised. @throws when zero
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) const;
  /// Returns a formula of the parameters and the given variables (e.g. {"t"}).
  Expression expression(const std::vector<std::string>& variables) const;
  Expression expression() const;  ///< a formula of the variables of the value's form
  /// Returns the text of a number or formula with its references; `variables` and the parameters are plain names.
  FormulaText formula_text(const std::vector<std::string>& variables, const std::vector<std::string>& functions) const;
  /// Returns the formula of such a text; its arguments are the variables, then the references.
  Expression expression(const std::vector<std::string>& variables, const FormulaText& formula) const;
  /// Returns a file name relative to the folder of this input file.
  std::string file_path() const;

  /// Returns every value below this one with its path, in the order of the file: numbers by their values, formulas with
  /// the values of their parameters ("2*k (k = 3)"), names of files with a sum over their contents. Equal digests mean
  /// equal models. @param but  keys of this map to leave out
  std::vector<std::pair<std::string, std::string>> digest(const std::vector<std::string>& but = {}) const;

  // -- place
  const std::string& file() const;  ///< the file in which the value stands
  int line() const;                 ///< 1-based
  std::string path() const;         ///< "joints.main.axis[1]"; items of lists are counted from 1
  std::string source_text() const;  ///< the whole text of the file, for the results' /input
  /// `file:line: path: message`
  [[noreturn]] void fail(const std::string& message) const;
  std::string located(const std::string& message) const;  ///< the text that `fail` throws
  /// Notes a value that is possible but probably unintended, as a message in the form of `fail`, which is shown to the
  /// user.
  void warn(const std::string& message) const;
  const std::vector<std::string>& warnings() const;  ///< warnings about the whole file, in the order of reading

 private:
  struct Document;
  YamlValue(std::shared_ptr<Document> document, std::shared_ptr<const YamlNode> node, std::string path, int line);
  YamlValue child(const YamlNode& key, std::shared_ptr<const YamlNode> value) const;
  const Key& key_of_table(const std::string& key) const;
  YamlValue with_forms(const KeyForms& forms) const;
  const KeyForms& forms() const;
  double in_si(const std::string& written) const;
  void check_range(double value) const;
  void check_map(const std::string& expected) const;
  std::shared_ptr<Document> document_;
  std::shared_ptr<const YamlNode> node_;
  std::string path_;
  int line_ = 0;
  const KeyTable* table_ = nullptr;  ///< table of a bound map
  const KeyForms* forms_ = nullptr;  ///< forms that the value may have; null if they are not known
};

}  // namespace bielle

// Forms of values in input files: kinds, units, ranges and choices. Tables of keys are written in these words.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace bielle {

struct KeyForm;
struct KeyTable;
struct YamlNode;
/// The forms that a value may have; the first one that fits is taken.
using KeyForms = std::vector<KeyForm>;

/// One form in which a value is written. The functions below make forms.
struct KeyForm {
  enum class Kind {
    number,   ///< a number, or a formula of the parameters
    integer,  ///< a whole number, or a formula of the parameters
    formula,  ///< a number, or a formula of `words` and, if `reads_state`, of the state of the mechanism
    boolean,  ///< true or false
    text,     ///< any text
    word,     ///< one of `words`
    file,     ///< name of a file, relative to the folder of the input file
    name,     ///< name of something in the model; `of` is its kind: "node", "joint"
    list,     ///< a list
    table,    ///< keys of `table`
    entries,  ///< keys that the user chooses, each with a value of `items[0]`
    null      ///< `~`
  };
  /// Behaviour when the part of a mechanism in which the value stands is placed elsewhere, or mirrored.
  enum class Geometry {
    none,         ///< it does not change
    point,        ///< position of a point: three numbers
    vector,       ///< direction, displacement, velocity or force: three numbers
    axial,        ///< axis of a rotation, angular velocity or moment: three numbers; a mirror reverses them relative to
                  ///< a reflected vector
    pseudoscalar  ///< angle or other number that changes its sign in a mirror
  };
  Kind kind = Kind::text;
  Geometry geometry = Geometry::none;
  bool inertial = false;  ///< whether the components are inertial; otherwise they are along axes of a node or body
  std::string unit;       ///< SI unit of numbers and formulas, or several: "m or rad". Empty for a number without unit.
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above = false, below = false;  ///< whether `least` and `most` themselves are excluded
  std::vector<std::string> words;     ///< choices of a word, variables of a formula
  bool reads_state = false;           ///< a formula that may contain measures
  std::string of;                     ///< "a direction": a word with its article; "node": a name; "STL": a file
  std::size_t fewest = 0, most_items = std::numeric_limits<std::size_t>::max();  ///< number of items of a list
  std::vector<KeyForms> items;  ///< forms of all items of a list, or of each one; forms of the values of entries
  const KeyTable& (*table)() = nullptr;

  // Ranges, which return the form so that they can be chained.
  KeyForm positive() const;      ///< > 0
  KeyForm non_negative() const;  ///< >= 0
  KeyForm at_least(double value) const;
  KeyForm at_most(double value) const;
  KeyForm between(double least, double most) const;  ///< both included
  KeyForm inside(double least, double most) const;   ///< both excluded
  KeyForm items_at_least(std::size_t count) const;   ///< of a list
  // Geometry, of a list of three numbers or of one number.
  KeyForm as_point() const;
  KeyForm as_vector() const;
  KeyForm as_axial() const;
  KeyForm as_pseudoscalar() const;
  KeyForm in_inertial_axes() const;
  bool in_range(double value) const;
  /// Returns the range in words: "greater than 0", "between 0 and 1"; empty if every number is allowed.
  std::string range_words() const;
  bool is_numeric() const { return kind == Kind::number || kind == Kind::integer || kind == Kind::formula; }
  /// Tells whether a node can have this form, by its kind alone: a scalar, a map, or a list with the right number of
  /// items of which the first one fits.
  bool fits(const YamlNode& node) const;

 private:
  KeyForm with_geometry(Geometry is) const;
};

// -- the form among several; null if there is none
const KeyForm* form_of(const KeyForms& forms, KeyForm::Kind kind);
const KeyForm* numeric_form(const KeyForms& forms);
/// Returns the form that fits a list; if none fits, any form of a list.
const KeyForm* form_of_list(const KeyForms& forms, const YamlNode& list);

namespace keys {

KeyForm number(std::string unit = {});
KeyForm integer();
/// @param variables  its own variables besides the parameters: {"t"}
KeyForm formula(std::string unit, std::vector<std::string> variables);
/// Returns a formula that may read measures of the state.
KeyForm state_formula(std::string unit, std::vector<std::string> variables);
KeyForm boolean();
KeyForm text();
/// @param of  the thing in words with its article: "a direction"
KeyForm word(std::vector<std::string> choices, std::string of);
/// @param of  the kind of file: "STL", "table of two columns"
KeyForm file(std::string of);
/// @param of  the kind of thing in the singular: "node", "joint"
KeyForm name_of(std::string of);
KeyForm list_of(KeyForms item);
KeyForm list_of(KeyForm item);
KeyForm list_of(std::size_t count, KeyForms item);
KeyForm list_of(std::size_t count, KeyForm item);
/// Returns a list in which each place has its own forms.
KeyForm tuple(std::vector<KeyForms> items);
KeyForm vector3(std::string unit);
/// Returns the form of three numbers that are not all zero; their length is arbitrary.
KeyForm direction();
KeyForm matrix(std::size_t rows, std::size_t columns, std::string unit);
/// Returns a map with the keys of a table.
KeyForm nested(const KeyTable& (*table)());
/// @param of  the kind of thing that a key names: "direction", "node"
KeyForm entries(std::string of, KeyForms value);
KeyForm null();

}  // namespace keys
}  // namespace bielle

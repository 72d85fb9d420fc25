// References in formulas to quantities of a model: `main.angle.rate`, `'left arm'.position.x`, `distance(a, 'node 2')`,
// `delay(main.angle - 1, 2*T)`.
//
// muParser accepts plain names only. Each reference is therefore replaced by a plain name, which becomes a further
// variable of the formula; the caller decides which objects and quantities exist.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bielle {

/// One reference in a formula.
struct FormulaReference {
  std::string text;      ///< its first spelling, for messages
  std::string function;  ///< "distance"; empty for a dotted reference
  /// Names without quotes: the one before the dot, or those in the parentheses. For a function of formulas, the texts
  /// of its operands.
  std::vector<std::string> subjects;
  std::vector<std::string> path;  ///< the words after the dots: "angle", "rate"
  std::string identifier;         ///< the plain name that stands for it
  std::size_t position = 0;       ///< position of its first character in the formula (from 0; messages count from
                                  ///< 1)
};

/// A formula and its references.
struct FormulaText {
  std::string written;                       ///< by the user
  std::string replaced;                      ///< with identifiers in place of references; all other characters keep
                                             ///< their places
  std::vector<FormulaReference> references;  ///< in the order in which they appear, each once
};

/// Finds `name.word.word` and `function(name, name)`, both with or without further `.word`s. A name that contains
/// characters other than letters, digits and `_` is quoted ('..' or ".."). Blanks are allowed in quotes and
/// parentheses, not at dots. Numbers, and quoted file names without a dot after them, are not changed.
///
/// `'main'.angle` and `main.angle` are the same reference. The plain name is as long as the shortest spelling of the
/// reference and is padded with blanks elsewhere, so that positions reported by the parser are those of the original
/// formula. Plain names differ from all names in the formula, from `plain_names` and from the built-in names.
///
/// @param plain_names  variables and parameters
/// @param functions    functions whose operands are names, e.g. {"distance", "angle"}
/// @param of_formulas  functions whose operands are formulas that the caller reads, e.g. {"delay"}; their references
///                     are not among those of this formula
/// @throws InputError without file or line: the error and its position
FormulaText find_references(const std::string& text, const std::vector<std::string>& plain_names,
                            const std::vector<std::string>& functions,
                            const std::vector<std::string>& of_formulas = {});

/// Returns a formula with other names. The names within quotes and parentheses are found as above; a name in
/// parentheses may have dots.
/// @param subject  returns the new name of a node, joint or other thing before a dot or in parentheses, or nothing
///                 if it stays; a name that is no word is put in quotes
/// @param word     returns the text in place of a plain name (a parameter, variable or function), or nothing
std::string rename_in_formula(const std::string& text, const std::vector<std::string>& functions,
                              const std::function<std::optional<std::string>(const std::string&)>& subject,
                              const std::function<std::optional<std::string>(const std::string&)>& word);

}  // namespace bielle

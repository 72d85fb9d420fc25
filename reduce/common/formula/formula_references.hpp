// References in formulas to what a model holds: `main.angle.rate`, `'left arm'.position.x`, `distance(a, 'node 2')`.
//
// muParser knows plain names only. Here each reference is replaced by one, and the formula becomes one of more
// variables; the caller decides which things and quantities exist.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bielle {

/// One thing that a formula refers to.
struct FormulaReference {
  std::string text;                   ///< as it is written first, for messages
  std::string function;               ///< "distance"; empty of a dotted reference
  std::vector<std::string> subjects;  ///< names without quotes: one before the dot, those in the parentheses
  std::vector<std::string> path;      ///< what follows the dots: "angle", "rate"
  std::string identifier;             ///< the plain name that stands for it
  std::size_t position = 0;           ///< of its first character in the formula (from 0; messages count from 1)
};

/// A formula and what it refers to.
struct FormulaText {
  std::string written;                       ///< by the user
  std::string replaced;                      ///< with identifiers for references, every character at its place
  std::vector<FormulaReference> references;  ///< in the order in which they appear, each once
};

/// Finds `name.word.word` and `function(name, name)`, both with or without further `.word`s. A name of other characters
/// than letters, digits and `_` is quoted ('..' or ".."). Blanks may stand in quotes and parentheses, not at dots.
/// Numbers, and quoted file names without a dot after them, are left alone.
///
/// `'main'.angle` and `main.angle` are the same reference. Identifiers are as long as the reference is where it is
/// written shortest, and padded with blanks elsewhere, so that the parser tells positions of the written formula. They
/// differ from all names in the formula, from `plain_names` and from what is built in.
///
/// @param plain_names  variables and parameters
/// @param functions    those whose operands are names, e.g. {"distance", "angle"}
/// @throws InputError without file or line: what is wrong, at which character
FormulaText find_references(const std::string& text, const std::vector<std::string>& plain_names,
                            const std::vector<std::string>& functions);

}  // namespace bielle

// The mechanism file: a model, the analyses to run on it, and the selection of results.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mechanism/analyses/analysis.hpp"
#include "mechanism/io/output_options.hpp"
#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

struct MechanismFile {
  Model model;
  std::vector<std::unique_ptr<Analysis>> analyses;
  OutputOptions output;
  std::string text;  ///< text of the file; if it consists of parts or several files, with all entries written out
  std::string path;  ///< path of the file; empty if it was read from a text
  /// Warnings about values that are possible but probably unintended, each with its position.
  std::vector<std::string> warnings;
  ModelMaker maker;  ///< creates the model with another value of a parameter
};

/// Reads a mechanism file.
/// @param overrides  parameters given on the command line, `NAME` -> `EXPRESSION`
/// @param chosen_case  entry of `cases` whose parameters and analyses replace those of the file; empty: none
/// @throws InputError
MechanismFile read_mechanism_file(const std::string& path, const std::map<std::string, std::string>& overrides = {},
                                  const std::string& chosen_case = {});

/// Returns the names of the cases of a file, in its order.
std::vector<std::string> read_case_names(const std::string& path);

/// Reads the text of a mechanism file, where `name` identifies the file in messages.
MechanismFile read_mechanism_text(const std::string& text, const std::string& name,
                                  const std::map<std::string, std::string>& overrides = {});

}  // namespace bielle::mechanism

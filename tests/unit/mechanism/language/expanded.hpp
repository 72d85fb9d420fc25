// Models that are written out, for tests of the language.
#pragma once

#include <string>

#include "mechanism/io/mechanism_keys.hpp"
#include "mechanism/language/expand_model.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_writer.hpp"
#include "tests/support/messages.hpp"

namespace bielle::test {

/// Returns the text of a model in which every entry is written out.
inline std::string expanded(const std::string& text, const std::string& chosen_case = {},
                            const std::string& file = "model.yaml") {
  using namespace mechanism;
  return write_yaml(*expand_model(parse_yaml(text, file), file, mechanism_file_keys(), {{}, chosen_case}).root, 1000);
}

/// Returns the message with which a model is refused.
inline std::string refusal(const std::string& text, const std::string& chosen_case = {}) {
  return message_of<InputError>([&] { expanded(text, chosen_case); });
}

}  // namespace bielle::test

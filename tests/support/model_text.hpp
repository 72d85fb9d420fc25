// Models from a few lines of YAML, for tests of single components.
#pragma once

#include <memory>
#include <string>

#include "mechanism/model/model.hpp"

namespace bielle::test {

/// Returns the model of a mechanism file's text; errors name the file "model.yaml".
std::unique_ptr<mechanism::Model> model_from_text(const std::string& text);

}  // namespace bielle::test

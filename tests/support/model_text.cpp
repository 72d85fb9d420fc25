#include "tests/support/model_text.hpp"

#include <utility>

#include "mechanism/io/mechanism_file.hpp"

namespace bielle::test {

std::unique_ptr<mechanism::Model> model_from_text(const std::string& text) {
  mechanism::MechanismFile file = mechanism::read_mechanism_text(text, "model.yaml");
  return std::make_unique<mechanism::Model>(std::move(file.model));
}

}  // namespace bielle::test

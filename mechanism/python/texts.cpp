#include "mechanism/python/texts.hpp"

#include <cctype>

namespace bielle::python {

std::string without_unseen_lines(const std::string& sentence) {
  if (sentence.find(unseen) == std::string::npos) return sentence;
  std::string text;
  for (std::size_t at = 0; at < sentence.size(); ++at) {
    if (sentence[at] != unseen) {
      text += sentence[at];
      continue;
    }
    std::size_t end = at + 1;
    if (end < sentence.size() && sentence[end] == ':') {
      ++end;
      while (end < sentence.size() && std::isdigit(static_cast<unsigned char>(sentence[end]))) ++end;
      if (end > at + 2) at = end - 1;
    }
  }
  return text;
}

std::string of_parameters(const std::string& sentence) {
  const std::string option = "--set ";
  return sentence.starts_with(option) ? "parameters: " + sentence.substr(option.size()) : sentence;
}

}  // namespace bielle::python

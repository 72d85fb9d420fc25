// Texts of users, shortened for messages.
#pragma once

#include <string>

namespace bielle {

/// The text itself, or its beginning and end if it has more than a hundred characters.
inline std::string shortened(const std::string& text) {
  constexpr std::size_t most = 100, end = 30;
  if (text.size() <= most) return text;
  return text.substr(0, most - end) + " ... " + text.substr(text.size() - end);
}

}  // namespace bielle

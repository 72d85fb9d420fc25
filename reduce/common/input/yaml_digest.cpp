// A digest: a list of the values of an input file, by which two files can be compared.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "reduce/common/files/checksum.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle {
namespace {

using Digest = std::vector<std::pair<std::string, std::string>>;

bool is_word_letter(char letter) { return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_'; }

/// "; k = 3": the parameters that occur in a text, each once.
std::string parameters_in(const std::string& text, const Parameters& parameters) {
  std::set<std::string> found;
  for (std::size_t k = 0; k < text.size();) {
    std::size_t end = k;
    while (end < text.size() && is_word_letter(text[end])) ++end;
    if (end > k && (k == 0 || text[k - 1] != '.') && parameters.contains(text.substr(k, end - k)))
      found.insert(text.substr(k, end - k));
    k = std::max(end, k + 1);
  }
  std::string list;
  for (const std::string& name : found) list += fmt::format("; {} = {}", name, parameters.at(name));
  return list;
}

/// Returns the checksum stored in a superelement file, which covers its numbers and names, or a sum over the bytes of
/// any other file.
std::int64_t sum_over_file(const std::string& path) {
  if (Hdf5File::begins_like_one(path)) {
    try {
      const Hdf5File file = Hdf5File::open(path);
      if (file.has_attribute("/", "checksum")) return file.read_integer_attribute("/", "checksum");
    } catch (const InputError&) {
      // fall back to the bytes of the file
    }
  }
  std::ifstream file(path, std::ios::binary);
  Checksum sum;
  std::string block(std::size_t{1} << 20, '\0');
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0)
    sum.add(std::string_view(block.data(), static_cast<std::size_t>(file.gcount())));
  return sum.value();
}

/// Returns the sum of the file that a text names, or nothing. (A text that is no file name hardly ever matches one by
/// chance.)
std::string sum_of_file(const std::string& folder, const std::string& name) {
  std::error_code none;
  constexpr std::size_t longest_name = 4096;
  if (name.empty() || name.size() > longest_name || name.find('\0') != std::string::npos) return "";
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  if (!std::filesystem::is_regular_file(path, none)) return "";
  return fmt::format("; contents {:x}", sum_over_file(path.string()));
}

/// Returns the sums of the files that are named by the whole text or by a quoted name in it: `table('torque.csv', t)`.
std::string files_in(const std::string& text, const std::string& folder) {
  std::string sums = sum_of_file(folder, text);
  for (std::size_t k = text.find_first_of("'\""); k != std::string::npos;) {
    const std::size_t end = text.find(text[k], k + 1);
    if (end == std::string::npos) break;
    sums += sum_of_file(folder, text.substr(k + 1, end - k - 1));
    k = text.find_first_of("'\"", end + 1);
  }
  return sums;
}

std::string scalar_digest(const YamlValue& value, const std::string& folder) {
  const std::string text = value.text();
  double number = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [stopped, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (!text.empty() && error == std::errc() && stopped == text.data() + text.size()) return fmt::format("{}", number);
  const bool may_name = text.find_first_of("'\"./") != std::string::npos;
  const std::string notes = parameters_in(text, value.parameters()) + (may_name ? files_in(text, folder) : "");
  return notes.empty() ? text : fmt::format("{} ({})", text, notes.substr(2));
}

void collect(const YamlValue& value, const std::string& folder, Digest& digest) {
  if (value.is_map()) {
    const auto entries = value.entries();
    if (entries.empty()) digest.emplace_back(value.path(), "{}");
    for (const auto& [key, entry] : entries) collect(entry, folder, digest);
  } else if (value.is_sequence()) {
    const auto items = value.items();
    if (items.empty()) digest.emplace_back(value.path(), "[]");
    for (const YamlValue& item : items) collect(item, folder, digest);
  } else if (value.is_scalar()) {
    digest.emplace_back(value.path(), scalar_digest(value, folder));
  } else {
    digest.emplace_back(value.path(), "nothing");
  }
}

}  // namespace

Digest YamlValue::digest(const std::vector<std::string>& but) const {
  Digest digest;
  const std::string folder = std::filesystem::path(file()).parent_path().string();
  if (!but.empty()) {
    for (const auto& [key, value] : entries())
      if (std::find(but.begin(), but.end(), key) == but.end()) collect(value, folder, digest);
  } else {
    collect(*this, folder, digest);
  }
  return digest;
}

}  // namespace bielle

#include "mechanism/elements/superelement/shared_matrices.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <tuple>

namespace bielle::mechanism {
namespace {

using Key = std::tuple<std::string, std::string, std::filesystem::file_time_type, std::uintmax_t>;

}  // namespace

std::shared_ptr<const SuperelementMatrices> shared_matrices(const SuperelementPlace& place, const Superelement& body) {
  static std::mutex mutex;
  static std::map<Key, std::weak_ptr<const SuperelementMatrices>> known;
  const std::filesystem::path path = std::filesystem::weakly_canonical(place.path);
  std::error_code missing;
  const Key key(path.string(), place.group, std::filesystem::last_write_time(path, missing),
                std::filesystem::file_size(path, missing));
  const std::lock_guard lock(mutex);
  if (auto matrices = known[key].lock()) return matrices;
  std::erase_if(known, [](const auto& entry) { return entry.second.expired(); });
  auto matrices = std::make_shared<const SuperelementMatrices>(body);
  known[key] = matrices;
  return matrices;
}

}  // namespace bielle::mechanism

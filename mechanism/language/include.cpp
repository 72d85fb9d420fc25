#include "mechanism/language/include.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "reduce/common/files/file_checks.hpp"

namespace bielle::mechanism {
namespace {

namespace fs = std::filesystem;

std::string identity(const std::string& path) {
  std::error_code none;
  const fs::path canonical = fs::weakly_canonical(path, none);
  return none ? path : canonical.string();
}

/// Returns the path of a file that a node names.
std::string resolve(const YamlNode& name, const std::string& from, const std::string& what) {
  if (name.kind != YamlNode::Kind::scalar || name.scalar.empty())
    fail_at(name, from, what, "expected the name of a file");
  return (fs::path(name.file ? *name.file : from).parent_path() / name.scalar).lexically_normal().string();
}

/// Reads the tree of a file. Errors in it have their own line, others that of its name.
Tree load(const YamlNode& name, const std::string& path, const std::string& from, const std::string& what) {
  const std::string text = [&] {
    try {
      return read_input_text(path);
    } catch (const InputError& error) {
      fail_at(name, from, what, error.what());
    }
  }();
  return in_file(parse_yaml(text, path), std::make_shared<const std::string>(path));
}

/// Collects the sections of several files.
class Collector {
 public:
  explicit Collector(std::string main_file) : main_file_(std::move(main_file)) {}

  /// Adds a file after the files that it includes.
  void add(const Tree& root, const std::string& file) {
    if (root->kind != YamlNode::Kind::map) {
      if (root->kind != YamlNode::Kind::null) fail_at(*root, file, "", "expected keys with values (`key: value`)");
      return;
    }
    open_.push_back(identity(file));
    read_.insert(open_.back());
    if (const Tree list = find_value(*root, "include")) {
      if (list->kind == YamlNode::Kind::sequence)
        for (const Tree& item : list->items) include(*item, file);
      else
        include(*list, file);
    }
    for (const YamlNode::Pair& pair : root->pairs)
      if (pair.key->scalar != "include") merge(pair);
    open_.pop_back();
  }

  Tree result(const YamlNode& place) const { return make_map(sections_, place); }

 private:
  void include(const YamlNode& name, const std::string& from) {
    const std::string path = resolve(name, from, "include");
    const std::string is = identity(path);
    if (const auto above = std::find(open_.begin(), open_.end(), is); above != open_.end())
      fail_at(name, from, "include", fmt::format("'{}' includes itself{}", name.scalar, by_way_of(above)));
    if (read_.count(is)) return;  // another file has included it before
    add(load(name, path, from, "include"), path);
  }

  std::string by_way_of(std::vector<std::string>::const_iterator first) const {
    std::string way;
    for (auto each = first + 1; each < open_.end(); ++each)
      way += (way.empty() ? ", by way of " : ", ") + fs::path(*each).filename().string();
    return way;
  }

  void merge(const YamlNode::Pair& pair) {
    const std::string& section = pair.key->scalar;
    const auto known = std::find_if(sections_.begin(), sections_.end(),
                                    [&](const YamlNode::Pair& each) { return each.key->scalar == section; });
    if (known == sections_.end()) {
      sections_.push_back(pair);
      return;
    }
    const bool maps = known->value->kind == YamlNode::Kind::map && pair.value->kind == YamlNode::Kind::map;
    if (pair.value->kind == YamlNode::Kind::null) return;
    if (known->value->kind == YamlNode::Kind::null) {
      known->value = pair.value;
      return;
    }
    if (!maps) refuse(pair, *known, section);
    known->value = merged(*known->value, *pair.value, section, section == "hydraulics");
  }

  /// @param deep  whether the entries are sections themselves
  Tree merged(const YamlNode& first, const YamlNode& second, const std::string& path, bool deep) const {
    Pairs pairs = first.pairs;
    std::set<std::string> names;
    for (const YamlNode::Pair& pair : pairs) names.insert(pair.key->scalar);
    for (const YamlNode::Pair& pair : second.pairs) {
      if (names.insert(pair.key->scalar).second) {
        pairs.push_back(pair);
        continue;
      }
      const auto known = std::find_if(pairs.begin(), pairs.end(),
                                      [&](const YamlNode::Pair& each) { return each.key->scalar == pair.key->scalar; });
      if (path == "parameters")
        known->value = pair.value;
      else if (deep && known->value->kind == YamlNode::Kind::map && pair.value->kind == YamlNode::Kind::map)
        known->value = merged(*known->value, *pair.value, path + "." + pair.key->scalar, false);
      else
        refuse(pair, *known, path + "." + pair.key->scalar);
    }
    return make_map(std::move(pairs), first);
  }

  [[noreturn]] void refuse(const YamlNode::Pair& pair, const YamlNode::Pair& known, const std::string& path) const {
    fail_at(*pair.key, main_file_, path,
            fmt::format("stands in {}, line {}, already; only parameters may be given again",
                        known.key->file ? *known.key->file : main_file_, known.key->line));
  }

  std::string main_file_;
  Pairs sections_;
  std::vector<std::string> open_;  ///< files that are being read, each included by the one before it
  std::set<std::string> read_;
};

}  // namespace

Tree with_includes(const Tree& root, const std::string& file) {
  if (root->kind != YamlNode::Kind::map || !find_pair(*root, "include")) return root;
  Collector collector(file);
  collector.add(root, file);
  return collector.result(*root);
}

Tree load_with_includes(const YamlNode& name, const std::string& from, const std::string& what) {
  const std::string path = resolve(name, from, what);
  return with_includes(load(name, path, from, what), path);
}

}  // namespace bielle::mechanism

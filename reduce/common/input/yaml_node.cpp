#include "reduce/common/input/yaml_node.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <yaml.h>

#include "reduce/common/error.hpp"
#include "reduce/common/input/place.hpp"
#include "reduce/common/shortened.hpp"

namespace bielle {
namespace {

constexpr std::size_t deepest = 50;

/// Returns a hint at a tab in the indentation: the parser's message does not mention the tab, and may refer to a later
/// line.
std::string hint_at_tabs(const std::string& text, int up_to_line) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; number <= up_to_line && std::getline(lines, line); ++number) {
    const std::size_t word = line.find_first_not_of(" \t");
    if (line.substr(0, word).find('\t') != std::string::npos)
      return fmt::format(" (line {} begins with a tab; YAML wants spaces there)", number);
  }
  return "";
}

/// An event of libyaml, which frees its memory.
class Event {
 public:
  Event() = default;
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  ~Event() { yaml_event_delete(&event_); }
  yaml_event_t* get() { return &event_; }
  const yaml_event_t* operator->() const { return &event_; }
  int line() const { return static_cast<int>(event_.start_mark.line) + 1; }

 private:
  yaml_event_t event_{};
};

std::string text_of(const yaml_char_t* text) { return text == nullptr ? "" : reinterpret_cast<const char*>(text); }

class Parser {
 public:
  Parser(const std::string& text, const std::string& name) : text_(text), name_(name) {
    if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
  ~Parser() { yaml_parser_delete(&parser_); }

  std::shared_ptr<const YamlNode> document() {
    std::shared_ptr<const YamlNode> root;
    for (bool more = true; more;) {
      Event event;
      next(event);
      if (root && has_content(event)) fail(event.line(), "a second document begins; a file holds one");
      switch (event->type) {
        case YAML_STREAM_END_EVENT:
          more = false;
          break;
        case YAML_SCALAR_EVENT: {
          const auto& scalar = event->data.scalar;
          check_tag(event.line(), scalar.tag);
          auto node = make(event, YamlNode::Kind::scalar);
          node->scalar.assign(reinterpret_cast<const char*>(scalar.value), scalar.length);
          if (scalar.style == YAML_PLAIN_SCALAR_STYLE && is_null(node->scalar)) node->kind = YamlNode::Kind::null;
          remember(scalar.anchor, node);
          put(std::move(node), root);
          break;
        }
        case YAML_ALIAS_EVENT:
          put(anchored(event), root);
          break;
        case YAML_SEQUENCE_START_EVENT:
          check_tag(event.line(), event->data.sequence_start.tag);
          open(make(event, YamlNode::Kind::sequence), event->data.sequence_start.anchor);
          break;
        case YAML_MAPPING_START_EVENT:
          check_tag(event.line(), event->data.mapping_start.tag);
          open(make(event, YamlNode::Kind::map), event->data.mapping_start.anchor);
          break;
        case YAML_SEQUENCE_END_EVENT:
        case YAML_MAPPING_END_EVENT: {
          Open closed = std::move(open_.back());
          open_.pop_back();
          remember(closed.anchor, closed.node);
          put(std::move(closed.node), root);
          break;
        }
        default:
          break;  // beginning of the stream, beginnings and ends of documents
      }
    }
    if (!root) throw InputError(fmt::format("{}: the file is empty", name_));
    return root;
  }

 private:
  struct Open {
    std::shared_ptr<YamlNode> node;
    std::string anchor;
    std::shared_ptr<const YamlNode> key;  ///< the key whose value follows, in a map
  };

  void next(Event& event) {
    if (yaml_parser_parse(&parser_, event.get()) != 0) return;
    if (parser_.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
    int line = static_cast<int>(parser_.problem_mark.line) + 1;
    if (parser_.error == YAML_READER_ERROR) {  // libyaml gives a position but no line for bytes that are not text
      const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(parser_.problem_offset, text_.size()));
      line = static_cast<int>(std::count(text_.begin(), end, '\n')) + 1;
    }
    if (text_.starts_with("\x89HDF"))
      throw InputError(fmt::format("{}: this is an HDF5 file (results, or a superelement), no text", name_));
    if (text_.starts_with("ISO-10303-21"))
      throw InputError(fmt::format("{}: this is a STEP file, which a body file names as its `geometry`", name_));
    const std::string context = parser_.context == nullptr ? "" : std::string(parser_.context) + ", ";
    fail(line, fmt::format("no valid YAML: {}{}{}", context, parser_.problem == nullptr ? "" : parser_.problem,
                           hint_at_tabs(text_, line)));
  }

  static bool has_content(const Event& event) {
    return event->type == YAML_SCALAR_EVENT || event->type == YAML_ALIAS_EVENT ||
           event->type == YAML_SEQUENCE_START_EVENT || event->type == YAML_MAPPING_START_EVENT;
  }

  static std::shared_ptr<YamlNode> make(const Event& event, YamlNode::Kind kind) {
    auto node = std::make_shared<YamlNode>();
    node->kind = kind;
    node->line = event.line();
    return node;
  }

  static bool is_null(std::string_view scalar) {
    constexpr std::array<std::string_view, 5> nulls = {"", "~", "null", "Null", "NULL"};
    return std::find(nulls.begin(), nulls.end(), scalar) != nulls.end();
  }

  /// Checks a tag. Those of the core schema are accepted, because they state the types that values have anyway.
  void check_tag(int line, const yaml_char_t* tag) const {
    const std::string written = text_of(tag);
    constexpr std::string_view core = "tag:yaml.org,2002:";
    if (written.empty() || written == "!" || written.starts_with(core)) return;
    fail(line, fmt::format("tags ('{}') are not supported", shortened(written)));
  }

  void remember(const yaml_char_t* anchor, const std::shared_ptr<const YamlNode>& node) {
    remember(text_of(anchor), node);
  }
  void remember(const std::string& anchor, const std::shared_ptr<const YamlNode>& node) {
    if (!anchor.empty()) anchors_[anchor] = node;
  }

  std::shared_ptr<const YamlNode> anchored(const Event& event) const {
    const std::string anchor = text_of(event->data.alias.anchor);
    if (std::any_of(open_.begin(), open_.end(), [&](const Open& each) { return each.anchor == anchor; }))
      fail(event.line(), fmt::format("'*{}' stands inside of '&{}': an anchor contains itself", shortened(anchor),
                                     shortened(anchor)));
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      fail(event.line(),
           fmt::format("no valid YAML: '*{}' is used before '&{}'", shortened(anchor), shortened(anchor)));
    return found->second;
  }

  void open(std::shared_ptr<YamlNode> node, const yaml_char_t* anchor) {
    if (open_.size() > deepest) fail(node->line, fmt::format("nested more than {} levels deep", deepest));
    open_.push_back({std::move(node), text_of(anchor), nullptr});
  }

  /// Adds a complete node to the one that is open.
  void put(std::shared_ptr<const YamlNode> node, std::shared_ptr<const YamlNode>& root) {
    if (open_.empty()) {
      root = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node->kind == YamlNode::Kind::sequence)
      parent.node->items.push_back(std::move(node));
    else if (!parent.key)
      parent.key = std::move(node);
    else
      parent.node->pairs.push_back({std::exchange(parent.key, nullptr), std::move(node)});
  }

  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line, message));
  }

  const std::string& text_;
  const std::string& name_;
  yaml_parser_t parser_{};
  std::vector<Open> open_;
  std::map<std::string, std::shared_ptr<const YamlNode>> anchors_;
};

/// Upper bound of nodes that aliases repeat; larger files are not input files but attempts to exhaust the memory.
constexpr std::size_t most_repeated = 100'000;

/// Refuses constructs that YAML permits but that are errors in input files: repeated keys, merge keys (`<<`), and keys
/// that are not words.
/// @param budget  number of nodes that may still follow
void check_keys_of_all_maps(const YamlNode& node, const std::string& file, const std::string& path,
                            std::size_t& budget) {
  if (budget-- == 0)
    throw InputError(located_at(file, node.line, path.substr(0, 60),
                                fmt::format("aliases (`*name`) repeat more than {} values", most_repeated)));
  for (std::size_t k = 0; k < node.items.size(); ++k)
    check_keys_of_all_maps(*node.items[k], file, fmt::format("{}[{}]", path, k + 1), budget);
  std::map<std::string_view, int> lines;
  for (const auto& [key, value] : node.pairs) {
    if (key->kind != YamlNode::Kind::scalar)
      throw InputError(
          located_at(file, key->line, path, "a key must be a word; is something missing in front of ':'?"));
    if (key->scalar == "<<")
      throw InputError(
          located_at(file, key->line, path, "'<<' (merging of maps) is not supported; write the keys out"));
    const auto [first, is_new] = lines.emplace(key->scalar, key->line);
    if (!is_new)
      throw InputError(located_at(file, key->line, path_of_key(path, key->scalar),
                                  fmt::format("this key stands here twice; first on line {}", first->second)));
    check_keys_of_all_maps(*value, file, path_of_key(path, key->scalar), budget);
  }
}

}  // namespace

std::shared_ptr<const YamlNode> parse_yaml(const std::string& text, const std::string& name) {
  std::shared_ptr<const YamlNode> root = Parser(text, name).document();
  std::size_t budget = text.size() + most_repeated;  // without aliases there are no more nodes than letters
  check_keys_of_all_maps(*root, name, "", budget);
  return root;
}

}  // namespace bielle

#include "reduce/common/input/yaml_writer.hpp"

#include <stdexcept>

#include <yaml.h>

namespace bielle {
namespace {

class Writer {
 public:
  explicit Writer(int columns) {
    if (!yaml_emitter_initialize(&emitter_)) throw std::bad_alloc();
    yaml_emitter_set_output(&emitter_, append, &text_);
    yaml_emitter_set_unicode(&emitter_, 1);
    yaml_emitter_set_width(&emitter_, columns);
  }
  ~Writer() { yaml_emitter_delete(&emitter_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  std::string write(const YamlNode& root) {
    yaml_event_t event;
    emit(yaml_stream_start_event_initialize(&event, YAML_UTF8_ENCODING), event);
    emit(yaml_document_start_event_initialize(&event, nullptr, nullptr, nullptr, 1), event);
    write_node(root, 0);
    emit(yaml_document_end_event_initialize(&event, 1), event);
    emit(yaml_stream_end_event_initialize(&event), event);
    return text_;
  }

 private:
  static int append(void* text, unsigned char* bytes, std::size_t size) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), size);
    return 1;
  }

  void emit(int made, yaml_event_t& event) {
    if (!made || !yaml_emitter_emit(&emitter_, &event)) throw std::runtime_error("libyaml cannot write this text");
  }

  void write_scalar(const std::string& text, bool plain) {
    yaml_event_t event;
    auto* bytes = reinterpret_cast<yaml_char_t*>(const_cast<char*>(text.data()));
    emit(yaml_scalar_event_initialize(&event, nullptr, nullptr, bytes, static_cast<int>(text.size()), 1, 1,
                                      plain ? YAML_ANY_SCALAR_STYLE : YAML_SINGLE_QUOTED_SCALAR_STYLE),
         event);
  }

  static bool holds_maps(const YamlNode& list) {
    return !list.items.empty() && list.items.front()->kind == YamlNode::Kind::map;
  }

  void write_node(const YamlNode& node, int level) {
    yaml_event_t event;
    switch (node.kind) {
      case YamlNode::Kind::null:
        write_scalar("~", true);
        break;
      case YamlNode::Kind::scalar:
        write_scalar(node.scalar, !node.scalar.empty() && node.scalar != "~" && node.scalar != "null" &&
                                      node.scalar != "Null" && node.scalar != "NULL");
        break;
      case YamlNode::Kind::sequence:
        emit(yaml_sequence_start_event_initialize(
                 &event, nullptr, nullptr, 1,
                 level < 2 && holds_maps(node) ? YAML_BLOCK_SEQUENCE_STYLE : YAML_FLOW_SEQUENCE_STYLE),
             event);
        for (const auto& item : node.items) write_node(*item, 2);
        emit(yaml_sequence_end_event_initialize(&event), event);
        break;
      case YamlNode::Kind::map:
        emit(yaml_mapping_start_event_initialize(&event, nullptr, nullptr, 1,
                                                 level < 2 ? YAML_BLOCK_MAPPING_STYLE : YAML_FLOW_MAPPING_STYLE),
             event);
        for (const auto& [key, value] : node.pairs) {
          write_node(*key, 2);
          write_node(*value, level + 1);
        }
        emit(yaml_mapping_end_event_initialize(&event), event);
        break;
    }
  }

  yaml_emitter_t emitter_;
  std::string text_;
};

}  // namespace

std::string write_yaml(const YamlNode& root, int columns) { return Writer(columns).write(root); }

}  // namespace bielle

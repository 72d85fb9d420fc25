#include "mechanism/results/results_kinds.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bielle::mechanism {

namespace {

std::size_t count_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

bool alike(const std::vector<OutputField>& a, const std::vector<OutputField>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const OutputField& x, const OutputField& y) { return x.name == y.name && x.shape == y.shape; });
}

}  // namespace

const ResultsField* ResultsKind::find(const std::string& field) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const ResultsField& f) { return f.name == field; });
  return found == fields.end() ? nullptr : &*found;
}

/// An entry whose kind is not yet known.
struct ResultsKinds::Draft {
  ResultsEntry entry;
  std::string type;
  std::vector<ResultsField> fields;
  std::vector<ResultsPart> parts;
  std::string signature;  ///< common properties of its kind

  /// @returns its number. A quantity of several members is a single field if it is summed.
  std::size_t add(const OutputField& output, std::vector<std::size_t> shape) {
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (fields[k].name != output.name) continue;
      if (output.summed && fields[k].shape == shape) return k;
      throw std::logic_error(
          fmt::format("two components record the results '{}/{}'", results_path(entry.entry), output.name));
    }
    const std::size_t size = count_of(shape);
    signature += fmt::format("{}|{}|{}|{}|{}\n", output.name, fmt::join(shape, " "), output.units, output.description,
                             output.summed);
    fields.push_back({output.name, std::move(shape), output.units, output.description, output.summed, size, 0});
    return fields.size() - 1;
  }
  void add_part(std::size_t member, ResultsPart part) {
    for (const ResultsTarget& target : part) signature += fmt::format("{} {} ", target.field, target.offset);
    signature += '\n';
    entry.members.push_back(member);
    parts.push_back(std::move(part));
  }
};

ResultsKinds::ResultsKinds(const Model& model, bool all)
    : model_(model),
      all_(all),
      entry_of_node_(model.nodes().size(), none),
      entry_of_member_(model.members().size(), none) {
  add_nodes();
  add_members();
  kind_of_.clear();
  place();
}

void ResultsKinds::add_nodes() {
  constexpr int ground = 0;  // always at the origin
  for (int k = ground + 1; k < static_cast<int>(model_.nodes().size()); ++k) {
    const Node& node = model_.node(k);
    Draft draft;
    draft.entry.entry = {Section::nodes, node.name};
    if (node.internal || !records(draft.entry.entry)) continue;
    draft.type = "node";
    draft.entry.nodes = {k};
    draft.add({"position", {}, "m", "inertial"}, {3});
    draft.add({"rotation", {}, "-", "unit quaternion w x y z: node axes -> inertial axes"}, {4});
    draft.add({"velocity", {}, "m/s, rad/s", "inertial translation; rotation in the node's axes"}, {6});
    draft.add({"acceleration", {}, "m/s^2, rad/s^2", "inertial translation; rotation in the node's axes"}, {6});
    entry_of_node_[static_cast<std::size_t>(k)] = entries_.size();
    add(std::move(draft));
  }
}

void ResultsKinds::add_members() {
  std::map<Entry, const Chain*> chains;
  for (const Chain& chain : model_.chains()) chains.emplace(chain.entry, &chain);
  for (std::size_t first = 0; first < model_.members().size(); ++first) {
    const Member& member = model_.members()[first];
    if (member.recorded == Recorded::no || entry_of_member_[first] != none || !records(member.results)) continue;
    Draft draft;
    draft.entry.entry = member.results;
    draft.type = member.component->type();
    if (const auto chain = chains.find(member.results); chain != chains.end()) {
      draft.entry.nodes = chain->second->nodes;
      const std::size_t count = draft.entry.nodes.size();
      draft.add({"position", {}, "m", "inertial"}, {count, 3});
      draft.add({"rotation", {}, "-", "unit quaternions w x y z: node axes -> inertial axes"}, {count, 4});
    }
    std::vector<std::size_t> stacked;
    for (const std::size_t m : model_.members_of(member.results)) {
      const Member& other = model_.members()[m];
      if (other.recorded == Recorded::no || other.results != member.results) continue;
      entry_of_member_[m] = entries_.size();
      if (other.recorded == Recorded::stacked) {
        stacked.push_back(m);
        continue;
      }
      ResultsPart part;
      for (OutputField field : other.component->output_fields()) {
        if (member.results.section == Section::measures) field.name = "value";  // its dataset has the measure's name
        const std::size_t size = field.size();
        part.push_back({draft.add(field, field.shape), 0, size, field.summed});
      }
      draft.add_part(m, std::move(part));
    }
    add_stacked(member.results, stacked, draft);
    add(std::move(draft));
  }
}

void ResultsKinds::add_stacked(const Entry& entry, const std::vector<std::size_t>& members, Draft& draft) const {
  if (members.empty()) return;
  const auto fields_of = [&](std::size_t member) { return model_.members()[member].component->output_fields(); };
  const std::vector<OutputField> fields = fields_of(members.front());
  std::vector<std::size_t> numbers;
  for (const OutputField& field : fields) {
    std::vector<std::size_t> shape = field.shape;
    shape.insert(shape.begin(), members.size());
    numbers.push_back(draft.add(field, std::move(shape)));
  }
  for (std::size_t row = 0; row < members.size(); ++row) {
    if (row > 0 && !alike(fields_of(members[row]), fields))
      throw std::logic_error("the stacked components of '" + results_path(entry) + "' record different results");
    ResultsPart part;
    for (std::size_t f = 0; f < fields.size(); ++f)
      part.push_back({numbers[f], row * fields[f].size(), fields[f].size(), fields[f].summed});
    draft.add_part(members[row], std::move(part));
  }
}

void ResultsKinds::add(Draft draft) {
  const Section section = draft.entry.entry.section;
  const std::string type = fmt::format("{}/{}", section_name(section), draft.type);
  const auto [found, is_new] = kind_of_.try_emplace(type + "\n" + draft.signature, kinds_.size());
  if (is_new) {
    const std::size_t same_type = ++kinds_of_type_[type];
    ResultsKind kind;
    kind.section = section;
    kind.type = draft.type;
    kind.name = same_type == 1 ? kind.type : fmt::format("{}_{}", kind.type, same_type);
    kind.fields = std::move(draft.fields);
    kind.parts = std::move(draft.parts);
    if (section != Section::nodes) kind.chain = draft.entry.nodes.size();
    kinds_.push_back(std::move(kind));
  }
  ResultsKind& kind = kinds_[found->second];
  draft.entry.kind = found->second;
  draft.entry.number = kind.entries.size();
  kind.entries.push_back(entries_.size());
  entries_.push_back(std::move(draft.entry));
}

void ResultsKinds::place() {
  for (ResultsKind& kind : kinds_)
    for (ResultsField& field : kind.fields) {
      field.begin = size_;
      size_ += kind.entries.size() * field.size;
    }
}

std::size_t ResultsKinds::datasets() const {
  std::size_t count = 0;
  for (const ResultsKind& kind : kinds_) count += kind.entries.size() * kind.fields.size();
  return count;
}

const ResultsEntry* ResultsKinds::find(const Entry& entry) const {
  std::size_t place = none;
  if (entry.section == Section::nodes) {
    if (const auto node = model_.find_node(entry.name)) place = entry_of_node_[static_cast<std::size_t>(*node)];
  } else {
    for (const std::size_t member : model_.members_of(entry))
      if (place == none && model_.members()[member].results == entry) place = entry_of_member_[member];
  }
  return place == none ? nullptr : &entries_[place];
}

std::optional<std::pair<const ResultsEntry*, std::size_t>> ResultsKinds::find(const std::string& dataset) const {
  const std::size_t begin = dataset.find('/') + 1;
  for (std::size_t k = 0; k < section_count; ++k) {
    const auto section = static_cast<Section>(k);
    if (begin == 0 || dataset.compare(0, begin - 1, section_name(section)) != 0) continue;
    const bool measure = section == Section::measures;
    const std::size_t end = measure ? dataset.size() : dataset.rfind('/');
    if (end <= begin) return std::nullopt;
    const ResultsEntry* entry = find(Entry{section, dataset.substr(begin, end - begin)});
    if (!entry) return std::nullopt;
    const ResultsKind& kind = kinds_[entry->kind];
    const ResultsField* field = kind.find(measure ? "value" : dataset.substr(end + 1));
    if (field) return std::pair(entry, static_cast<std::size_t>(field - kind.fields.data()));
  }
  return std::nullopt;
}

std::string ResultsKinds::dataset(const ResultsEntry& entry, const ResultsField& field) const {
  const std::string path = results_path(entry.entry);
  return entry.entry.section == Section::measures ? path : path + "/" + field.name;
}

std::vector<std::pair<std::string, std::string>> ResultsKinds::attributes(const ResultsEntry& entry) const {
  std::vector<std::pair<std::string, std::string>> all;
  const auto add = [&](const std::string& name, const std::string& value) {
    const auto same = [&](const auto& attribute) { return attribute.first == name; };
    if (std::none_of(all.begin(), all.end(), same)) all.emplace_back(name, value);
  };
  if (entry.entry.section == Section::nodes) {
    if (const auto carrier = model_.node(entry.nodes.front()).carrier) add("carrier", model_.node(*carrier).name);
    return all;
  }
  add("type", kinds_[entry.kind].type);
  bool stacked = false;
  for (std::size_t k = 0; k < entry.members.size(); ++k) {
    const Component& component = *model_.members()[entry.members[k]].component;
    // The attributes of stacked members are those of the first one.
    if (model_.members()[entry.members[k]].recorded == Recorded::stacked && std::exchange(stacked, true)) continue;
    for (const auto& [name, value] : component.attributes()) add(name, value);
  }
  return all;
}

}  // namespace bielle::mechanism

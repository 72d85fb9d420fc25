#include "mechanism/session/step_recorders.hpp"

#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

StepRecorders::StepRecorders(const Model& model) {
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    names_.push_back(model.members()[m].component->name());
    if (auto recorder = model.members()[m].component->make_step_recorder()) all_.push_back({m, std::move(recorder)});
  }
}

StepRecorders::~StepRecorders() = default;

void StepRecorders::begin() {
  for (const One& one : all_) one.recorder->begin();
  check_datasets();
}

/// Throws if two datasets have the same name: a results file would reject it only at the end, after the whole
/// computation.
void StepRecorders::check_datasets() {
  std::map<std::string, std::size_t> owners;
  for (const One& one : all_)
    for (std::string& name : one.recorder->datasets()) owners.emplace(std::move(name), one.member);
  for (const auto& [name, owner] : owners)
    for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
      const auto other = owners.find(name.substr(0, slash));
      if (other != owners.end())
        throw InputError(fmt::format(
            "'{}' and '{}' cannot both have results: '{}' would be a number of the one and a folder of the other; "
            "rename one of them",
            names_[other->second], names_[owner], other->first));
    }
}

void StepRecorders::add(const State& state, const std::vector<Slots>& slots, const Environment& environment) {
  for (const One& one : all_) one.recorder->add(LocalState(state, slots[one.member], environment));
}

VectorX StepRecorders::numbers() {
  Archive archive;
  for (const One& one : all_) one.recorder->exchange(archive);
  return Eigen::Map<const VectorX>(archive.values().data(), static_cast<Eigen::Index>(archive.values().size()));
}

void StepRecorders::set(const VectorX& numbers) {
  if (numbers.size() != this->numbers().size())
    throw InputError("the state to continue from has gathered other `peaks` than the model asks for");
  Archive archive(std::vector<double>(numbers.begin(), numbers.end()));
  for (const One& one : all_) one.recorder->exchange(archive);
}

std::vector<ResultArray> StepRecorders::results() {
  std::vector<ResultArray> all;
  for (const One& one : all_)
    for (ResultArray& array : one.recorder->results()) all.push_back(std::move(array));
  return all;
}

std::string StepRecorders::summary() {
  std::map<std::string, std::size_t> speakers;
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const auto [speaker, is_first] = speakers.emplace(all_[k].recorder->voice(), k);
    if (!is_first && all_[k].recorder->loudness() > all_[speaker->second].recorder->loudness()) speaker->second = k;
  }
  std::string text;
  for (std::size_t k = 0; k < all_.size(); ++k)
    if (const std::string voice = all_[k].recorder->voice(); voice.empty() || speakers.at(voice) == k)
      text += all_[k].recorder->summary();
  return text;
}

}  // namespace bielle::mechanism

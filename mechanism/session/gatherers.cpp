#include "mechanism/session/gatherers.hpp"

#include <stdexcept>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

Gatherers::Gatherers(const Model& model) {
  for (std::size_t m = 0; m < model.members().size(); ++m)
    if (auto gatherer = model.members()[m].component->make_gatherer()) all_.push_back({m, std::move(gatherer)});
}

Gatherers::~Gatherers() = default;

void Gatherers::begin() {
  for (const One& one : all_) one.gatherer->begin();
}

void Gatherers::add(const State& state, const std::vector<Slots>& slots, const Environment& environment) {
  for (const One& one : all_) one.gatherer->add(LocalState(state, slots[one.member], environment));
}

VectorX Gatherers::numbers() {
  Archive archive;
  for (const One& one : all_) one.gatherer->exchange(archive);
  return Eigen::Map<const VectorX>(archive.values().data(), static_cast<Eigen::Index>(archive.values().size()));
}

void Gatherers::set(const VectorX& numbers) {
  if (numbers.size() != this->numbers().size())
    throw InputError("what is gone on with has gathered other `peaks` than the model asks for");
  Archive archive(std::vector<double>(numbers.begin(), numbers.end()));
  for (const One& one : all_) one.gatherer->exchange(archive);
}

std::vector<ResultArray> Gatherers::results() {
  std::vector<ResultArray> all;
  for (const One& one : all_)
    for (ResultArray& array : one.gatherer->results()) all.push_back(std::move(array));
  return all;
}

std::string Gatherers::summary() {
  std::string text;
  for (const One& one : all_) text += one.gatherer->summary();
  return text;
}

}  // namespace bielle::mechanism
